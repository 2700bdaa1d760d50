#pragma once
#include <memory>

#include "heerk_rotor/core/stiff_part.hpp"

namespace heerk_rotor {

/// (I - a S)^-1 of one subsystem's stiff part, tabulated at construction.
class ImplicitPiece {
 public:
  virtual ~ImplicitPiece() = default;
  /// result = (I - a S)^-1 right. The two must not overlap.
  virtual void solve(const double* right, double* result) const noexcept = 0;
};

/// Throws std::invalid_argument when I - a S is singular.
std::unique_ptr<ImplicitPiece> makeImplicitPiece(const StiffPart& part, double a);

}  // namespace heerk_rotor
