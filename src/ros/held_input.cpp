#include "heerk_rotor/ros/held_input.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <ros/console.h>

namespace heerk_rotor {

HeldInput::HeldInput(const CoupledSystem& system, const std::string& name, const std::vector<Index>& entries, const std::vector<std::string>& units)
    : name_(name) {
  if (entries.size() > kMaxSize) throw std::invalid_argument(name + ": " + std::to_string(entries.size()) + " components, expected at most " + std::to_string(kMaxSize));
  for (const Index entry : entries) {
    const std::string& full = system.commandNames()[static_cast<std::size_t>(entry)];
    components_.push_back({entry, full.substr(full.rfind('.') + 1), units[std::min(components_.size(), units.size() - 1)], system.commandLow()[entry], system.commandHigh()[entry]});
  }
}

std::string HeldInput::complaint(const std::vector<double>& values, std::size_t i) const {
  const Component& component = components_[i];
  std::ostringstream text;
  text << component.name << " = " << values[i] << ' ' << component.unit << ", expected ";
  if (std::isinf(component.low) && std::isinf(component.high)) text << "a finite number";
  else text << '[' << component.low << ", " << component.high << ']';
  return text.str();
}

bool HeldInput::accept(const std::vector<double>& values) {
  if (!present()) {
    if (!absence_reported_) ROS_WARN_STREAM(name_ << " ignored: no subsystem of the configuration takes it");
    absence_reported_ = true;
    return false;
  }
  if (values.size() != components_.size()) {
    refuse(std::to_string(values.size()) + " numbers, expected " + std::to_string(components_.size()));
    return false;
  }
  Values taken{};
  std::string clamped;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      refuse(complaint(values, i));
      return false;
    }
    taken[i] = std::clamp(values[i], components_[i].low, components_[i].high);
    if (taken[i] != values[i] && clamped.empty()) clamped = complaint(values, i);
  }
  if (!clamped.empty() && clampings_.pass()) ROS_WARN_STREAM(name_ << " clamped: " << clamped);
  latest_.write(taken);
  return true;
}

void HeldInput::refuse(const std::string& reason) {
  if (refusals_.pass()) ROS_WARN_STREAM(name_ << " refused: " << reason);
}

bool HeldInput::takeInto(Vector& w) noexcept {
  Values values;
  if (!latest_.read(values)) return false;
  for (std::size_t i = 0; i < components_.size(); ++i) w[components_[i].entry] = values[i];
  return true;
}

void HeldInput::forget() noexcept {
  Values stale;
  latest_.read(stale);
}

}  // namespace heerk_rotor
