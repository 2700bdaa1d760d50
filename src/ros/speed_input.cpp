#include "heerk_rotor/ros/speed_input.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include <ros/console.h>

namespace heerk_rotor {

SpeedInput::SpeedInput(const CoupledSystem& system) {
  const std::string ending = ".speed";
  const std::vector<std::string>& names = system.commandNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (name.size() < ending.size() || name.compare(name.size() - ending.size(), ending.size(), ending) != 0) continue;
    if (entry_ >= 0) throw std::invalid_argument("both " + names[static_cast<std::size_t>(entry_)] + " and " + name + " take the command speed");
    entry_ = static_cast<Index>(i);
    low_ = system.commandLow()[entry_];
    high_ = system.commandHigh()[entry_];
  }
}

bool SpeedInput::accept(double speed) {
  const bool finite = std::isfinite(speed);
  const double taken = finite ? std::clamp(speed, low_, high_) : 0.0;
  if (taken != speed && (finite ? clampings_ : refusals_).pass()) {
    std::ostringstream text;
    text << "speed command " << (finite ? "clamped" : "refused") << ": " << speed << " rad/s, expected [" << low_ << ", " << high_ << ']';
    ROS_WARN_STREAM(text.str());
  }
  if (finite) latest_.write(taken);
  return finite;
}

}  // namespace heerk_rotor
