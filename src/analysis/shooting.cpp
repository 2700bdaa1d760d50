#include "shooting.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace heerk_rotor {
namespace {

constexpr double kKeepGradient = 0.3;    // contraction per iteration above which the gradient is taken anew
constexpr double kNoProgress = 0.9;      // share of the residual that the linear model leaves at a local minimum of its norm
constexpr double kRank = 1e-8;           // directions that the residual feels less are neutral: below it the gradient is difference noise
constexpr double kSufficient = 1e-4;     // of the predicted decrease (Armijo)
constexpr int kHalvings = 10;

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Shooting::Shooting(MapTeam& maps, const TrimSettings& settings, const TrimOptions& options, TrimResult& result)
    : maps_(maps), settings_(settings), options_(options), result_(result), n_(maps.front()->system().stateSize()),
      c_(static_cast<Index>(settings.controls.size())), m_(static_cast<Index>(settings.signals.size())) {}

double Shooting::low(std::size_t k) const { return maps_.front()->system().commandLow()[settings_.controls[k]] / result_.scales.controls[static_cast<Index>(k)]; }
double Shooting::high(std::size_t k) const { return maps_.front()->system().commandHigh()[settings_.controls[k]] / result_.scales.controls[static_cast<Index>(k)]; }

bool Shooting::evaluate(Point& point) {
  Vector end;
  if (!maps_.front()->evaluate(point.x, point.w, end, point.means)) return false;
  point.residual.resize(n_ + m_);
  point.residual.head(n_) = (end - point.x).cwiseQuotient(result_.scales.states);
  for (Index k = 0; k < m_; ++k)
    point.residual[n_ + k] = with_targets_ ? (point.means[k] - settings_.targets[static_cast<std::size_t>(k)]) / result_.scales.targets[k] : 0.0;
  return point.residual.allFinite();
}

bool Shooting::refreshGradient(const Point& at) {
  const MapGradient gradient = differenceMap(maps_, at.x, at.w, settings_.controls, result_.scales);
  if (!gradient.complete) return false;
  ++result_.gradients;
  result_.monodromy = gradient.scaled.topLeftCorner(n_, n_);
  jacobian_ = gradient.scaled;
  jacobian_.topLeftCorner(n_, n_) -= Matrix::Identity(n_, n_);
  for (const Index held : settings_.hold) jacobian_.col(held).setZero();  // minimum norm then leaves them alone
  fresh_ = true;
  factorized_ = false;
  return true;
}

/// Minimises the merit |W (r + J z)| with the fixed controls moved by control_step, all else free.
Shooting::Step Shooting::newtonStep(const Point& at, const std::vector<char>& fixed, Vector control_step) const {
  const Index rows = with_targets_ ? n_ + m_ : n_;
  if (!factorized_ || factors_fixed_ != fixed) {
    Matrix free = weights_.head(rows).asDiagonal() * jacobian_.topRows(rows);
    for (Index k = 0; k < c_; ++k)
      if (fixed[static_cast<std::size_t>(k)]) free.col(n_ + k).setZero();
    factors_.setThreshold(kRank);
    factors_.compute(free);
    factors_fixed_ = fixed;
    factorized_ = true;
  }
  for (Index k = 0; k < c_; ++k)
    if (!fixed[static_cast<std::size_t>(k)]) control_step[k] = 0.0;
  const Vector forced = at.residual.head(rows) + jacobian_.topRows(rows).rightCols(c_) * control_step;
  Step step;
  step.z = factors_.solve(-forced.cwiseProduct(weights_.head(rows)));
  step.z.tail(c_) += control_step;
  step.predicted = (at.residual.head(rows) + jacobian_.topRows(rows) * step.z).cwiseProduct(weights_.head(rows)).norm();
  return step;
}

/// The Newton step whose controls stay within their travel: who would leave it stops at the limit, and the others make up for it.
Shooting::Step Shooting::limitedStep(const Point& at, bool controls_free) const {
  std::vector<char> fixed(static_cast<std::size_t>(c_), controls_free ? 0 : 1);
  Vector control_step = Vector::Zero(c_);
  for (;;) {
    Step step = newtonStep(at, fixed, control_step);
    bool within = true;
    for (std::size_t k = 0; controls_free && k < fixed.size(); ++k) {
      const auto i = static_cast<Index>(k);
      const double now = at.w[settings_.controls[k]] / result_.scales.controls[i], next = now + step.z[n_ + i];
      if (fixed[k] || (next >= low(k) && next <= high(k))) continue;
      fixed[k] = 1;
      control_step[i] = (next > high(k) ? high(k) : low(k)) - now;
      within = false;
    }
    if (within) return step;
  }
}

/// Goes along the step, halving it until the residual falls; false: it does not.
bool Shooting::accept(Point& point, const Step& step) {
  const double norm = merit(point);
  double share = 1.0;
  for (int i = 0; i <= kHalvings; ++i, share *= 0.5) {
    Point trial = point;
    trial.x += share * step.z.head(n_).cwiseProduct(result_.scales.states);
    for (Index k = 0; k < c_; ++k) {
      const Index control = settings_.controls[static_cast<std::size_t>(k)];
      const CoupledSystem& system = maps_.front()->system();
      trial.w[control] = std::clamp(trial.w[control] + share * step.z[n_ + k] * result_.scales.controls[k], system.commandLow()[control], system.commandHigh()[control]);
    }
    for (const Index held : settings_.hold) trial.x[held] = point.x[held];
    if (!evaluate(trial) || !(merit(trial) <= norm - kSufficient * share * (norm - step.predicted))) continue;
    point = std::move(trial);
    return true;
  }
  return false;
}

double Shooting::merit(const Point& point) const { return point.residual.cwiseProduct(weights_).norm(); }

bool Shooting::converged(const Point& point) const { return point.residual.cwiseAbs().maxCoeff() <= settings_.tolerance; }

void Shooting::iterate(Point& point, bool controls_free) {
  stalled_ = false;
  result_.history.push_back(merit(point));
  for (long i = 0; i < settings_.max_iterations && !converged(point); ++i) {
    if (jacobian_.size() == 0 && !refreshGradient(point)) return;
    const double before = merit(point);
    Step step = limitedStep(point, controls_free);
    bool taken = step.predicted < kNoProgress * before && accept(point, step);
    if (!taken && !fresh_) {
      if (!refreshGradient(point)) return;
      step = limitedStep(point, controls_free);
      taken = step.predicted < kNoProgress * before && accept(point, step);
    }
    if (!taken) {
      stalled_ = true;
      return;
    }
    ++result_.iterations;
    result_.history.push_back(merit(point));
    fresh_ = false;
    if (options_.progress)
      options_.progress("iteration " + std::to_string(result_.iterations) + ": residual " + number("%.2e", merit(point)) + ", gradients " + std::to_string(result_.gradients));
    if (merit(point) > kKeepGradient * before && !converged(point) && !refreshGradient(point)) return;
  }
}

/// Which control at a limit keeps which target from being met: the one whose way beyond the limit would serve it most.
std::string Shooting::limits(const Point& point) const {
  // Response of the targets to each control once the motion has become periodic again: K = D - C (M - I)^+ B.
  const Matrix periodic = jacobian_.topLeftCorner(n_, n_), controls = jacobian_.topRightCorner(n_, c_);
  Eigen::CompleteOrthogonalDecomposition<Matrix> factors;
  factors.setThreshold(kRank);
  factors.compute(periodic);
  const Matrix gain = jacobian_.bottomRightCorner(m_, c_) - jacobian_.bottomLeftCorner(m_, n_) * factors.solve(controls);
  Vector missing(m_);
  for (Index k = 0; k < m_; ++k) missing[k] = (point.means[k] - settings_.targets[static_cast<std::size_t>(k)]) / result_.scales.targets[k];
  const Vector wanted = gain.completeOrthogonalDecomposition().solve(-missing);
  const CoupledSystem& system = maps_.front()->system();

  std::string text;
  for (Index k = 0; k < m_; ++k) {
    if (std::abs(missing[k]) <= settings_.tolerance) continue;
    const Signal& signal = settings_.signals[static_cast<std::size_t>(k)];
    double most = 0.0;
    std::string limiting;
    for (Index j = 0; j < c_; ++j) {
      const Index control = settings_.controls[static_cast<std::size_t>(j)];
      const double value = point.w[control], low = system.commandLow()[control], high = system.commandHigh()[control];
      const bool outward = (value >= high && wanted[j] > 0.0) || (value <= low && wanted[j] < 0.0);
      if (!outward || std::abs(gain(k, j) * wanted[j]) <= most) continue;
      most = std::abs(gain(k, j) * wanted[j]);
      limiting = system.commandNames()[static_cast<std::size_t>(control)] + " is at its " + (value >= high ? "upper" : "lower") + " limit " + number("%.6g", value);
    }
    text += (text.empty() ? "" : "; ") + signal.name + " reaches " + number("%.6g", point.means[k]) + " of " + number("%.6g", settings_.targets[static_cast<std::size_t>(k)]) +
            (limiting.empty() ? "" : " because " + limiting);
  }
  return text;
}

void Shooting::conclude(const Point& point, TrimResult::Status status, const std::string& message) {
  result_.status = status;
  result_.message = message;
  result_.x = point.x;
  result_.w = point.w;
  result_.means = point.means;
  result_.periodicity = point.residual.head(n_);
  Index worst = 0;
  result_.worst_periodicity = n_ > 0 ? result_.periodicity.cwiseAbs().maxCoeff(&worst) : 0.0;
  if (n_ > 0) result_.worst_state = maps_.front()->system().stateNames()[static_cast<std::size_t>(worst)];
  result_.worst_target = 0.0;
  for (Index k = 0; k < m_; ++k)
    result_.worst_target = std::max(result_.worst_target, std::abs(point.means[k] - settings_.targets[static_cast<std::size_t>(k)]) / result_.scales.targets[k]);
}

void Shooting::solve() {
  Point point;
  point.x = result_.x;
  point.w = result_.w;
  weights_ = Vector::Ones(n_ + m_);
  weights_.head(n_) = result_.scales.states.cwiseQuotient(result_.scales.motion);
  if (!evaluate(point)) return;  // the status says so from the beginning
  iterate(point, true);
  if (converged(point)) {
    if (!fresh_ && !refreshGradient(point)) result_.monodromy.resize(0, 0);  // the multipliers are part of the answer
    return conclude(point, TrimResult::Status::kTrimmed, "");
  }
  const std::string state = "the largest residual is " + number("%.2e", point.residual.cwiseAbs().maxCoeff()) + " of the quantity's magnitude after " +
                            std::to_string(result_.iterations) + " iterations";
  if (!stalled_) {
    const bool exhausted = result_.iterations >= settings_.max_iterations;
    return conclude(point, exhausted ? TrimResult::Status::kIterationsExhausted : TrimResult::Status::kSimulationFailed,
                    exhausted ? "trim.max_iterations is used up: " + state : "a perturbed revolution failed: " + state);
  }
  // Targets that cannot be met: what is reached is said of a periodic motion under the controls found, not of a compromise.
  if (m_ > 0) {
    with_targets_ = false;
    factorized_ = false;
    Point periodic = point;
    if (evaluate(periodic)) {
      iterate(periodic, false);
      if (converged(periodic) && (jacobian_.size() == 0 || refreshGradient(periodic)))
        return conclude(periodic, TrimResult::Status::kInfeasible, "the targets cannot be met: " + limits(periodic));
    }
    with_targets_ = true;
  }
  conclude(point, TrimResult::Status::kStalled, "no step lowers the residual any more: " + state);
}

}  // namespace heerk_rotor
