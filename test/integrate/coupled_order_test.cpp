// Observed orders on a coupled problem with an algebraic part: the lag rotor on its elastic mast.
#include <gtest/gtest.h>

#include <cmath>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kDuration = 1.0;  // [s]

Vector endState(const std::string& method, const std::string& formulation, double stiffness, double h) {
  auto simulation = buildSimulation(shipped("lag_rotor.yaml", {"simulation.integrator=" + method, "simulation.formulation=" + formulation, set("simulation.step", h),
                                                               set("subsystems.mast.stiffness", stiffness), "simulation.newton_tolerance=1e-13"}));
  EXPECT_TRUE(advance(*simulation, std::lround(kDuration / h)));
  return look(*simulation, paperState());
}

struct Stiffness {
  double stiffness;  // [N m/rad]
  double step;       // [s], h |lambda| = 0.11 at the coarsest
};

TEST(CoupledOrder, everyMethodHasItsOrderInBothFormulations) {
  for (const Stiffness& problem : {Stiffness{3e4, 1e-3}, Stiffness{3e6, 1e-4}}) {
    // The reference (absolute-lag HEERK4 at an eighth of the finest step) is itself checked in test/models/reference_states_test.cpp.
    const Vector exact = endState("HEERK4", "absolute_lag", problem.stiffness, problem.step / 16);
    const Vector scale = exact.cwiseAbs().array() + 1e-3 * exact.cwiseAbs().maxCoeff();
    for (const std::string& method : stepMethodNames()) {
      const int expected = orderOfStepMethod(method);
      for (const char* formulation : {"absolute_lag", "printed"}) {
        const auto error = [&](double h) { return ((endState(method, formulation, problem.stiffness, h) - exact).array() / scale.array()).matrix().norm(); };
        // With the printed form HEERK2 (and Newmark) still has errors of the solution's size at K_s = 3e6: it needs smaller steps to show its order.
        const double h = expected > 2 ? problem.step : problem.step / 8;
        const double coarse = error(h), fine = error(h / 2), order = std::log2(coarse / fine);
        report("order of " + method + ", " + formulation + ", K_s " + std::to_string(static_cast<long>(problem.stiffness)), order);
        // The predictor's share of the precise methods' error falls faster than that of their quadrature.
        const double more = method.rfind("precise", 0) == 0 ? 0.7 : 0.1;
        EXPECT_GE(order, expected - 0.1) << method;
        EXPECT_LE(order, expected + more) << method << ", " << formulation << ", K_s " << problem.stiffness << ", errors " << coarse << ", " << fine;
      }
    }
  }
}

}  // namespace
}  // namespace heerk_rotor
