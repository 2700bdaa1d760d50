#include "heerk_rotor/core/stiff_part.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace heerk_rotor {
namespace {

ModalStiff twoModes() {
  ModalStiff modal;
  modal.omega.resize(2);
  modal.omega << 3.0, 0.0;
  modal.damping.resize(2);
  modal.damping << 0.5, 7.0;
  return modal;
}

DenseStiff dense() {
  DenseStiff part;
  part.S.resize(3, 3);
  part.S << -1.0, 2.0, 0.0, 4.0, -5.0, 6.0, 0.5, 0.25, -9.0;
  return part;
}

SecondOrderStiff secondOrder() {
  SecondOrderStiff part;
  part.stiffness.resize(2, 2);
  part.stiffness << 4.0, -1.0, -2.0, 3.0;
  part.damping.resize(2, 2);
  part.damping << 0.5, 0.25, -0.125, 1.0;
  return part;
}

PairStiff pairs() {
  PairStiff part;
  part.blocks.resize(2);
  part.blocks[0] << -0.5, 3.0, -3.0, -0.5;
  part.blocks[1] << -2.0, 0.0, 0.0, -7.0;
  return part;
}

/// Every kind, one of them nested twice.
StiffPart everything() {
  BlockStiff inner;
  inner.blocks.push_back({twoModes()});
  inner.blocks.push_back({ZeroStiff{0}});
  BlockStiff outer;
  outer.blocks.push_back({ZeroStiff{2}});
  outer.blocks.push_back({inner});
  outer.blocks.push_back({dense()});
  outer.blocks.push_back({secondOrder()});
  outer.blocks.push_back({pairs()});
  return outer;
}

TEST(StiffPart, sizeCountsTwoStatesPerModeAndAddsUpBlocks) {
  EXPECT_EQ(stiffSize(ZeroStiff{5}), 5);
  EXPECT_EQ(stiffSize(dense()), 3);
  EXPECT_EQ(stiffSize(twoModes()), 4);
  EXPECT_EQ(stiffSize(secondOrder()), 4);
  EXPECT_EQ(stiffSize(pairs()), 4);
  EXPECT_EQ(stiffSize(everything()), 2 + 4 + 3 + 4 + 4);
  EXPECT_EQ(stiffSize(BlockStiff{}), 0);
}

TEST(StiffPart, modalMatrixIsAllPositionsThenAllVelocities) {
  Matrix expected(4, 4);
  expected << 0, 0, 1, 0,  //
      0, 0, 0, 1,          //
      -9, 0, -0.5, 0,      //
      0, 0, 0, -7;
  EXPECT_EQ(stiffMatrix(twoModes()), expected);
}

TEST(StiffPart, secondOrderMatrixIsAllPositionsThenAllVelocities) {
  Matrix expected(4, 4);
  expected << 0, 0, 1, 0,  //
      0, 0, 0, 1,          //
      -4, 1, -0.5, -0.25,  //
      2, -3, 0.125, -1;
  EXPECT_EQ(stiffMatrix(secondOrder()), expected);
}

TEST(StiffPart, pairMatrixCouplesStateIWithStateMPlusI) {
  Matrix expected(4, 4);
  expected << -0.5, 0, 3, 0,  //
      0, -2, 0, 0,            //
      -3, 0, -0.5, 0,         //
      0, 0, 0, -7;
  EXPECT_EQ(stiffMatrix(pairs()), expected);
}

TEST(StiffPart, blockMatrixHasItsPiecesOnTheDiagonalAndNothingElse) {
  const Matrix S = stiffMatrix(everything());
  ASSERT_EQ(S.rows(), 17);
  Matrix expected = Matrix::Zero(17, 17);
  expected.block(2, 2, 4, 4) = stiffMatrix(twoModes());
  expected.block(6, 6, 3, 3) = dense().S;
  expected.block(9, 9, 4, 4) = stiffMatrix(secondOrder());
  expected.block(13, 13, 4, 4) = stiffMatrix(pairs());
  EXPECT_EQ(S, expected);
}

TEST(StiffPart, subtractingIsFMinusSTimesXForEveryKind) {
  for (const StiffPart& part : {StiffPart(ZeroStiff{4}), StiffPart(dense()), StiffPart(twoModes()), StiffPart(secondOrder()), StiffPart(pairs()), everything()}) {
    const Index n = stiffSize(part);
    const Vector x = Vector::LinSpaced(n, -1.0, 2.0);
    const Vector f = Vector::LinSpaced(n, 5.0, 3.0);
    Vector remainder(n);
    subtractStiff(part, view(x), view(f), view(remainder));
    // Sums of at most three products of size <= 20: a few roundings.
    EXPECT_LE((remainder - (f - stiffMatrix(part) * x)).cwiseAbs().maxCoeff(), 100 * std::numeric_limits<double>::epsilon());
  }
}

TEST(StiffPart, subtractingInPlaceGivesTheSame) {
  const StiffPart part = everything();
  const Index n = stiffSize(part);
  const Vector x = Vector::LinSpaced(n, -1.0, 2.0), f = Vector::LinSpaced(n, 5.0, 3.0);
  Vector apart(n), in_place = f;
  subtractStiff(part, view(x), view(f), view(apart));
  subtractStiff(part, view(x), In(in_place.data(), n), view(in_place));
  EXPECT_EQ(in_place, apart);
}

TEST(StiffPart, zeroLeavesFUntouchedBitForBit) {
  const Vector x = Vector::Constant(3, 1e300), f = Vector::LinSpaced(3, 0.1, 0.3);
  Vector remainder(3);
  subtractStiff(ZeroStiff{3}, view(x), view(f), view(remainder));
  EXPECT_EQ(remainder, f);
}

TEST(StiffPart, subtractingIsNoexcept) {
  static_assert(std::is_same_v<decltype(&subtractStiff), void (*)(const StiffPart&, In, In, Out) noexcept>);
}

}  // namespace
}  // namespace heerk_rotor
