#pragma once
#include <array>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/ros/warning_throttle.hpp"

namespace heerk_rotor {

/// Where commands of one kind enter that hold until the next one (rotor speed, wind, external wrench): checked here, then handed
/// to the step thread without making it wait. All components of a message count together or not at all.
class HeldInput {
 public:
  static constexpr std::size_t kMaxSize = 6;

  /// `name` as in warnings ("wind"); `entries` of w in the order of the components, as CommandView found them (none: not present()),
  /// whose ranges count; `units` of the components, the last one for all further ones.
  HeldInput(const CoupledSystem& system, const std::string& name, const std::vector<Index>& entries, const std::vector<std::string>& units);

  bool present() const { return !components_.empty(); }

  /// One thread at a time, not the step thread. `values` has as many numbers as there are entries. Refuses what is not finite,
  /// clamps what is out of range; either with a warning, at most once a second each. Returns whether the command was taken.
  /// Without entries: refused; the first time with a warning that says so.
  bool accept(const std::vector<double>& values);

  /// Refuses a message for another reason, with a warning.
  void refuse(const std::string& reason);

  /// Step thread: writes the newest command into w; false when there is none since the last call.
  bool takeInto(Vector& w) noexcept;
  /// Step thread: forgets a command that has not been taken yet.
  void forget() noexcept;

 private:
  struct Component {
    Index entry;         // of w
    std::string name;    // "wind_x"
    std::string unit;
    double low, high;
  };
  using Values = std::array<double, kMaxSize>;
  std::string complaint(const std::vector<double>& values, std::size_t i) const;

  const std::string name_;
  std::vector<Component> components_;
  bool absence_reported_ = false;
  LatestValue<Values> latest_;
  WarningThrottle refusals_, clampings_;
};

}  // namespace heerk_rotor
