// `printed` and `absolute_lag` are the same system in two sets of states: with everything switched on their trajectories
// differ by discretisation only.
#include <random>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// The controlled rotor away from every symmetry: unequal blades and supports, disturbed, commands and speed changing.
Overrides asymmetric(bool second_order_hub_terms) {
  return {"subsystems.rotor.lag_frequency=[9.4, 8.9, 9.9, 9.6]", "subsystems.rotor.lag_damper=[259.0, 0.0, 400.0, 150.0]",
          "subsystems.rotor.fuselage_frequency_y=21.0", "subsystems.rotor.fuselage_damping_y=2000.0",
          "subsystems.mast.damping=800.0", "subsystems.mast.stiffness=3.0e+5", "subsystems.mast.initial={twist: -0.02, twist_rate: 0.05}",
          "subsystems.rotor.initial={lag_1: -0.02, lag_2: -0.05, lag_3: -0.03, lag_4: -0.04, fuselage_x: 0.003, fuselage_y_rate: 0.02, lag_rate_2: 0.1}",
          std::string("subsystems.rotor.second_order_hub_terms=") + (second_order_hub_terms ? "true" : "false"), "simulation.newton_tolerance=1e-13"};
}

const std::vector<std::string>& watched() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = paperState();
    for (const char* more : {"rotor.hub_force_x", "rotor.hub_force_y", "rotor.hub_force_z", "rotor.hub_moment_x", "rotor.hub_moment_y", "rotor.hub_moment_z",
                             "rotor.lag_acceleration_1", "rotor.lag_acceleration_3", "rotor.angular_momentum", "rotor.blade_momentum_x", "mast.hub_acceleration",
                             "airloads.thrust", "drive.drive_rate"})
      list.push_back(more);
    return list;
  }();
  return names;
}

/// Watched signals after 0.5 s in which pitch and speed commands step.
Vector fly(const std::string& formulation, bool second_order_hub_terms, double h) {
  const Overrides form{"simulation.formulation=" + formulation, set("simulation.step", h)};
  auto simulation = buildSimulation(shipped("lag_rotor_controlled.yaml", asymmetric(second_order_hub_terms) + form));
  const CoupledSystem& system = simulation->system();
  Vector w = system.defaultCommand();
  const auto command = [&](const std::string& name) -> double& {
    const auto& names = system.commandNames();
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    return w[found - names.begin()];
  };
  const long tenth = std::lround(0.1 / h);
  EXPECT_TRUE(advance(*simulation, tenth, w));
  command("swashplate.collective") += 0.03;
  command("swashplate.longitudinal_cyclic") = 0.02;
  command("drive.speed") = 38.0;
  EXPECT_TRUE(advance(*simulation, 2 * tenth, w));
  command("swashplate.lateral_cyclic") = -0.03;
  EXPECT_TRUE(advance(*simulation, 2 * tenth, w));
  return look(*simulation, watched(), w);
}

TEST(Formulations, agreeOnTheCompleteAsymmetricSystem) {
  for (const bool second_order : {false, true}) {
    // Scale: how far each signal moves at all, so that one near a zero crossing is not judged by its own value.
    const Vector reference = fly("absolute_lag", second_order, 1e-4 / 4);
    Vector scale(reference.size());
    for (Index i = 0; i < scale.size(); ++i) scale[i] = std::abs(reference[i]);
    const double rate_scale = 0.1;
    for (Index i = 0; i < 7; ++i) scale[i] = std::max(scale[i], 0.01);            // m, rad
    for (Index i = 7; i < 14; ++i) scale[i] = std::max(scale[i], rate_scale);     // m/s, rad/s
    for (Index i = 14; i < scale.size(); ++i) scale[i] = std::max(scale[i], 1.0); // N, N m, rad/s^2 ...
    const auto difference = [&](double h) { return ((fly("printed", second_order, h) - fly("absolute_lag", second_order, h)).array() / scale.array()).abs().maxCoeff(); };
    const double coarse = difference(2e-4), fine = difference(1e-4);
    const std::string label = second_order ? "with second-order hub terms" : "without";
    report("printed against absolute_lag, h 2e-4, " + label, coarse);
    report("printed against absolute_lag, h 1e-4, " + label, fine);
    // The same solution up to discretisation: fourth order, and small.
    EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.3) << label;
    EXPECT_LE(fine, 1e-6) << label;
  }
}

TEST(Formulations, theSecondOrderTermsDoMatterThere) {
  const Vector with = fly("absolute_lag", true, 1e-4), without = fly("absolute_lag", false, 1e-4);
  EXPECT_GT((with - without).head(7).cwiseAbs().maxCoeff(), 1e-5);  // a thousand times the differences allowed above: they are seen
}

TEST(Formulations, haveTheSameDerivativesAtRandomStates) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const bool second_order : {false, true}) {
    ReducedOde printed(shipped("lag_rotor_controlled.yaml", asymmetric(second_order) + Overrides{"simulation.formulation=printed"}), 1e-15);
    ReducedOde absolute(shipped("lag_rotor_controlled.yaml", asymmetric(second_order)), 1e-15);
    const double g = LagRotorConstants(LagRotorParameters()).g;
    double worst = 0.0;
    for (int sample = 0; sample < 100; ++sample) {
      Vector common = printed.system.initialState(), paper(14);
      for (Index i = 0; i < common.size(); ++i) common[i] += 0.02 * unit(random);
      for (Index i = 0; i < 14; ++i) paper[i] = 0.05 * unit(random);
      Vector x1 = common, x2 = common;
      putPaperState(printed.system, paper, 0.0, x1);
      putPaperState(absolute.system, paper, g, x2);
      const double t = unit(random);
      Vector f1 = printed(t, x1), f2 = absolute(t, x2);
      // chi' = phi' + g twist': back to the printed states before comparing.
      const Index rotor = subsystem(printed.system, "rotor").x_begin, mast = subsystem(printed.system, "mast").x_begin;
      for (Index half = 0; half < 2; ++half) f2.segment(rotor + 6 * half + 2, 4).array() -= g * f2[mast + half];
      worst = std::max(worst, (f1 - f2).cwiseAbs().maxCoeff() / f1.cwiseAbs().maxCoeff());
    }
    report(std::string("derivatives, printed against absolute_lag, ") + (second_order ? "with" : "without"), worst);
    // Newton stops at 64 units of round-off of the iterated values, and the loop of the printed form amplifies what is left
    // by kappa = 682: 1e-11.
    EXPECT_LE(worst, 2e-11);
  }
}

}  // namespace
}  // namespace heerk_rotor
