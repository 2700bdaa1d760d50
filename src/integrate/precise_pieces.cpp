#include "precise_pieces.hpp"

#include <algorithm>
#include <vector>

#include "heerk_rotor/integrate/precise_exponential.hpp"
#include "propagator_kinds.hpp"

namespace heerk_rotor {
namespace {

using Columns = Eigen::Map<const Vector>;
using Result = Eigen::Map<Vector>;

/// S = 0: the quadrature alone.
class ZeroPiece final : public PrecisePiece {
 public:
  ZeroPiece(Index size, double h) : size_(size), h_(h) {}
  void complete(const double*, const double* r, double* f) const noexcept override {
    if (f != r) std::copy_n(r, size_, f);
  }
  void combine(const double* x, const double* r, Index stride, double* result) const noexcept override {
    for (Index i = 0; i < size_; ++i) {
      double sum = 0.0;
      for (Index k = 0; k < 4; ++k) sum += kPreciseWeight[static_cast<std::size_t>(k)] * r[k * stride + i];
      result[i] = x[i] + h_ * sum;
    }
  }

 private:
  Index size_;
  double h_;
};

/// The four matrices h w_i e^{(1 - c_i) h S}; the last is h w_4 I.
std::vector<Matrix> weightedExponentials(const Matrix& S, double h) {
  std::vector<Matrix> result;
  for (std::size_t i = 0; i < 4; ++i) result.push_back(h * kPreciseWeight[i] * preciseExponential(S, (1.0 - kPreciseNode[i]) * h));
  return result;
}

/// As first published: full matrices times full vectors, zero and identity blocks included (eq. 9 and 13).
class DensePiece final : public PrecisePiece {
 public:
  DensePiece(const Matrix& S, double h) : S_(S), e_(preciseExponential(S, h)), weighted_(weightedExponentials(S, h)) {}
  void complete(const double* x, const double* r, double* f) const noexcept override {
    if (f != r) std::copy_n(r, S_.rows(), f);
    Result(f, S_.rows()).noalias() += S_ * Columns(x, S_.rows());
  }
  void combine(const double* x, const double* r, Index stride, double* result) const noexcept override {
    const Index n = S_.rows();
    Result to(result, n);
    to.noalias() = e_ * Columns(x, n);
    for (std::size_t i = 0; i < 3; ++i) to.noalias() += weighted_[i] * Columns(r + static_cast<Index>(i) * stride, n);
    to += weighted_[3](0, 0) * Columns(r + 3 * stride, n);
  }

 private:
  Matrix S_, e_;
  std::vector<Matrix> weighted_;
};

/// Sub-blocks (eq. 11 and 14): S = [[0, I], [-A, -D]] is never multiplied by its zeros and ones, and a remainder that acts on the rates only meets the
/// right half of each exponential. (Printed with M^-1 twice in eq. 11 and without the gyroscopic term in eq. 14.)
class SecondOrderPiece final : public PrecisePiece {
 public:
  SecondOrderPiece(const SecondOrderStiff& part, double h) : m_(part.stiffness.rows()), lower_(m_, 2 * m_), dense_(stiffMatrix(part), h) {
    lower_ << -part.stiffness, -part.damping;
    const Matrix S = stiffMatrix(part);
    e_ = preciseExponential(S, h);
    for (const Matrix& weighted : weightedExponentials(S, h)) right_.push_back(weighted.rightCols(m_));
  }
  void complete(const double* x, const double* r, double* f) const noexcept override {
    if (f != r) std::copy_n(r, 2 * m_, f);
    Result(f, m_) += Columns(x + m_, m_);
    Result(f + m_, m_).noalias() += lower_ * Columns(x, 2 * m_);
  }
  void combine(const double* x, const double* r, Index stride, double* result) const noexcept override {
    bool rates_only = true;
    for (Index i = 0; i < 4; ++i) rates_only = rates_only && (Columns(r + i * stride, m_).array() == 0.0).all();
    if (!rates_only) return dense_.combine(x, r, stride, result);
    Result to(result, 2 * m_);
    to.noalias() = e_ * Columns(x, 2 * m_);
    for (std::size_t i = 0; i < 3; ++i) to.noalias() += right_[i] * Columns(r + static_cast<Index>(i) * stride + m_, m_);
    to.tail(m_) += right_[3](m_, 0) * Columns(r + 3 * stride + m_, m_);
  }

