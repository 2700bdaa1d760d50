// Identical blades: in axial flow they move alike and load the mount along the shaft only; in forward flight the mount feels multiples of N per
// revolution only, and on average the airloads only (elastic forces and inertia of a periodic motion have no mean).
#include <gtest/gtest.h>

#include <complex>

#include "heerk_rotor/analysis/trim.hpp"
#include "models/section_sums.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kR = 4.91, kDegree = M_PI / 180, kPrecone = 2.5 * kDegree;

/// The Bo105 in a wind tunnel, shaft upright.
Overrides tunnel(int blades) {
  return {"subsystems.fuselage.mode=rigid", "subsystems.fuselage.shaft_tilt_forward_deg=0", "subsystems.rotor.blades=" + std::to_string(blades)};
}

TEST(RotorSymmetry, bladesMoveAlikeInAxialFlowThroughTransients) {
  for (const int blades : {3, 4, 5}) {
    for (const char* wind : {"0.0", "-6.0"}) {
      // Gravity acts along the shaft. Tables, dynamic inflow, elastic mast, all modes: as shipped.
      auto simulation = buildSimulation(shipped("bo105.yaml", tunnel(blades) + Overrides{std::string("subsystems.fuselage.wind=[0, 0, ") + wind +
          "]", "simulation.newton_tolerance=1e-13"}));
      const CoupledSystem& system = simulation->system();
      const CoupledSystem::Subsystem& rotor = subsystem(system, "rotor");
      Vector w = system.defaultCommand();
      const Index collective = static_cast<Index>(std::find(system.commandNames().begin(), system.commandNames().end(),
          "swashplate.collective") - system.commandNames().begin());
      Recorder loads(*simulation, {"fuselage.hub_force_x", "fuselage.hub_force_y", "fuselage.hub_force_z", "fuselage.hub_moment_x",
          "fuselage.hub_moment_y"});
      double states = 0.0, size = 0.0;
      for (int n = 0; n < 480; ++n) {
        if (n == 120) w[collective] = 0.2;
        if (n == 360) w[collective] = 0.05;
        ASSERT_EQ(simulation->step(w), StepStatus::kOk);
        // [mode][blade], rates after the coordinates
        const Eigen::Map<const Matrix> by_blade(simulation->state().data() + rotor.x_begin, blades, rotor.x_size / blades);
        states = std::max(states, (by_blade.rowwise() - by_blade.row(0)).cwiseAbs().maxCoeff());
        size = std::max(size, by_blade.cwiseAbs().maxCoeff());
      }
      double thrust = 0.0, force = 0.0, moment = 0.0;
      for (const Vector& row : loads.rows) thrust += std::abs(row[2]) / static_cast<double>(loads.rows.size());
      for (const Vector& row : loads.rows) {
        force = std::max(force, row.head(2).norm());
        moment = std::max(moment, row.tail(2).norm());
      }
      const std::string which = std::to_string(blades) + " blades, wind up " + wind;
      report("difference of blade states, relative, " + which, states / size);
      report("in-plane hub force over mean thrust, " + which, force / thrust);
      report("hub moment over mean thrust R, " + which, moment / (thrust * kR));
      EXPECT_GT(thrust, 2000.0) << which;
      EXPECT_LE(states, 1e-12 * size) << which;          // required; round-off that the damping of the blades does not let grow
      EXPECT_LE(force, 1e-9 * thrust) << which;          // required; inertia forces of m Omega^2 R, ten times the thrust, cancel to 1e-15
      EXPECT_LE(moment, 1e-9 * thrust * kR) << which;
    }
  }
}

/// Four elements and the lowest modes: the claims of periodic flight do not depend on how many there are. Smooth airloads, so that the mean over
/// steps is the mean over time.
Overrides coarse() {
  return {"subsystems.rotor.nodes=[0.20, 0.37, 0.60, 2.0, 4.91]", "subsystems.rotor.modes=6", "subsystems.airloads.polar=linear",
      "simulation.newton_tolerance=1e-13"};
}

/// A periodic motion, found by shooting; `targets`: with the shipped targets and controls, otherwise under the given controls.
struct Periodic {
  Periodic(const Overrides& overrides, bool targets, double tolerance) : configuration(shipped("bo105.yaml", overrides)) {
    const auto build = [&] { return buildSimulation(configuration); };
    simulation = build();
    Problems problems;
    TrimSettings settings;
    if (targets) settings = readTrimSettings(configuration, simulation->system(), problems);
    settings.tolerance = tolerance;
    TrimOptions options;
    options.threads = 1;
    result = trim(build, 2 * M_PI / 44.4, settings, options);
    simulation->setState(result.x);
  }
  Configuration configuration;
  std::unique_ptr<Simulation> simulation;
  TrimResult result;
};

