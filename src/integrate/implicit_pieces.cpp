#include "implicit_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/LU>

namespace heerk_rotor {
namespace {

class IdentityPiece final : public ImplicitPiece {
 public:
  explicit IdentityPiece(Index size) : size_(size) {}
  void solve(const double* right, double* result) const noexcept override { std::copy_n(right, size_, result); }

 private:
  Index size_;
};

Matrix inverseOf(const Matrix& matrix) {
  const Matrix inverse = matrix.partialPivLu().inverse();
  if (!inverse.allFinite()) throw std::invalid_argument("Newmark: I - h/2 S is singular; hint: another step, or less stiffness that feeds itself in S");
  return inverse;
}

class DensePiece final : public ImplicitPiece {
 public:
  explicit DensePiece(const Matrix& matrix) : inverse_(inverseOf(matrix)) {}
  void solve(const double* right, double* result) const noexcept override {
    const Index n = inverse_.rows();
    Eigen::Map<Vector>(result, n).noalias() = inverse_ * Eigen::Map<const Vector>(right, n);
  }

 private:
  Matrix inverse_;
};

/// [[I, -a], [a A, I + a D]] [q; v] = [r_q; r_v]: eliminating q leaves the effective stiffness of Newmark's method, I + a D + a^2 A.
class SecondOrderPiece final : public ImplicitPiece {
 public:
  SecondOrderPiece(const SecondOrderStiff& part, double a) : a_(a), m_(part.stiffness.rows()), of_(m_, 2 * m_) {
    const Matrix effective = inverseOf(Matrix::Identity(m_, m_) + a * part.damping + a * a * part.stiffness);
    of_ << -a * effective * part.stiffness, effective;
  }
  void solve(const double* right, double* result) const noexcept override {
    const Eigen::Map<const Vector> r(right, 2 * m_);
    Eigen::Map<Vector> q(result, m_), v(result + m_, m_);
    v.noalias() = of_ * r;
    q = r.head(m_) + a_ * v;
  }

 private:
  double a_;
  Index m_;
  Matrix of_;  // (m x 2m): v from r_q and r_v
};

class PairsPiece final : public ImplicitPiece {
 public:
  explicit PairsPiece(const std::vector<Eigen::Matrix2d, Eigen::aligned_allocator<Eigen::Matrix2d>>& blocks) : m_(static_cast<Index>(blocks.size())), inverse_(m_, 4) {
    for (Index i = 0; i < m_; ++i) {
      const Matrix inverse = inverseOf(blocks[static_cast<std::size_t>(i)]);
      inverse_.row(i) << inverse(0, 0), inverse(0, 1), inverse(1, 0), inverse(1, 1);
    }
  }
  void solve(const double* right, double* result) const noexcept override {
    const Eigen::Map<const Eigen::ArrayXd> first(right, m_), second(right + m_, m_);
    Eigen::Map<Eigen::ArrayXd>(result, m_) = inverse_.col(0) * first + inverse_.col(1) * second;
    Eigen::Map<Eigen::ArrayXd>(result + m_, m_) = inverse_.col(2) * first + inverse_.col(3) * second;
  }

 private:
  Index m_;
  Eigen::Array<double, Eigen::Dynamic, 4> inverse_;  // of each pair: entries 11, 12, 21, 22
};

class BlockPiece final : public ImplicitPiece {
 public:
  BlockPiece(const BlockStiff& part, double a) {
    Index begin = 0;
    for (const StiffBlock& block : part.blocks) {
      if (stiffSize(block.part) > 0) pieces_.push_back({begin, makeImplicitPiece(block.part, a)});
      begin += stiffSize(block.part);
    }
  }
  void solve(const double* right, double* result) const noexcept override {
    for (const Piece& piece : pieces_) piece.of->solve(right + piece.begin, result + piece.begin);
  }

 private:
  struct Piece {
    Index begin;
    std::unique_ptr<ImplicitPiece> of;
  };
  std::vector<Piece> pieces_;
};

struct Make {
  double a;
  using Made = std::unique_ptr<ImplicitPiece>;

  Made operator()(const ZeroStiff& zero) const { return std::make_unique<IdentityPiece>(zero.size); }
  Made operator()(const DenseStiff& dense) const { return std::make_unique<DensePiece>(Matrix::Identity(dense.S.rows(), dense.S.rows()) - a * dense.S); }
  Made operator()(const SecondOrderStiff& part) const { return std::make_unique<SecondOrderPiece>(part, a); }
  Made operator()(const ModalStiff& modal) const {
    PairStiff pairs;
    for (Index i = 0; i < modal.omega.size(); ++i) {
      Eigen::Matrix2d block;
      block << 0.0, 1.0, -modal.omega[i] * modal.omega[i], -modal.damping[i];
      pairs.blocks.push_back(block);
    }
    return (*this)(pairs);
  }
  Made operator()(const PairStiff& part) const {
    PairStiff implicit = part;
    for (Eigen::Matrix2d& block : implicit.blocks) block = (Eigen::Matrix2d::Identity() - a * block).eval();
    return std::make_unique<PairsPiece>(implicit.blocks);
  }
  Made operator()(const BlockStiff& part) const { return std::make_unique<BlockPiece>(part, a); }
};

}  // namespace

std::unique_ptr<ImplicitPiece> makeImplicitPiece(const StiffPart& part, double a) { return std::visit(Make{a}, part); }

}  // namespace heerk_rotor
