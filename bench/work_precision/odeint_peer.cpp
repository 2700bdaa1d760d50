// Boost.odeint: Dormand-Prince 5(4) with error control and dense output.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/numeric/odeint.hpp>

#include "integration.hpp"
#include "right_hand_side.hpp"

namespace heerk_rotor::work_precision {
namespace {

namespace odeint = boost::numeric::odeint;
using OdeintState = std::vector<double>;
constexpr long kMaxSteps = 20000000;

/// The library has one absolute tolerance for all states, so it gets states in parts of their magnitudes.
class Dopri5 final : public Integration {
 public:
  Dopri5(const Problem& problem, const Vector& scale, double tolerance) : problem_(problem), f_(problem), scale_(scale), tolerance_(tolerance), x_(scale) {
    states_.resize(f_.size(), problem.instants);
  }

  bool run() override {
    f_.restart();
    steps_ = 0;
    const auto n = static_cast<std::size_t>(f_.size());
    const auto rhs = [this, n](const OdeintState& z, OdeintState& dz, double t) {
      for (std::size_t i = 0; i < n; ++i) x_[static_cast<Index>(i)] = z[i] * scale_[static_cast<Index>(i)];
      if (!f_.complete(t, x_.data(), dz.data())) throw std::runtime_error("no right-hand side here");
      for (std::size_t i = 0; i < n; ++i) dz[i] /= scale_[static_cast<Index>(i)];
    };
    OdeintState z(n);
    for (std::size_t i = 0; i < n; ++i) z[i] = f_.start()[static_cast<Index>(i)] / scale_[static_cast<Index>(i)];
    auto stepper = odeint::make_dense_output(tolerance_, tolerance_, odeint::runge_kutta_dopri5<OdeintState>());
    try {
      stepper.initialize(z, 0.0, 1e-3 * problem_.spacing());
      for (Index k = 0; k < problem_.instants; ++k) {
        const double t = static_cast<double>(k + 1) * problem_.spacing();
        while (stepper.current_time() < t) {
          stepper.do_step(rhs);
          if (++steps_ > kMaxSteps) return false;
        }
        stepper.calc_state(t, z);
        for (std::size_t i = 0; i < n; ++i) states_(static_cast<Index>(i), k) = z[i] * scale_[static_cast<Index>(i)];
      }
    } catch (const std::exception&) {
      return false;
    }
    evaluations_ = f_.evaluations;
    return true;
  }

 private:
  Problem problem_;
  RightHandSide f_;
  Vector scale_;
  double tolerance_;
  Vector x_;
};

}  // namespace

std::vector<Family> odeintPeers(const Problem& problem, const Vector& scale, bool quick) {
  return {{"odeint dopri5", "dense output", tolerances(quick), [problem, scale](double tolerance) { return std::make_unique<Dopri5>(problem, scale, tolerance); }}};
}

}  // namespace heerk_rotor::work_precision
