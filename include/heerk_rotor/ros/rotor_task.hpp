#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/feed.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/held_input.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"

namespace heerk_rotor {

/// What the step thread does: take the command, step, let the feed hand the instant on. Everything here runs on that thread
/// (other threads go through RealTimeLoop::call()) except where it says so.
class RotorTask : public StepTask {
 public:
  struct Options {
    double command_timeout = 0.5;                      // [s]; 0 = never
    TimeoutPolicy timeout_policy = TimeoutPolicy::kHold;
    std::uint64_t lock_step = 0;                       // steps per command; 0 = free
    std::uint64_t last_step = 0;                       // finish when this step number is reached; 0 = endless
  };

  /// Registers the feed as an observer; simulation, feed, commands and input must outlive the task.
  RotorTask(Simulation& simulation, Feed& feed, const CommandView& commands, CommandInput& input, const Options& options);

  /// Commands latched together with the swashplate command. Must outlive the task. Before the run.
  void addInput(HeldInput& input) {
    if (input.present()) held_.push_back(&input);
  }

  Result step() noexcept override;
  bool ready() noexcept override;

  /// Shows the present instant to all readers without stepping, also to those that get every n-th step only, once: where the
  /// simulation stops to wait (a pause, a reset, the end of a batch), a controller must see what it is to answer.
  void showPresent() noexcept;

  /// After a reset: the default command until another one arrives, no history.
  void startOver();
  /// After a snapshot was loaded: its command (all of w) until another one arrives, no history.
  void resume(const Vector& command);

  /// Why the last step failed, in words.
  std::string failureText() const;

  /// Any thread: source of the command in effect.
  CommandSource source() const { return feed_.source(); }

 private:
  void apply(const Command& command) noexcept;
  void latchCommand() noexcept;
  void latchHeldCommands() noexcept;
  /// The swashplate's default; what is held stays.
  void useDefault(CommandSource source) noexcept;

  Simulation& simulation_;
  Feed& feed_;
  const CommandView& commands_;
  CommandInput& input_;
  std::vector<HeldInput*> held_;     // of those that the system takes
  const Options options_;
  MonotonicClock clock_;
  Vector w_;                         // command in effect
  Command command_;                  // last one taken
  std::uint64_t granted_ = 0;        // steps left of the present command in lock step
};

}  // namespace heerk_rotor
