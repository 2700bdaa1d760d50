// Convergence of the complete elastic rotor over one revolution (paper, Figure 5 a): blades, airloads, inflow, swashplate, mast and fuselage,
// with the smooth linear airloads, in forward flight with cyclic pitch. scripts/paper_fe_rotor.py draws the whole curves.
#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/QR>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

const Overrides kSmooth{"subsystems.airloads.polar=linear", "subsystems.fuselage.shaft_tilt_forward_deg=0.0"};
const Overrides kFuselageHeld{"subsystems.fuselage.mode=rigid"};  // the mast stays elastic, the hub turns freely
const Overrides kAllModes{"subsystems.rotor.modes=0"};

/// One revolution in forward flight, from one start for all methods and steps, and what HEERK4 with 9000 steps makes of it, which is exact
/// to round-off (about 1e-13).
class Revolution {
 public:
  explicit Revolution(const Overrides& more = {}) : more_(more) {
    fly();
    exact_ = end("HEERK4", 9000);
  }

  /// State after `steps` steps.
  Vector end(const std::string& method, long steps) const {
    const auto simulation = rotor(method, steps);
    simulation->setState(x_);
    EXPECT_TRUE(advance(*simulation, steps, w_)) << method << ", " << steps << " steps";
    return simulation->state();
  }

  /// Error of the blades in the energy norm, relative to their energy. All else in the system acts on them.
  double bladeError(const Vector& x) const {
    const auto norm = [this](const Vector& of) {
      const Index n = omega_.size();
      return std::sqrt(of.segment(blades_, n).cwiseProduct(omega_).squaredNorm() + of.segment(blades_ + n, n).squaredNorm());
    };
    return norm(x - exact_) / norm(exact_);
  }

  /// Largest error of any other state, relative to its largest value on the way into forward flight. The drive's states are left out: at
  /// constant speed they are zero.
  double otherError(const Vector& x) const {
    double error = 0.0;
    for (const Index i : others_) error = std::max(error, std::abs(x[i] - exact_[i]) / largest_[i]);
    return error;
  }

  /// Least-squares slope of log(error) over log(step).
  double order(const std::string& method, const std::vector<long>& steps) const {
    Matrix terms(static_cast<Index>(steps.size()), 2);
    Vector logarithms(terms.rows());
    for (Index i = 0; i < terms.rows(); ++i) {
      const long n = steps[static_cast<std::size_t>(i)];
      const double error = bladeError(end(method, n));
      report(method + ", " + std::to_string(n) + " steps", error);
      terms.row(i) << 1.0, -std::log(static_cast<double>(n));
      logarithms[i] = std::log(error);
    }
    const double slope = terms.colPivHouseholderQr().solve(logarithms)[1];
    report("order of " + method, slope);
    return slope;
  }

 private:
  /// Newton to round-off: what is measured is the error of the method alone.
  std::unique_ptr<Simulation> rotor(const std::string& method, long steps, const Overrides& also = {}) const {
    return buildSimulation(shipped("bo105.yaml", kSmooth + more_ + also + Overrides{"simulation.integrator=" + method, "simulation.newton_tolerance=1e-14",
                                                                                    set("simulation.azimuth_step_deg", 360.0 / static_cast<double>(steps))}));
  }

