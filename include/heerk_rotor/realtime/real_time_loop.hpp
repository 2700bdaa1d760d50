#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>

#include "heerk_rotor/realtime/clock.hpp"
#include "heerk_rotor/realtime/deadline_schedule.hpp"
#include "heerk_rotor/realtime/real_time_thread.hpp"
#include "heerk_rotor/realtime/step_timing.hpp"
#include "heerk_rotor/realtime/wake_up.hpp"

namespace heerk_rotor {

/// What the loop repeats. All of it runs on the loop's thread.
class StepTask {
 public:
  enum class Result { kOk, kFailed, kFinished };
  virtual ~StepTask() = default;
  /// One step: must not block, allocate or throw when the run is paced.
  virtual Result step() noexcept = 0;
  /// False: there is nothing to do until RealTimeLoop::wake() (lock-step runs).
  virtual bool ready() noexcept { return true; }
};

struct RealTimeLoopOptions {
  double step = 1e-3;             // simulated time of one step [s]
  double real_time_factor = 1.0;  // simulated time over real time; 0 = as fast as possible
  int steps_per_wake = 1;         // steps computed per sleep: fewer wake-ups, coarser deadlines
  int priority = 0;               // SCHED_FIFO 1..99; 0 = normal. Not used when as fast as possible: it would starve the machine
};

/// Repeats a task's step in real time on a thread of its own, with absolute deadlines (see DeadlineSchedule). Everything
/// else that touches the task - pause, reset, save - goes through call(), which runs it on that thread between two steps;
/// without one waiting, a step costs one atomic load for it.
class RealTimeLoop {
 public:
  enum class Mode { kRunning, kPaused, kFailed, kFinished };
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  /// task and clock must outlive the loop.
  RealTimeLoop(StepTask& task, Clock& clock, const RealTimeLoopOptions& options);
  ~RealTimeLoop();

  /// Starts the thread and returns what the operating system granted it.
  RealTimeRights start(bool paused = false);
  /// Ends the run after the present step and joins the thread. May be called twice.
  void stop();

  /// Loops on the calling thread until stop() or the end of the task (for tests; start() does the same on its own thread).
  void run() noexcept;

  /// Runs `action` on the loop's thread between two steps and returns when it is done; passes on what it throws.
  /// False: the loop has ended and the action was not run. Not before start(), not from the task itself.
  bool call(const std::function<void()>& action);

  // The following are calls; false: the loop has ended.
  bool pause();
  bool unpause();
  /// Runs `mend` (a reset, say) and clears a failure, in one go: nobody sees a mended task in a loop that still calls itself
  /// failed. The mode before the failure comes back. What `mend` throws is passed on and the failure stays.
  bool recover(const std::function<void()>& mend);
  /// While paused: n more steps at the usual pace. Returns when they are made (true), or when that will not happen: the loop
  /// was not paused, a step failed, somebody paused or unpaused meanwhile, or the loop ended (false).
  bool step(std::uint64_t n);

  /// The task may be ready again. Any thread, never blocks.
  void wake() noexcept { attention_.notify(); }

  Mode mode() const noexcept { return mode_.load(std::memory_order_acquire); }
  /// The loop ended: finished or stopped.
  bool ended() const noexcept { return ended_.load(std::memory_order_acquire); }
  /// Any thread: true from the moment stop() was asked for.
  const std::atomic<bool>& stopRequested() const noexcept { return stop_; }
  const StepTiming& timing() const noexcept { return timing_; }
  const RealTimeLoopOptions& options() const noexcept { return options_; }

 private:
  struct Request;
  void serveRequest() noexcept;
  bool mayStep() noexcept { return mode() == Mode::kRunning && budget_ > 0 && task_.ready(); }
  void rest() noexcept;
  bool waitForRelease() noexcept;
  void stepBatch() noexcept;
  void endStep(StepTask::Result result) noexcept;
  bool paced() const noexcept { return options_.real_time_factor > 0.0; }

  StepTask& task_;
  Clock& clock_;
  const RealTimeLoopOptions options_;
  DeadlineSchedule schedule_;
  StepTiming timing_;
  std::thread thread_;

  // Crossing into the loop: one request at a time.
  std::mutex callers_;                         // of call(); the loop never takes it
  std::mutex steppers_;                        // of step(); the loop never takes it
  std::atomic<Request*> request_{nullptr};
  WakeUp attention_;                           // the loop sleeps here while it has nothing to do
  WakeUp answered_;                            // the caller sleeps here until its request is done
  WakeUp stepped_;                             // step() sleeps here until its steps are made
  std::atomic<bool> stop_{false}, ended_{false};
  std::atomic<bool> step_interrupted_{false};  // by pause() or unpause()

  // Changed on the loop's thread only.
  std::atomic<Mode> mode_{Mode::kRunning};
  Mode mode_before_failure_ = Mode::kRunning;
  std::uint64_t budget_ = kUnlimited;          // steps until the loop pauses itself
};

}  // namespace heerk_rotor
