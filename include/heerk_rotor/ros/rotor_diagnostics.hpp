#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "heerk_rotor/analysis/limit_watch.hpp"
#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/realtime/snapshot_ring.hpp"
#include "heerk_rotor/ros/command_input.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"

namespace heerk_rotor {

/// Reports the node's health on /diagnostics once per second of real time: simulation, real time (factor, overruns with
/// cause, lateness, step time), solver, command, readers. After a restart of roscore a ROS 1 node does not register again
/// by itself: existing connections go on, new subscribers find nothing until the node is started anew.
class RotorDiagnostics {
 public:
  /// A reader of the step thread's rings, as a line of the report.
  struct Reader {
    std::string name;
    std::function<std::uint64_t()> delivered;
    const RingGauge* ring;
    std::function<std::string()> problem = {};  // not empty: an error (a recording with a gap)
  };

  /// All references must outlive the diagnostics. `input` may be nullptr (no swashplate).
  RotorDiagnostics(ros::NodeHandle& node, Simulation& simulation, RotorTask& task, RealTimeLoop& loop, const LimitWatch& limits, const CommandInput* input);

  void addReader(Reader reader) { readers_.push_back(std::move(reader)); }
  /// `scheduling`: what the operating system granted the step thread, in words.
  void start(const std::string& scheduling);
  void stop() { timer_.stop(); }

 private:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;
  using Clock = std::chrono::steady_clock;
  /// What is looked at once, on the step thread, for all lines of one report.
  struct Moment {
    Clock::time_point wall = {};
    RealTimeLoop::Mode mode = RealTimeLoop::Mode::kPaused;
    std::uint64_t step = 0;
    std::uint32_t epoch = 0;
    double time = 0.0;
    SolverCounters solver;
    std::string failure;
    std::uint64_t limits = 0;  // instants at which a model's limit was reached
    TimingReport timing;
  };
  Moment look();
  void update();
  void reportSimulation(Status& status);
  void reportRealTime(Status& status);
  void reportSolver(Status& status);
  void reportCommand(Status& status);
  void reportReaders(Status& status);

  Simulation& simulation_;
  RotorTask& task_;
  RealTimeLoop& loop_;
  const LimitWatch& limits_;
  const CommandInput* input_;  // nullptr: no swashplate
  std::vector<Reader> readers_;
  std::vector<std::uint64_t> reported_drops_;
  std::string scheduling_;
  Moment before_, now_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace heerk_rotor
