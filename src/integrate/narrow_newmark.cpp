#include "narrow_newmark.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace heerk_rotor {
NarrowNewmark::NarrowNewmark(const CoupledSystem& system, const std::vector<const ImplicitPiece*>& pieces, double a, double tolerance)
    : a_(a), z_(Vector::Zero(system.stageSize())), free_z_(z_), start_r_(Vector::Zero(system.stageRemainderSize())), end_r_(start_r_), sum_(start_r_), start_(system.stageRemainderSize()),
      scratch_(Vector::Zero(system.stateSize())), iteration_(system.stageRemainderSize(), tolerance) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const CoupledSystem::Subsystem& s = system.subsystems()[i];
    if (s.x_size == 0) continue;
    Part part{pieces[i], s.narrow != nullptr, s.x_begin, s.x_size, s.z_begin, s.z_size, s.r_begin, s.r_size, {}, {}, {}, {}, {}};
    if (s.narrow) {
      const Matrix& C = s.narrow->C;
      const Index p = C.rows();
      Vector right = Vector::Zero(s.x_size), solved = right, rows(2 * p);
      part.start = ColumnSum(2 * p);
      for (Index k = 0; k < s.x_size; ++k) {
        right[k] = 1.0;
        part.piece->solve(right.data(), solved.data());
        rows << C.col(k), C * (2.0 * solved - right);
        right[k] = 0.0;
        part.start.add(rows, s.x_begin + k);
      }
      Matrix Q(s.x_size, s.r_size);
      part.implicit = ColumnSum(p);
      part.last = ColumnSum(s.x_size);
      for (Index m = 0; m < s.r_size; ++m) {
        right = a * s.narrow->B.col(m);
        part.piece->solve(right.data(), Q.col(m).data());
        part.implicit.add(C * Q.col(m), s.r_begin + m);
        part.last.add(Q.col(m), s.r_begin + m);
      }
      part.square = Q.transpose() * Q;
      part.start_z.setZero(2 * p);
    }
    parts_.push_back(std::move(part));
  }
  x_norms_.assign(parts_.size(), 0.0);
}

/// z at t_n, what x_n decides of the one at t_{n+1}, and how large x_n is.
void NarrowNewmark::begin(const Vector& x) noexcept {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    const Eigen::Map<const Vector> own(x.data() + part.x_begin, part.x_size);
    x_norms_[i] = own.norm();
    if (part.narrow) {
      part.start_z.setZero();
      part.start.apply(part.start_z.data(), x.data(), part.start_z.data());
      z_.segment(part.z_begin, part.z_size) = part.start_z.head(part.z_size);
      free_z_.segment(part.z_begin, part.z_size) = part.start_z.tail(part.z_size);
    } else {
      z_.segment(part.z_begin, part.z_size) = own;
      part.piece->solve(own.data(), scratch_.data());
      free_z_.segment(part.z_begin, part.z_size) = 2.0 * scratch_.head(part.x_size) - own;
    }
  }
}

/// z = base + C Q r.
void NarrowNewmark::addImplicit(const double* r, const double* base, double* z) noexcept {
  for (const Part& part : parts_) {
    if (part.narrow) {
      part.implicit.apply(base + part.z_begin, r, z + part.z_begin);
    } else {
      part.piece->solve(r + part.r_begin, scratch_.data());
      for (Index k = 0; k < part.z_size; ++k) z[part.z_begin + k] = base[part.z_begin + k] + a_ * scratch_[k];
    }
  }
}

/// |Q r| of one part.
double NarrowNewmark::normOfChange(const Part& part, const Vector& r) noexcept {
  if (!part.narrow) {
    part.piece->solve(r.data() + part.r_begin, scratch_.data());
    return a_ * scratch_.head(part.x_size).norm();
  }
  const double* const own = r.data() + part.r_begin;
  double square = 0.0;
  for (Index j = 0; j < part.r_size; ++j)
    for (Index i = 0; i < part.r_size; ++i) square += own[i] * part.square(i, j) * own[j];
  return std::sqrt(std::max(square, 0.0));
}

/// Of the state at the end of the step by a change of r_{n+1}; the worst subsystem.
double NarrowNewmark::relativeCorrection(const Vector& step) noexcept {
  sum_ = start_r_ + end_r_;
  double whole = 0.0;
  for (const double norm : x_norms_) whole = std::hypot(whole, norm);
  double worst = 0.0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double correction = normOfChange(parts_[i], step);
    if (correction > 0.0) worst = std::max(worst, correction / std::max(x_norms_[i] + normOfChange(parts_[i], sum_), kAtRest * whole));
  }
  return worst;
}

void NarrowNewmark::finish(const Vector& x, Vector& next) noexcept {
  sum_ = start_r_ + end_r_;
  for (const Part& part : parts_) {
    double* const result = next.data() + part.x_begin;
    const double* const own = x.data() + part.x_begin;
    if (part.narrow) {
      part.piece->solve(own, result);
      for (Index k = 0; k < part.x_size; ++k) result[k] = 2.0 * result[k] - own[k];
      part.last.apply(result, sum_.data(), result);
    } else {
      part.piece->solve(end_r_.data() + part.r_begin, result);
      for (Index k = 0; k < part.x_size; ++k) result[k] = free_z_[part.z_begin + k] + a_ * result[k];
    }
  }
}

NarrowNewmark::Outcome NarrowNewmark::advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept {
  begin(x);
  if (!evaluate.atStartNarrow(z_, start_r_.data())) return Outcome::kNotStarted;
  addImplicit(start_r_.data(), free_z_.data(), free_z_.data());
  start_.remember(t, start_r_.data());
  if (!start_.predict(t + 2.0 * a_, end_r_.data())) end_r_ = start_r_;
  const auto residual = [&](const Vector& r, Vector& result) noexcept {
    addImplicit(r.data(), free_z_.data(), z_.data());
    if (!evaluate.atNarrow(t + 2.0 * a_, z_, result.data())) return false;
    result -= r;
    return true;
  };
  const auto size = [&](const Vector& step) noexcept { return relativeCorrection(step); };
  if (iteration_.solve(end_r_, residual, size) != SecantIteration::End::kSolved) return Outcome::kGivenUp;
  finish(x, next);
  return Outcome::kDone;
}

void NarrowNewmark::forget() noexcept {
  iteration_.memory().clear();
  start_.forget();
}

std::vector<double> NarrowNewmark::memory() const {
  std::vector<double> values = iteration_.memory().values();
  start_.appendTo(values);
  return values;
}

void NarrowNewmark::restoreMemory(const std::vector<double>& memory) {
  const std::size_t expected = this->memory().size();
  if (memory.size() != expected) throw std::invalid_argument("Newmark's memory in narrow form: " + std::to_string(memory.size()) + " numbers, expected " + std::to_string(expected));
  auto value = memory.begin() + static_cast<std::ptrdiff_t>(iteration_.memory().values().size());
  iteration_.memory().restore({memory.begin(), value});
  start_.restore(value);
}

}  // namespace heerk_rotor