  /// Forward flight reached smoothly. First the rotor comes to rest in hover, with strong structural damping: on an upright shaft its blades
  /// do not move then, so that the damping can return to its value without any effect. Then wind and swashplate follow a polynomial with
  /// three vanishing derivatives at its ends, in small steps. A sudden load, or damping that is switched off in motion, would excite modes
  /// far above what the steps resolve.
  void fly() {
    struct Change { const char* command; double from, by; };
    const Change changes[] = {{"swashplate.collective", 0.12, 0.02}, {"swashplate.lateral_cyclic", 0.0, 0.02}, {"swashplate.longitudinal_cyclic", 0.0, -0.03},
                              {"fuselage.wind_x", 0.0, -20.0}};  // [rad], [m/s]: advance ratio 0.09
    const auto hover = rotor("HEERK4", 360, {"subsystems.rotor.damping_mass=60.0"});
    const std::vector<std::string>& names = hover->system().commandNames();
    w_ = hover->system().defaultCommand();
    const auto command = [&](double part) {
      for (const Change& change : changes) {
        const auto found = std::find(names.begin(), names.end(), change.command);
        ASSERT_NE(found, names.end()) << change.command;
        w_[found - names.begin()] = change.from + part * change.by;
      }
    };
    command(0.0);
    EXPECT_TRUE(advance(*hover, 60 * 360, w_));

    const long steps = 4000, revolutions = 3;  // the commands move during the first two
    const auto simulation = rotor("HEERK4", steps);
    simulation->setState(hover->state());
    largest_ = hover->state().cwiseAbs();
    for (long k = 0; k < steps * revolutions; ++k) {
      const double s = std::min(1.0, (static_cast<double>(k) + 0.5) / static_cast<double>(2 * steps));
      command(s * s * s * s * (35.0 - 84.0 * s + 70.0 * s * s - 20.0 * s * s * s));
      ASSERT_EQ(simulation->step(w_), StepStatus::kOk) << "on the way into forward flight";
      largest_ = largest_.cwiseMax(simulation->state().cwiseAbs());
    }
    x_ = simulation->state();
    for (const CoupledSystem::Subsystem& s : simulation->system().subsystems()) {
      if (s.name == "rotor") {
        blades_ = s.x_begin;
        omega_ = std::get<ModalStiff>(s.stiff).omega;
      }
      for (Index i = s.x_begin; i < s.x_begin + s.x_size && s.name != "rotor" && s.name != "drive"; ++i) others_.push_back(i);
    }
  }

  Overrides more_;
  Vector x_, w_;              // where the revolution starts
  Vector exact_;              // where it ends
  Vector largest_, omega_;    // largest value of each state on the way there; of the blades' modes [rad/s]
  Index blades_ = 0;
  std::vector<Index> others_;
};

/// Of the shipped rotor; made once for all tests.
const Revolution& shippedRotor() {
  static const Revolution revolution;
  return revolution;
}

TEST(FeRotorConvergence, everyMethodHasItsOrderOverOneRevolution) {
  const Revolution& revolution = shippedRotor();
  // Single errors lie up to 1.5 times off a straight line (400 steps: h omega = 2 pi of the mode at 17866 rad/s), which the slope feels by 0.2.
  EXPECT_NEAR(revolution.order("HEERK2", {100, 200, 400, 800, 1600, 3200}), 2.0, 0.25);
  EXPECT_NEAR(revolution.order("HEERK3", {100, 200, 400, 800, 1600, 3200}), 3.0, 0.25);
  // Without 3200 steps, where there is round-off only. 4.1, as the largest step is just too large for the leading term alone.
  EXPECT_NEAR(revolution.order("HEERK4", {100, 200, 400, 800, 1600}), 4.0, 0.35);
  const Vector finest = revolution.end("HEERK4", 3200);
  EXPECT_LT(revolution.bladeError(finest), 1e-12);  // the paper's curve flattens at 1000 steps
  const double others = revolution.otherError(finest);
  report("HEERK4, finest, other states", others);
  EXPECT_LT(others, 1e-11);  // some of them are hundreds of times smaller in this revolution than before
}

// S describes blades on a mount that does not move. A free fuselage feeds their stiff root forces back through f~. What blade modes that no step
// resolves (h omega from 4 to 260 at these steps) carry of that costs half an order, in every method tried (docs/paper_fe_rotor). That is why the shipped
// rotor leaves six of its 50 modes out.
TEST(FeRotorConvergence, modesThatNoStepResolvesCostHalfAnOrderWithAFuselageThatMoves) {
  const Revolution all(kAllModes);
  const std::vector<long> steps{330, 500, 730, 1000, 1600};
  const double order_of_all = all.order("HEERK4", steps);
  EXPECT_NEAR(order_of_all, 3.3, 0.3);
  EXPECT_GE(shippedRotor().order("HEERK4", steps), order_of_all + 0.5);
}

TEST(FeRotorConvergence, orderFourInFullWithAllModesWhereTheFuselageDoesNotMove) {
  const Revolution revolution(kAllModes + kFuselageHeld);
  EXPECT_NEAR(revolution.order("HEERK4", {100, 150, 220, 330, 500, 730, 1090, 1600}), 4.0, 0.15);
}

}  // namespace
}  // namespace heerk_rotor
