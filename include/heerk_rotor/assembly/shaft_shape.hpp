#pragma once
#include <array>

#include "heerk_rotor/assembly/port_range.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// The bent centre line of a shaft, for drawing: single precision, node by node from the left end. Fixed size, so that it can
/// be handed over without a lock.
struct ShaftShape {
  static constexpr int kMaxNodes = 24;
  int nodes = 0;  // entries in use; none: the shaft does not tell
  std::array<float, kMaxNodes> x{}, y{};  // displacement of the centre [m]
};

bool isFinite(const ShaftShape& shape) noexcept;

/// Finds the centre line in any coupled system, by the output port node_displacement (x, y per node).
class ShaftShapeView {
 public:
  /// Throws std::invalid_argument when two subsystems offer it or its size is odd. A shaft with more nodes than a picture
  /// needs is not drawn.
  explicit ShaftShapeView(const CoupledSystem& system);

  /// Allocation free.
  void read(const Sample& sample, ShaftShape& shape) const noexcept;

 private:
  PortRange nodes_;
};

}  // namespace heerk_rotor