 private:
  Index m_;
  Matrix lower_, e_;             // (m x 2m) [-A, -D]; (2m x 2m)
  std::vector<Matrix> right_;    // (2m x m) each
  DensePiece dense_;             // for models whose remainder acts on the displacements too
};

/// The sum without its last term as row 4 of a table for LinearPropagator; the other rows are never used.
const Tableau& quadrature() {
  static const Tableau table = [] {
    Tableau t{"precise quadrature", kPreciseOrder, "Liu & Zhang, eq. 9", true, {kPreciseNode.begin(), kPreciseNode.end()}, {}};
    for (int row = 0; row <= 4; ++row) t.rows.emplace_back(static_cast<std::size_t>(row));
    for (std::size_t i = 0; i < 3; ++i) t.rows[4][i] = {{0, 1.0 - kPreciseNode[i], kPreciseWeight[i]}};
    return t;
  }();
  return table;
}

/// Decoupled pairs, exponentials in closed form.
class PairsPiece final : public PrecisePiece {
 public:
  PairsPiece(const ModalStiff& part, double h) : m_(part.omega.size()), h_(h), row_(makeModalPropagator(part, h, quadrature())), block_(4, m_) {
    for (Index i = 0; i < m_; ++i) block_.col(i) << 0.0, 1.0, -part.omega[i] * part.omega[i], -part.damping[i];
  }
  PairsPiece(const PairStiff& part, double h) : m_(static_cast<Index>(part.blocks.size())), h_(h), row_(makePairPropagator(part, h, quadrature())), block_(4, m_) {
    for (Index i = 0; i < m_; ++i) {
      const Eigen::Matrix2d& b = part.blocks[static_cast<std::size_t>(i)];
      block_.col(i) << b(0, 0), b(0, 1), b(1, 0), b(1, 1);
    }
  }
  void complete(const double* x, const double* r, double* f) const noexcept override {
    for (Index i = 0; i < m_; ++i) {
      const double first = x[i], second = x[m_ + i];
      f[i] = r[i] + block_(0, i) * first + block_(1, i) * second;
      f[m_ + i] = r[m_ + i] + block_(2, i) * first + block_(3, i) * second;
    }
  }
  void combine(const double* x, const double* r, Index stride, double* result) const noexcept override {
    row_->combine(4, x, r, stride, result);
    Result(result, 2 * m_) += h_ * kPreciseWeight[3] * Columns(r + 3 * stride, 2 * m_);
  }

 private:
  Index m_;
  double h_;
  std::unique_ptr<LinearPropagator> row_;
  Matrix block_;  // (4 x m) of each pair: entries 11, 12, 21, 22 of S
};

/// Consecutive blocks along the diagonal, each of its own kind.
class BlockPiece final : public PrecisePiece {
 public:
  BlockPiece(PreciseVariant variant, const BlockStiff& part, double h) {
    Index begin = 0;
    for (const StiffBlock& block : part.blocks) {
      if (stiffSize(block.part) > 0) pieces_.push_back({begin, makePrecisePiece(variant, block.part, h)});
      begin += stiffSize(block.part);
    }
  }
  void complete(const double* x, const double* r, double* f) const noexcept override {
    for (const Piece& piece : pieces_) piece.of->complete(x + piece.begin, r + piece.begin, f + piece.begin);
  }
  void combine(const double* x, const double* r, Index stride, double* result) const noexcept override {
    for (const Piece& piece : pieces_) piece.of->combine(x + piece.begin, r + piece.begin, stride, result + piece.begin);
  }

 private:
  struct Piece {
    Index begin;
    std::unique_ptr<PrecisePiece> of;
  };
  std::vector<Piece> pieces_;
};

struct Make {
  PreciseVariant variant;
  double h;
  using Made = std::unique_ptr<PrecisePiece>;

  Made operator()(const ZeroStiff& zero) const { return std::make_unique<ZeroPiece>(zero.size, h); }
  Made operator()(const DenseStiff& dense) const { return std::make_unique<DensePiece>(dense.S, h); }
  Made operator()(const ModalStiff& part) const { return pairsOrDense(part); }
  Made operator()(const PairStiff& part) const { return pairsOrDense(part); }
  Made operator()(const SecondOrderStiff& part) const {
    if (variant == PreciseVariant::kDense) return std::make_unique<DensePiece>(stiffMatrix(part), h);
    return std::make_unique<SecondOrderPiece>(part, h);
  }
  Made operator()(const BlockStiff& part) const { return std::make_unique<BlockPiece>(variant, part, h); }

  template <typename Part>
  Made pairsOrDense(const Part& part) const {
    if (variant == PreciseVariant::kDense) return std::make_unique<DensePiece>(stiffMatrix(part), h);
    return std::make_unique<PairsPiece>(part, h);
  }
};

}  // namespace

std::unique_ptr<PrecisePiece> makePrecisePiece(PreciseVariant variant, const StiffPart& part, double h) { return std::visit(Make{variant, h}, part); }

}  // namespace heerk_rotor
