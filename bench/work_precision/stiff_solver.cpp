#include "stiff_solver.hpp"

#include <limits>

namespace heerk_rotor::work_precision {

StiffSolver::StiffSolver(const CoupledSystem& system) : size_(system.stateSize()) {
  for (const CoupledSystem::Subsystem& subsystem : system.subsystems())
    if (subsystem.x_size > 0) add(subsystem.stiff, subsystem.x_begin);
  gamma_ = std::numeric_limits<double>::quiet_NaN();
}

void StiffSolver::add(const StiffPart& part, Index begin) {
  if (const auto* modal = std::get_if<ModalStiff>(&part)) {
    const Index m = modal->omega.size();
    pairs_.push_back({begin, Array::Zero(m), Array::Ones(m), -modal->omega.array().square(), -modal->damping.array(), {}, {}, {}, {}});
  } else if (const auto* pair = std::get_if<PairStiff>(&part)) {
    const auto m = static_cast<Index>(pair->blocks.size());
    Pairs p{begin, Array(m), Array(m), Array(m), Array(m), {}, {}, {}, {}};
    for (Index i = 0; i < m; ++i) {
      const Eigen::Matrix2d& block = pair->blocks[static_cast<std::size_t>(i)];
      p.a[i] = block(0, 0);
      p.b[i] = block(0, 1);
      p.c[i] = block(1, 0);
      p.d[i] = block(1, 1);
    }
    pairs_.push_back(std::move(p));
  } else if (const auto* second = std::get_if<SecondOrderStiff>(&part)) {
    second_order_.push_back({begin, second->stiffness, second->damping, {}, Vector::Zero(second->stiffness.rows())});
  } else if (const auto* dense = std::get_if<DenseStiff>(&part)) {
    dense_.push_back({begin, dense->S, {}});
  } else if (const auto* blocks = std::get_if<BlockStiff>(&part)) {
    for (const StiffBlock& block : blocks->blocks) {
      add(block.part, begin);
      begin += stiffSize(block.part);
    }
  }
}

void StiffSolver::multiply(const double* x, double* Sx) const noexcept {
  Eigen::Map<Vector>(Sx, size_).setZero();
  for (const Pairs& p : pairs_) {
    const Index m = p.a.size();
    const Eigen::Map<const Array> first(x + p.begin, m), second(x + p.begin + m, m);
    Eigen::Map<Array>(Sx + p.begin, m) = p.a * first + p.b * second;
    Eigen::Map<Array>(Sx + p.begin + m, m) = p.c * first + p.d * second;
  }
  for (const SecondOrder& s : second_order_) {
    const Index m = s.K.rows();
    const In q(x + s.begin, m), v(x + s.begin + m, m);
    Out(Sx + s.begin, m) = v;
    Out acceleration(Sx + s.begin + m, m);
    acceleration.noalias() -= s.K * q;
    acceleration.noalias() -= s.C * v;
  }
  for (const Dense& d : dense_) Out(Sx + d.begin, d.S.rows()).noalias() += d.S * In(x + d.begin, d.S.rows());
}

void StiffSolver::setGamma(double gamma) {
  if (gamma == gamma_) return;
  gamma_ = gamma;
  for (Pairs& p : pairs_) {
    const Array a = 1.0 - gamma * p.a, b = -gamma * p.b, c = -gamma * p.c, d = 1.0 - gamma * p.d, determinant = a * d - b * c;
    p.inverse_a = d / determinant;
    p.inverse_b = -b / determinant;
    p.inverse_c = -c / determinant;
    p.inverse_d = a / determinant;
  }
  for (SecondOrder& s : second_order_) s.lu.compute(Matrix::Identity(s.K.rows(), s.K.rows()) + gamma * s.C + gamma * gamma * s.K);
  for (Dense& d : dense_) d.lu.compute(Matrix::Identity(d.S.rows(), d.S.rows()) - gamma * d.S);
}

void StiffSolver::solve(const double* b, double* z) noexcept {
  if (z != b) Out(z, size_) = In(b, size_);
  for (const Pairs& p : pairs_) {
    const Index m = p.a.size();
    Eigen::Map<Array> first(z + p.begin, m), second(z + p.begin + m, m);
    for (Index i = 0; i < m; ++i) {
      const double one = first[i], two = second[i];
      first[i] = p.inverse_a[i] * one + p.inverse_b[i] * two;
      second[i] = p.inverse_c[i] * one + p.inverse_d[i] * two;
    }
  }
  for (SecondOrder& s : second_order_) {
    // v = (I + gamma C + gamma^2 K)^-1 (b_v - gamma K b_q), q = b_q + gamma v.
    const Index m = s.K.rows();
    Out q(z + s.begin, m), v(z + s.begin + m, m);
    s.rate = v;
    s.rate.noalias() -= gamma_ * (s.K * q);
    v = s.lu.solve(s.rate);
    q += gamma_ * v;
  }
  for (Dense& d : dense_) {
    Out part(z + d.begin, d.S.rows());
    part = d.lu.solve(part).eval();
  }
}

}  // namespace heerk_rotor::work_precision
