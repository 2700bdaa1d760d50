#pragma once
#include <atomic>
#include <functional>
#include <mutex>

#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/ros/command_gate.hpp"
#include "heerk_rotor/ros/warning_throttle.hpp"

namespace heerk_rotor {

/// Where commands from any source enter: checked here, then handed to the step thread without making it wait. Run freely,
/// the newest arrival counts; in lock step every one does, in order.
class CommandInput {
 public:
  /// `lock_step`: commands are queued. `arrived` is called after each accepted one (to wake the loop).
  CommandInput(const CommandLimits& limits, bool lock_step, std::function<void()> arrived);

  /// Any thread but the step thread. Logs (at most once a second per verdict) what was refused or clamped.
  /// Returns whether the command was taken.
  bool accept(const CheckedCommand& command, CommandSource source);
  bool accept(const std::array<double, 3>& values, CommandSource source) { return accept(checkCommand(values, limits_), source); }
  bool accept(const std::vector<double>& values, CommandSource source) { return accept(checkCommand(values, limits_), source); }

  /// Step thread: true when there is a new command.
  bool take(Command& command) noexcept { return lock_step_ ? queue_.pop(command) : latest_.read(command); }

  // For diagnostics; any thread.
  std::uint64_t accepted() const { return accepted_; }
  std::uint64_t clamped() const { return clamped_; }
  std::uint64_t refused() const { return refused_; }
  CommandSource lastSource() const { return last_source_; }
  /// Age of the last accepted command by arrival [s]; negative: none yet.
  double age() const;

 private:
  static constexpr std::size_t kQueue = 64;
  void warn(const std::string& text, CheckedCommand::Verdict verdict);

  const CommandLimits limits_;
  const bool lock_step_;
  const std::function<void()> arrived_;
  std::mutex writers_;  // ROS and LCM threads among themselves; the step thread never takes it
  LatestValue<Command> latest_;
  SnapshotRing<Command> queue_{kQueue};
  WarningThrottle throttles_[3];  // one per verdict
  std::atomic<std::uint64_t> accepted_{0}, clamped_{0}, refused_{0};
  std::atomic<CommandSource> last_source_{CommandSource::kNone};
  std::atomic<std::int64_t> last_arrival_{0};
};

}  // namespace heerk_rotor
