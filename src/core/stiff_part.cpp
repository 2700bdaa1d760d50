#include "heerk_rotor/core/stiff_part.hpp"

namespace heerk_rotor {
namespace {

// One visitor per question; the overloads are the kinds.

struct Size {
  Index operator()(const ZeroStiff& zero) const { return zero.size; }
  Index operator()(const DenseStiff& dense) const { return dense.S.rows(); }
  Index operator()(const ModalStiff& modal) const { return 2 * modal.omega.size(); }
  Index operator()(const SecondOrderStiff& part) const { return 2 * part.stiffness.rows(); }
  Index operator()(const PairStiff& pairs) const { return 2 * static_cast<Index>(pairs.blocks.size()); }
  Index operator()(const BlockStiff& block) const {
    Index size = 0;
    for (const StiffBlock& b : block.blocks) size += stiffSize(b.part);
    return size;
  }
};

struct Written {
  Matrix operator()(const ZeroStiff& zero) const { return Matrix::Zero(zero.size, zero.size); }
  Matrix operator()(const DenseStiff& dense) const { return dense.S; }
  Matrix operator()(const ModalStiff& modal) const {
    const Index m = modal.omega.size();
    Matrix S = Matrix::Zero(2 * m, 2 * m);
    S.topRightCorner(m, m).setIdentity();
    S.bottomLeftCorner(m, m).diagonal() = -modal.omega.cwiseAbs2();
    S.bottomRightCorner(m, m).diagonal() = -modal.damping;
    return S;
  }
  Matrix operator()(const SecondOrderStiff& part) const {
    const Index m = part.stiffness.rows();
    Matrix S = Matrix::Zero(2 * m, 2 * m);
    S.topRightCorner(m, m).setIdentity();
    S.bottomLeftCorner(m, m) = -part.stiffness;
    S.bottomRightCorner(m, m) = -part.damping;
    return S;
  }
  Matrix operator()(const PairStiff& pairs) const {
    const Index m = static_cast<Index>(pairs.blocks.size());
    Matrix S = Matrix::Zero(2 * m, 2 * m);
    for (Index i = 0; i < m; ++i)
      for (Index row = 0; row < 2; ++row)
        for (Index column = 0; column < 2; ++column) S(i + row * m, i + column * m) = pairs.blocks[static_cast<std::size_t>(i)](row, column);
    return S;
  }
  Matrix operator()(const BlockStiff& block) const {
    const Index size = Size{}(block);
    Matrix S = Matrix::Zero(size, size);
    Index offset = 0;
    for (const StiffBlock& b : block.blocks) {
      const Matrix part = stiffMatrix(b.part);
      S.block(offset, offset, part.rows(), part.cols()) = part;
      offset += part.rows();
    }
    return S;
  }
};

/// sum += sign A x. Column by column: needs no temporary, whatever Eigen's product kernels do.
void addProduct(const Matrix& A, const double* x, double sign, double* sum) noexcept {
  for (Index j = 0; j < A.cols(); ++j) {
    const double* column = A.data() + j * A.rows();
    const double x_j = sign * x[j];
    for (Index i = 0; i < A.rows(); ++i) sum[i] += column[i] * x_j;
  }
}

struct Subtract {
  const double* x;
  const double* f;
  double* remainder;

  void operator()(const ZeroStiff& zero) const noexcept {
    for (Index i = 0; i < zero.size; ++i) remainder[i] = f[i];
  }
  void operator()(const DenseStiff& dense) const noexcept {
    for (Index i = 0; i < dense.S.rows(); ++i) remainder[i] = f[i];
    addProduct(dense.S, x, -1.0, remainder);
  }
  void operator()(const ModalStiff& modal) const noexcept {
    const Index m = modal.omega.size();
    const double* q = x;
    const double* v = x + m;
    for (Index i = 0; i < m; ++i) {
      const double omega = modal.omega[i];
      remainder[i] = f[i] - v[i];
      remainder[m + i] = f[m + i] + (omega * omega * q[i] + modal.damping[i] * v[i]);
    }
  }
  void operator()(const SecondOrderStiff& part) const noexcept {
    const Index m = part.stiffness.rows();
    for (Index i = 0; i < m; ++i) remainder[i] = f[i] - x[m + i];
    for (Index i = 0; i < m; ++i) remainder[m + i] = f[m + i];
    addProduct(part.stiffness, x, 1.0, remainder + m);
    addProduct(part.damping, x + m, 1.0, remainder + m);
  }
  void operator()(const PairStiff& pairs) const noexcept {
    const Index m = static_cast<Index>(pairs.blocks.size());
    for (Index i = 0; i < m; ++i) {
      const Eigen::Matrix2d& block = pairs.blocks[static_cast<std::size_t>(i)];
      remainder[i] = f[i] - (block(0, 0) * x[i] + block(0, 1) * x[m + i]);
      remainder[m + i] = f[m + i] - (block(1, 0) * x[i] + block(1, 1) * x[m + i]);
    }
  }
  void operator()(const BlockStiff& block) const noexcept {
    Subtract rest = *this;
    for (const StiffBlock& b : block.blocks) {
      std::visit(rest, b.part);
      const Index size = stiffSize(b.part);
      rest = {rest.x + size, rest.f + size, rest.remainder + size};
    }
  }
};

}  // namespace

Index stiffSize(const StiffPart& part) { return std::visit(Size{}, part); }

Matrix stiffMatrix(const StiffPart& part) { return std::visit(Written{}, part); }

void subtractStiff(const StiffPart& part, In x, In f, Out remainder) noexcept {
  std::visit(Subtract{x.data(), f.data(), remainder.data()}, part);
}

}  // namespace heerk_rotor
