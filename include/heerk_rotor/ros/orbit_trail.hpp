#pragma once
#include <cstddef>
#include <vector>

#include "heerk_rotor/assembly/shaft_view.hpp"

namespace heerk_rotor {

/// The last readings of a shaft, for drawing orbits: those of one epoch, and of the last turns only. Takes its memory at once.
class OrbitTrail {
 public:
  static constexpr int kPointsPerTurn = 120;
  static constexpr double kTurns = 3.0;

  OrbitTrail() : readings_(static_cast<std::size_t>(kTurns * kPointsPerTurn) + 1) {}

  void add(const ShaftReading& reading);

  /// Number of readings, and the i-th of them, oldest first.
  std::size_t size() const { return count_ < readings_.size() ? count_ : readings_.size(); }
  const ShaftReading& operator[](std::size_t i) const { return readings_[(count_ - size() + i) % readings_.size()]; }

  /// The first one to be drawn: kTurns before the last.
  std::size_t begin() const;

 private:
  std::vector<ShaftReading> readings_;
  std::size_t count_ = 0;
};

}  // namespace heerk_rotor
