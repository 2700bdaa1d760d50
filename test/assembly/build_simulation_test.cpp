#include "heerk_rotor/assembly/build_simulation.hpp"

#include <algorithm>
#include <unistd.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "heerk_rotor/assembly/snapshot.hpp"

namespace heerk_rotor {
namespace {

const std::string kLagRotor = HEERK_SOURCE_DIR "/config/lag_rotor.yaml";
const std::string kControlled = HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml";

double initialValue(const Simulation& simulation, const std::string& subsystem, const std::string& key) {
  for (const CoupledSystem::Subsystem& s : simulation.system().subsystems()) {
    const std::vector<State> states = s.model->states();
    for (std::size_t i = 0; s.name == subsystem && i < states.size(); ++i) {
      if (states[i].initialKey() == key) return simulation.state()[s.x_begin + static_cast<Index>(i)];
    }
  }
  ADD_FAILURE() << subsystem << " has no initial value " << key;
  return 0.0;
}

std::uint64_t hashAfter(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) EXPECT_EQ(simulation.step(simulation.system().defaultCommand()), StepStatus::kOk);
  return simulation.stateHash();
}

TEST(BuildSimulation, buildsEveryShippedConfiguration) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HEERK_SOURCE_DIR "/config")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_NO_THROW(buildSimulation(Configuration::load(entry.path().string()))) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(BuildSimulation, handsTheSettingsToTheSimulation) {
  const auto simulation = buildSimulation(
      Configuration::load(kLagRotor, {"simulation.step=2e-3", "simulation.integrator=HEERK2", "simulation.newton_tolerance=1e-7", "simulation.rotor_speed=5"}));
  EXPECT_EQ(simulation->stepSize(), 2e-3);
  EXPECT_EQ(simulation->options().method, "HEERK2");
  EXPECT_EQ(simulation->options().solver.tolerance, 1e-7);
  EXPECT_DOUBLE_EQ(simulation->options().revolution, 2.0 * M_PI / 5.0);
}

TEST(BuildSimulation, appliesThePapersToleranceRule) {
  // h = T_rev / 360 with p = 4: eps = 0.001 (100 / 360)^4 (HEERK paper, Section 4.2).
  const auto simulation = buildSimulation(Configuration::load(kLagRotor, {"simulation.newton_tolerance=paper", "simulation.azimuth_step_deg=1"}));
  EXPECT_NEAR(simulation->options().solver.tolerance, 1e-3 * std::pow(100.0 / 360.0, 4), 1e-17);
}

TEST(BuildSimulation, startsFromTheInitialValuesOfTheFileAndTheCommandLine) {
  const auto simulation = buildSimulation(Configuration::load(
      kLagRotor, {"simulation.formulation=printed", "subsystems.rotor.initial.lag_3=-0.02", "subsystems.rotor.initial.fuselage_x=0.25", "subsystems.mast.initial.twist_rate=0.5"}));
  EXPECT_EQ(initialValue(*simulation, "rotor", "lag_1"), 0.01);
  EXPECT_EQ(initialValue(*simulation, "rotor", "lag_2"), 0.0);
  EXPECT_EQ(initialValue(*simulation, "rotor", "lag_3"), -0.02);
  EXPECT_EQ(initialValue(*simulation, "rotor", "fuselage_x"), 0.25);
  EXPECT_EQ(initialValue(*simulation, "mast", "twist_rate"), 0.5);
}

TEST(BuildSimulation, exchangesASubsystemFromTheCommandLine) {
  const auto simulation = buildSimulation(Configuration::load(kLagRotor, {"subsystems.mast={type: rigid_mast}"}));
  EXPECT_EQ(simulation->system().stateSize(), 12);
}

TEST(BuildSimulation, swapsTheMastByOneWordInEveryShippedFile) {
  EXPECT_EQ(buildSimulation(Configuration::load(kLagRotor, {"subsystems.mast.type=rigid_mast"}))->system().stateSize(), 12);
  EXPECT_EQ(buildSimulation(Configuration::load(kControlled, {"subsystems.mast.type=rigid_mast"}))->system().stateSize(), 12 + 6 + 3);
}

TEST(BuildSimulation, knowsTheTravelOfTheControls) {
  const auto simulation = buildSimulation(Configuration::load(kControlled, {"subsystems.swashplate.collective_max=0.3"}));
  const CoupledSystem& system = simulation->system();
  const auto entry = [&](const std::string& name) { return std::find(system.commandNames().begin(), system.commandNames().end(), name) - system.commandNames().begin(); };
  EXPECT_EQ(system.commandHigh()[entry("swashplate.collective")], 0.3);
  EXPECT_EQ(system.commandLow()[entry("swashplate.longitudinal_cyclic")], -0.1745);
  EXPECT_EQ(system.commandLow()[entry("drive.speed")], 20.5);
}

TEST(BuildSimulation, givesTheSameSimulationFromTheResolvedText) {
  for (const std::string& file : {kLagRotor, kControlled}) {
    const Configuration original = Configuration::load(file, {"subsystems.mast.stiffness=2.9979e+6", "subsystems.rotor.initial.lag_2=0.1"});
    const Configuration again = Configuration::parse(original.resolvedText(), "resolved");
    const auto a = buildSimulation(original), b = buildSimulation(again), plain = buildSimulation(Configuration::load(file));
    EXPECT_EQ(a->stepSize(), b->stepSize());
    EXPECT_EQ(hashAfter(*a, 100), hashAfter(*b, 100)) << file;
    EXPECT_NE(a->stateHash(), hashAfter(*plain, 100)) << "the overrides must matter";
  }
}

TEST(BuildSimulation, goesOnBitwiseEqualFromASnapshotFileAlone) {
  const std::string file = testing::TempDir() + "build_simulation_test_" + std::to_string(::getpid()) + ".snapshot";
  for (const std::string& source : {kLagRotor, kControlled}) {
    for (const char* formulation : {"printed", "absolute_lag"}) {
      const Configuration configuration = Configuration::load(source, {std::string("simulation.formulation=") + formulation});
      const auto whole = buildSimulation(configuration);
      hashAfter(*whole, 250);
      saveSnapshot(file, {configuration.resolvedText(), whole->checkpoint()});
      const std::uint64_t expected = hashAfter(*whole, 250);

      const Snapshot snapshot = loadSnapshot(file);
      const auto continued = buildSimulation(Configuration::parse(snapshot.configuration, file));
      continued->restore(snapshot.checkpoint);
      EXPECT_EQ(hashAfter(*continued, 250), expected) << source << ", " << formulation;
      EXPECT_EQ(continued->stepCount(), 500u);
    }
  }
  std::filesystem::remove(file);
}

TEST(BuildSystem, refusesAnInitialStateThatOverflows) {
  // The absolute lag angle is lag + g twist: each finite, the sum is not.
  const Configuration configuration = Configuration::load(kLagRotor, {"subsystems.rotor.initial.lag_2=1.7e308", "subsystems.mast.initial.twist=1.7e308"});
  try {
    buildSystem(configuration);
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("--set subsystems.rotor.initial.lag_2: subsystems.rotor.initial.lag_2 = inf: expected parameters with which the initial value is finite [rad]"),
              std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace heerk_rotor
