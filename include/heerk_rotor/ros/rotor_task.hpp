#pragma once
#include <atomic>
#include <string>
#include <vector>

#include "heerk_rotor/assembly/blade_shapes.hpp"
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/realtime/rotor_instant.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/held_input.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"

namespace heerk_rotor {

/// What the step thread does: take the command, step, hand the instant to the rings. Everything here runs on that thread
/// (other threads go through RealTimeLoop::call()) except where it says so.
class RotorTask : public StepTask, public Observer {
 public:
  struct Options {
    double command_timeout = 0.5;                      // [s]; 0 = never
    TimeoutPolicy timeout_policy = TimeoutPolicy::kHold;
    std::uint64_t lock_step = 0;                       // steps per command; 0 = free
    std::uint64_t last_step = 0;                       // finish when this step number is reached; 0 = endless
    std::size_t history = 0;                           // instants kept for the report of a failure
  };

  /// Registers itself as an observer; simulation, view and input must outlive it.
  RotorTask(Simulation& simulation, RotorView& view, CommandInput& input, const Options& options);

  /// Adds a reader that gets every n-th step. A lossless one makes the task wait for space until `stop` is true (runs as
  /// fast as possible only). Before the run.
  void addRing(RotorRing& ring, std::uint64_t every);
  void addLosslessRing(RotorRing& ring, const std::atomic<bool>& stop);

  /// Commands latched together with the swashplate command. Must outlive the task. Before the run.
  void addInput(HeldInput& input) {
    if (input.present()) held_.push_back(&input);
  }

  Result step() noexcept override;
  bool ready() noexcept override;
  void observe(const Sample& sample) noexcept override;

  /// Shows the present instant to all readers without stepping, also to those that get every n-th step only, once: where the
  /// simulation stops to wait (a pause, a reset, the end of a batch), a controller must see what it is to answer.
  void showPresent() noexcept;

  /// After a reset: the default command until another one arrives, no history.
  void startOver();
  /// After a snapshot was loaded: its command (all of w) until another one arrives, no history.
  void resume(const Vector& command);

  /// Instants of this epoch before the present one, oldest first, up to one per kept step.
  std::vector<RotorInstant> history() const;
  /// Why the last step failed, in words.
  std::string failureText() const;

  /// Newest instant with the shape of the blades, for readers that want no other; one reading thread.
  LatestValue<RotorPicture>& newest() { return newest_; }

  /// Any thread: source of the command in effect.
  CommandSource source() const { return source_in_effect_; }

 private:
  struct Reader {
    RotorRing* ring;
    std::uint64_t every;
    const std::atomic<bool>* stop;  // lossless when set
    bool served = false;            // with instant_
  };
  void apply(const Command& command) noexcept;
  void latchCommand() noexcept;
  void latchHeldCommands() noexcept;
  /// The swashplate's default; what is held stays.
  void useDefault(CommandSource source) noexcept;
  void take(const Sample& sample) noexcept;
  void handOut() noexcept;

  Simulation& simulation_;
  RotorView& view_;
  CommandInput& input_;
  std::vector<HeldInput*> held_;     // of those that the system takes
  const Options options_;
  MonotonicClock clock_;
  std::vector<Reader> readers_;
  const BladeShapeView blade_view_;
  LatestValue<RotorPicture> newest_;
  Vector w_;                         // command in effect
  Command command_;                  // last one taken
  RotorPicture picture_;             // last one shown
  RotorInstant& instant_ = picture_.instant;
  bool shown_ = false;               // instant_ holds something
  bool to_everyone_ = false;         // showPresent() is at work
  bool output_not_finite_ = false;
  std::uint64_t granted_ = 0;        // steps left of the present command in lock step
  std::vector<RotorInstant> history_;
  std::uint64_t history_count_ = 0;
  std::atomic<CommandSource> source_in_effect_{CommandSource::kNone};
};

}  // namespace heerk_rotor
