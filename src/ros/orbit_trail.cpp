#include "heerk_rotor/ros/orbit_trail.hpp"

#include <cmath>

namespace heerk_rotor {

void OrbitTrail::add(const ShaftReading& reading) {
  if (size() > 0 && (*this)[size() - 1].epoch != reading.epoch) count_ = 0;  // the state has jumped
  readings_[count_++ % readings_.size()] = reading;
}

std::size_t OrbitTrail::begin() const {
  constexpr double kTwoPi = 6.283185307179586476925;
  std::size_t first = size();
  while (first > 0 && std::abs((*this)[size() - 1].azimuth - (*this)[first - 1].azimuth) <= kTurns * kTwoPi) --first;
  return first;
}

}  // namespace heerk_rotor
