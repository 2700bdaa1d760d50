#include "narrow_stages.hpp"

#include <algorithm>
#include <cstring>

namespace heerk_rotor {
namespace {
constexpr int kLine = 8;  // doubles per cache line
}

ColumnSum::ColumnSum(Index rows) : rows_(rows), pitch_((rows + kLine - 1) / kLine * kLine) {}

void ColumnSum::add(const Vector& column, Index source) {
  if (column.isZero(0.0)) return;
  sources_.push_back(source);
  columns_.insert(columns_.end(), column.data(), column.data() + rows_);
  columns_.resize(sources_.size() * static_cast<std::size_t>(pitch_), 0.0);
}

/// N rows from `row` on. Sums take turns, so that one need not wait for the other: as many as registers hold.
template <int N>
void ColumnSum::applyLanes(Index row, const double* base, const double* values, double* result) const noexcept {
  constexpr int kSums = N <= 4 ? 4 : N <= 8 ? 3 : 2;
  using Lanes = Eigen::Array<double, N, 1>;
  using Load = Eigen::Map<const Lanes>;
  const double* c = columns_.data() + row;
  const Index* source = sources_.data();
  const Index* const end = source + sources_.size();
  Lanes sum = Load(base + row);
  if (end - source >= 2 * kSums) {
    Lanes more[kSums - 1];
    for (Lanes& s : more) {
      s = Load(c) * values[*source++];
      c += pitch_;
    }
    for (; end - source >= kSums; source += kSums, c += kSums * pitch_) {
      sum += Load(c) * values[source[0]];
      for (int k = 1; k < kSums; ++k) more[k - 1] += Load(c + k * pitch_) * values[source[k]];
    }
    for (const Lanes& s : more) sum += s;
  }
  for (; source != end; c += pitch_) sum += Load(c) * values[*source++];
  Eigen::Map<Lanes>(result + row) = sum;
}

void ColumnSum::apply(const double* base, const double* values, double* result) const noexcept {
  Index row = 0;
  for (; row + 16 <= rows_; row += 16) applyLanes<16>(row, base, values, result);
  switch ((rows_ - row) / 4) {
    case 3: applyLanes<12>(row, base, values, result); break;
    case 2: applyLanes<8>(row, base, values, result); break;
    case 1: applyLanes<4>(row, base, values, result); break;
    default: break;
  }
  for (row += (rows_ - row) / 4 * 4; row < rows_; ++row) applyLanes<1>(row, base, values, result);
}

NarrowStages::NarrowStages(const CoupledSystem& system, const Tableau& tableau, const std::vector<const LinearPropagator*>& propagators)
    : stages_(tableau.stages()), r_size_(system.stageRemainderSize()) {
  x_.setZero(system.stateSize());
  z_.setZero(system.stageSize());
  r_.setZero(stages_ * r_size_);
  for (std::size_t i = 0; i < propagators.size(); ++i) {
    const CoupledSystem::Subsystem& s = system.subsystems()[i];
    if (s.x_size == 0) continue;
    Part part{propagators[i], s.narrow != nullptr, s.x_begin, s.x_size, s.z_begin, s.z_size, s.r_begin, {}, {}, {}, {}, {}};
    if (s.narrow) {
      const Matrix &C = s.narrow->C, &B = s.narrow->B;
      std::vector<double> nodes;
      for (int row = 0; row < stages_; ++row) {
        const double c = tableau.node(row);
        const auto known = std::find(nodes.begin(), nodes.end(), c);
        part.node.push_back(known - nodes.begin());
        if (known == nodes.end()) nodes.push_back(c);
      }
      const Index p = C.rows(), free_rows = p * static_cast<Index>(nodes.size());
      part.free_z.setZero(free_rows);
      part.free = ColumnSum(free_rows);
      // The products of matrices by propagating unit vectors and the columns of B.
      Vector unit = Vector::Zero(s.x_size), moved = unit, column(free_rows);
      for (Index k = 0; k < s.x_size; ++k) {
        unit[k] = 1.0;
        for (int row = 0; row < stages_; ++row) {
          part.propagator->propagate(row, unit.data(), moved.data());
          column.segment(part.node[static_cast<std::size_t>(row)] * p, p) = C * moved;
        }
        unit[k] = 0.0;
        part.free.add(column, s.x_begin + k);
      }
      const Vector zero = Vector::Zero(s.x_size);
      Matrix remainders = Matrix::Zero(s.x_size, stages_);
      part.last = ColumnSum(s.x_size);
      for (int row = 0; row <= stages_; ++row) {
        ColumnSum forced(p);
        for (int j = 0; j < row; ++j)
          for (Index m = 0; m < s.r_size; ++m) {
            remainders.col(j) = B.col(m);
            part.propagator->combine(row, zero.data(), remainders.data(), s.x_size, moved.data());
            remainders.col(j).setZero();
            const Index source = j * r_size_ + s.r_begin + m;
            if (row < stages_) forced.add(C * moved, source);
            else part.last.add(moved, source);
          }
        if (row < stages_) part.forced.push_back(std::move(forced));
      }
    }
    parts_.push_back(std::move(part));
  }
}

void NarrowStages::begin(const Vector& x) noexcept {
  for (Part& part : parts_) {
    if (!part.narrow) {
      std::copy_n(x.data() + part.x_begin, part.x_size, x_.data() + part.x_begin);
      continue;
    }
    part.free_z.setZero();
    part.free.apply(part.free_z.data(), x.data(), part.free_z.data());
  }
}

const Vector& NarrowStages::stage(int row) noexcept {
  for (const Part& part : parts_) {
    double* const z = z_.data() + part.z_begin;
    if (part.narrow)
      part.forced[static_cast<std::size_t>(row)].apply(part.free_z.data() + part.node[static_cast<std::size_t>(row)] * part.z_size, r_.data(), z);
    else
      part.propagator->combine(row, x_.data() + part.x_begin, r_.data() + part.r_begin, r_size_, z);
  }
  return z_;
}

void NarrowStages::finish(const Vector& x, Vector& next) const noexcept {
  for (const Part& part : parts_) {
    double* const result = next.data() + part.x_begin;
    if (part.narrow) {
      part.propagator->propagate(stages_, x.data() + part.x_begin, result);
      part.last.apply(result, r_.data(), result);
    } else {
      part.propagator->combine(stages_, x.data() + part.x_begin, r_.data() + part.r_begin, r_size_, result);
    }
  }
}

}  // namespace heerk_rotor
