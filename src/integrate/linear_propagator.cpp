#include "heerk_rotor/integrate/linear_propagator.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "propagator_kinds.hpp"

namespace heerk_rotor {
namespace {

/// Blocks along the diagonal, each propagated by its own kind.
class BlockPropagator final : public LinearPropagator {
 public:
  struct Piece {
    Index offset;
    std::unique_ptr<LinearPropagator> propagator;
  };

  explicit BlockPropagator(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  void combine(int row, const double* x, const double* remainders, Index stride, double* result) const noexcept override {
    for (const Piece& piece : pieces_)
      piece.propagator->combine(row, x + piece.offset, remainders + piece.offset, stride, result + piece.offset);
  }

  void propagate(int row, const double* x, double* result) const noexcept override {
    for (const Piece& piece : pieces_) piece.propagator->propagate(row, x + piece.offset, result + piece.offset);
  }

 private:
  std::vector<Piece> pieces_;
};

/// Nested blocks as one list; neighbouring zero blocks as one, empty ones gone: a coupled system of many small models
/// with S = 0 becomes a single pass over its states.
void flatten(const StiffPart& part, std::vector<StiffPart>& pieces) {
  if (const auto* block = std::get_if<BlockStiff>(&part)) {
    for (const StiffBlock& b : block->blocks) flatten(b.part, pieces);
    return;
  }
  if (stiffSize(part) == 0) return;
  ZeroStiff* last = pieces.empty() ? nullptr : std::get_if<ZeroStiff>(&pieces.back());
  if (const auto* zero = std::get_if<ZeroStiff>(&part); zero && last)
    last->size += zero->size;
  else
    pieces.push_back(part);
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw std::invalid_argument("stiff part" + where + ": " + what);
}

/// Throws with the path of the wrong block, e.g. "stiff part.blocks[2].blocks[0]: ...".
void validate(const StiffPart& part, const std::string& where) {
  if (const auto* zero = std::get_if<ZeroStiff>(&part)) {
    if (zero->size < 0) refuse(where, "size is " + std::to_string(zero->size) + ", expected >= 0");
  } else if (const auto* dense = std::get_if<DenseStiff>(&part)) {
    if (dense->S.rows() != dense->S.cols())
      refuse(where, "S is " + std::to_string(dense->S.rows()) + " x " + std::to_string(dense->S.cols()) + ", expected square");
    if (!dense->S.allFinite()) refuse(where, "S has entries that are not finite");
  } else if (const auto* modal = std::get_if<ModalStiff>(&part)) {
    if (modal->omega.size() != modal->damping.size())
      refuse(where, std::to_string(modal->omega.size()) + " omega [rad/s] but " + std::to_string(modal->damping.size()) +
                        " damping [1/s], expected as many");
    for (Index i = 0; i < modal->omega.size(); ++i)
      for (double value : {modal->omega[i], modal->damping[i]})
        if (!(value >= 0.0 && std::isfinite(value)))
          refuse(where, "mode " + std::to_string(i) + " has omega = " + std::to_string(modal->omega[i]) + " rad/s, damping = " +
                            std::to_string(modal->damping[i]) +
                            " 1/s, expected finite and >= 0; hint: negative damping belongs into f~ or a dense S");
  } else if (const auto* second = std::get_if<SecondOrderStiff>(&part)) {
    for (const Matrix* matrix : {&second->stiffness, &second->damping}) {
      if (matrix->rows() != matrix->cols() || matrix->rows() != second->stiffness.rows())
        refuse(where, "stiffness is " + std::to_string(second->stiffness.rows()) + " x " + std::to_string(second->stiffness.cols()) + ", damping " +
                          std::to_string(second->damping.rows()) + " x " + std::to_string(second->damping.cols()) + ", expected square and of one size");
      if (!matrix->allFinite()) refuse(where, "stiffness or damping has entries that are not finite");
    }
  } else if (const auto* pairs = std::get_if<PairStiff>(&part)) {
    for (std::size_t i = 0; i < pairs->blocks.size(); ++i) {
      const Eigen::Matrix2d& b = pairs->blocks[i];
      const bool rotation = b(0, 0) == b(1, 1) && b(0, 1) == -b(1, 0), diagonal = b(0, 1) == 0.0 && b(1, 0) == 0.0;
      if (!b.allFinite() || !(rotation || diagonal))
        refuse(where, "pair " + std::to_string(i) + " is [[" + std::to_string(b(0, 0)) + ", " + std::to_string(b(0, 1)) + "], [" + std::to_string(b(1, 0)) + ", " +
                          std::to_string(b(1, 1)) + "]], expected finite [[a, b], [-b, a]] or a diagonal");
    }
  } else {
    const auto& blocks = std::get<BlockStiff>(part).blocks;
    for (std::size_t i = 0; i < blocks.size(); ++i) validate(blocks[i].part, where + ".blocks[" + std::to_string(i) + "]");
  }
}

struct Make {
  double h;
  const Tableau& tableau;

  std::unique_ptr<LinearPropagator> operator()(const ZeroStiff& zero) const { return makeZeroPropagator(zero.size, h, tableau); }
  std::unique_ptr<LinearPropagator> operator()(const DenseStiff& dense) const { return makeDensePropagator(dense, h, tableau); }
  std::unique_ptr<LinearPropagator> operator()(const ModalStiff& modal) const { return makeModalPropagator(modal, h, tableau); }
  std::unique_ptr<LinearPropagator> operator()(const SecondOrderStiff& part) const { return makeDensePropagator({stiffMatrix(part)}, h, tableau); }
  std::unique_ptr<LinearPropagator> operator()(const PairStiff& pairs) const { return makePairPropagator(pairs, h, tableau); }
  std::unique_ptr<LinearPropagator> operator()(const BlockStiff& block) const {
    std::vector<StiffPart> parts;
    flatten(block, parts);
    if (parts.empty()) return makeZeroPropagator(0, h, tableau);
    if (parts.size() == 1) return std::visit(*this, parts.front());
    std::vector<BlockPropagator::Piece> pieces;
    Index offset = 0;
    for (const StiffPart& part : parts) {
      pieces.push_back({offset, std::visit(*this, part)});
      offset += stiffSize(part);
    }
    return std::make_unique<BlockPropagator>(std::move(pieces));
  }
};

}  // namespace

std::unique_ptr<LinearPropagator> makePropagator(const StiffPart& part, double h, const Tableau& tableau) {
  if (!(h > 0.0 && std::isfinite(h))) throw std::invalid_argument("makePropagator: h = " + std::to_string(h) + " s, expected finite and > 0");
  if (const std::string wrong = check(tableau); !wrong.empty()) throw std::invalid_argument("tableau " + tableau.name + ": " + wrong);
  validate(part, "");
  if (!tableau.exponential) return makeZeroPropagator(stiffSize(part), h, tableau);
  return std::visit(Make{h, tableau}, part);
}

}  // namespace heerk_rotor
