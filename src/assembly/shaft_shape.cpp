#include "heerk_rotor/assembly/shaft_shape.hpp"

#include <stdexcept>
#include <string>

namespace heerk_rotor {

bool isFinite(const ShaftShape& shape) noexcept {
  float sum = 0.0f;
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape.nodes); ++i) sum += 0.0f * shape.x[i] + 0.0f * shape.y[i];
  return sum == 0.0f;
}

ShaftShapeView::ShaftShapeView(const CoupledSystem& system) : nodes_(findPort(system, "shaft shape", "node_displacement", 0)) {
  if (nodes_.size % 2 != 0) throw std::invalid_argument("shaft shape: node_displacement has " + std::to_string(nodes_.size) + " entries, expected an even number (x, y, x, y, ..)");
  if (nodes_.size > 2 * ShaftShape::kMaxNodes) nodes_ = PortRange();
}

void ShaftShapeView::read(const Sample& sample, ShaftShape& shape) const noexcept {
  shape.nodes = static_cast<int>(nodes_.size / 2);
  for (Index i = 0; i < shape.nodes; ++i) {
    shape.x[static_cast<std::size_t>(i)] = static_cast<float>(sample.y[nodes_.begin + 2 * i]);
    shape.y[static_cast<std::size_t>(i)] = static_cast<float>(sample.y[nodes_.begin + 2 * i + 1]);
  }
}

}  // namespace heerk_rotor