const Overrides kForward{"subsystems.fuselage.wind=[-43.6, 0, 0]", "subsystems.swashplate.trim_collective=0.16",
    "subsystems.swashplate.trim_lateral_cyclic=0.02",
                         "subsystems.swashplate.trim_longitudinal_cyclic=-0.05"};

TEST(RotorSymmetry, forwardFlightShakesTheMountAtMultiplesOfTheBladeNumberOnly) {
  for (const int blades : {3, 4}) {
    Periodic flight(tunnel(blades) + coarse() + kForward, false, 1e-10);
    ASSERT_TRUE(flight.result.trimmed()) << flight.result.message;
    Recorder loads(*flight.simulation, {"fuselage.hub_force_x", "fuselage.hub_force_y", "fuselage.hub_force_z", "fuselage.hub_moment_x",
        "fuselage.hub_moment_y", "fuselage.hub_moment_z"});
    ASSERT_TRUE(advance(*flight.simulation, 360, flight.result.w));
    double passing = 0.0, others = 0.0, thrust = 0.0;
    for (int n = 0; n < 180; ++n) {
      Eigen::VectorXcd amplitude = Eigen::VectorXcd::Zero(6);
      for (int i = 0; i < 360; ++i) amplitude += std::polar(2.0 / 360, -n * i * kDegree) * loads.rows[static_cast<std::size_t>(i)];
      amplitude.tail(3) /= kR;
      if (n == 0) thrust = 0.5 * std::abs(amplitude[2]);
      double& largest = n % blades == 0 ? passing : others;
      if (n > 0) largest = std::max(largest, amplitude.cwiseAbs().maxCoeff());
    }
    const std::string which = ", " + std::to_string(blades) + " blades";
    report("periodicity residual" + which, flight.result.worst_periodicity);
    report("kN per rev over thrust" + which, passing / thrust);
    report("other harmonics over thrust" + which, others / thrust);
    EXPECT_GT(passing, 1e-3 * thrust);
    // A motion that repeats to 1e-10 of its states shows the other harmonics at that size, less what the damping within a revolution leaves.
    EXPECT_LE(others, 1e-10 * thrust);
  }
}

TEST(RotorSymmetry, meanHubLoadIsTheMeanAirload) {
  const double step = 0.75;
  Periodic flight(tunnel(4) + coarse() + kForward + Overrides{"subsystems.fuselage.gravity=0", set("simulation.azimuth_step_deg", step)}, true,
      1e-10);
  ASSERT_TRUE(flight.result.trimmed()) << flight.result.message;
  PortRecorder ports(*flight.simulation, {"rotor.rotor_force", "rotor.tilting_moment", "rotor.blade_reaction", "mast.hub_motion",
      "airloads.section_loads", "rotor.section_position"});
  ASSERT_TRUE(advance(*flight.simulation, std::lround(360 / step), flight.result.w));
  Vector hub = Vector::Zero(6), air = Vector::Zero(6), at_once(6), of_air(6);
  double apart = 0.0;
  for (const std::vector<Vector>& row : ports.rows) {
    const HubLoad sum = sumOfAirloads(row[3][0], row[4], row[5], 4, kPrecone);
    at_once << row[0], row[1], row[2];
    of_air << sum.force, sum.moment;
    apart = std::max(apart, (at_once - of_air).head(3).norm());
    hub += at_once / static_cast<double>(ports.rows.size());
    air += of_air / static_cast<double>(ports.rows.size());
  }
  const double thrust = air[2];
  EXPECT_NEAR(thrust, 18500.0, 1.0);  // the trim's target
  EXPECT_GT(apart, 1e-3 * thrust);  // only the means agree
  const char* const names[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  for (Index i = 0; i < 6; ++i) {
    const double error = std::abs(hub[i] - air[i]) / (thrust * (i < 3 ? 1.0 : kR));
    report(std::string("mean hub load less mean airload over T (R), ") + names[i], error);
    // HEERK4 weighs the loads of a step up to order 4: 1.4e-10 of T R in My at 1 deg, 4.6e-11 at 0.75 deg, 9e-12 at 0.5 deg.
    EXPECT_LE(error, 1e-10) << names[i];
  }
}

}  // namespace
}  // namespace heerk_rotor
