#include "heerk_rotor/ros/command_input.hpp"

#include <ros/console.h>

#include "heerk_rotor/realtime/clock.hpp"

namespace heerk_rotor {

using Verdict = CheckedCommand::Verdict;

CommandInput::CommandInput(const CommandLimits& limits, bool lock_step, std::function<void()> arrived)
    : limits_(limits), lock_step_(lock_step), arrived_(std::move(arrived)) {}

bool CommandInput::accept(const CheckedCommand& checked, CommandSource source) {
  {
    const std::lock_guard<std::mutex> lock(writers_);
    const std::string from = std::string("swashplate command (") + name(source) + ") ";
    if (checked.verdict == Verdict::kRefused) {
      ++refused_;
      warn(from + "refused: " + checked.complaint, checked.verdict);
      return false;
    }
    if (checked.verdict == Verdict::kClamped) {
      ++clamped_;
      warn(from + "clamped: " + checked.complaint, checked.verdict);
    }
    const Command command{checked.values, source, MonotonicClock().now()};
    if (!lock_step_) {
      latest_.write(command);
    } else if (!queue_.push(command)) {
      ++refused_;
      warn(from + "refused: " + std::to_string(queue_.size()) + " commands wait already; in lock step send one after the other", Verdict::kRefused);
      return false;
    }
    ++accepted_;
    last_source_ = source;
    last_arrival_ = command.arrival;
  }
  arrived_();
  return true;
}

double CommandInput::age() const {
  const std::int64_t arrival = last_arrival_;
  return arrival == 0 ? -1.0 : 1e-9 * static_cast<double>(MonotonicClock().now() - arrival);
}

void CommandInput::warn(const std::string& text, Verdict verdict) {
  if (throttles_[static_cast<int>(verdict)].pass()) ROS_WARN_STREAM(text);
}

}  // namespace heerk_rotor
