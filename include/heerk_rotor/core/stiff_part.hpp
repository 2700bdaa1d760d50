#pragma once
#include <variant>
#include <vector>

#include <Eigen/StdVector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// The constant matrix S of x' = S x + f~(t, x, u) that a model hands to the exponential integrator (HEERK paper, eq. 3).
/// Each kind states its structure, because the structure decides how exactly and how fast e^{hS} is computed.

/// S = 0: the classical Runge-Kutta method.
struct ZeroStiff {
  Index size = 0;
};

/// Any constant matrix.
struct DenseStiff {
  Matrix S;  // (n x n) [1/s]
};

/// Decoupled oscillators q'' = -omega^2 q - damping q'. States are all q, then all q' (n = 2 m).
struct ModalStiff {
  Vector omega;    // (m) undamped circular frequencies, >= 0 [rad/s]
  Vector damping;  // (m) c = 2 zeta omega, >= 0 [1/s]
  bool remainder_on_rates = false;  // the model's remainder acts on q'' alone: its first m entries are always zero, written as such but not always read
};

/// A second-order system q'' = -stiffness q - damping q'. States are all q, then all q' (n = 2 m): S = [[0, I], [-stiffness, -damping]].
struct SecondOrderStiff {
  Matrix stiffness;  // M^-1 K (m x m) [1/s^2]
  Matrix damping;    // M^-1 (C + gyroscopic terms) (m x m) [1/s]
};

/// A system brought to diagonal form: state i and state m + i are one block (n = 2 m), either [[a, b], [-b, a]], a pair of complex
/// eigenvalues a +- i b, or diag(a_1, a_2), two real ones.
struct PairStiff {
  std::vector<Eigen::Matrix2d, Eigen::aligned_allocator<Eigen::Matrix2d>> blocks;  // (m) [1/s]
};

struct StiffBlock;

/// Consecutive blocks along the diagonal, each of its own kind; sizes add up to the model's state size.
struct BlockStiff {
  std::vector<StiffBlock> blocks;
};

using StiffPart = std::variant<ZeroStiff, DenseStiff, ModalStiff, SecondOrderStiff, PairStiff, BlockStiff>;

struct StiffBlock {
  StiffPart part;
};

/// Number of states a stiff part covers.
Index stiffSize(const StiffPart& part);

/// The matrix S written out.
Matrix stiffMatrix(const StiffPart& part);

/// out = f - S x, without forming S.
void subtractStiff(const StiffPart& part, In x, In f, Out remainder) noexcept;

}  // namespace heerk_rotor
