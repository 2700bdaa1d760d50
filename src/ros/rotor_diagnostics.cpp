#include "heerk_rotor/ros/rotor_diagnostics.hpp"

#include <cmath>

#include <diagnostic_msgs/DiagnosticStatus.h>

namespace heerk_rotor {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;
using Mode = RealTimeLoop::Mode;

/// A real-time factor further off than this is worth a warning.
constexpr double kFactorTolerance = 0.02;
/// So is a second in which a larger share of the steps came late; single ones are the host's doing and only counted.
constexpr double kOverrunShare = 0.01;

double microseconds(std::int64_t nanoseconds) { return 1e-3 * static_cast<double>(nanoseconds); }

const char* text(Mode mode) {
  switch (mode) {
    case Mode::kRunning: return "running";
    case Mode::kPaused: return "paused";
    case Mode::kFailed: return "failed";
    case Mode::kFinished: break;
  }
  return "finished";
}

}  // namespace

RotorDiagnostics::RotorDiagnostics(ros::NodeHandle& node, Simulation& simulation, RotorTask& task, RealTimeLoop& loop, const LimitWatch& limits, const CommandInput* input)
    : simulation_(simulation), task_(task), loop_(loop), limits_(limits), input_(input) {
  updater_.setHardwareID("none");
  updater_.add("Simulation", this, &RotorDiagnostics::reportSimulation);
  updater_.add("Real time", this, &RotorDiagnostics::reportRealTime);
  updater_.add("Solver", this, &RotorDiagnostics::reportSolver);
  updater_.add("Command", this, &RotorDiagnostics::reportCommand);
  updater_.add("Readers", this, &RotorDiagnostics::reportReaders);
  timer_ = node.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { update(); }, false, false);
}

void RotorDiagnostics::start(const std::string& scheduling) {
  scheduling_ = scheduling;
  reported_drops_.assign(readers_.size(), 0);
  now_ = look();
  timer_.start();
}

RotorDiagnostics::Moment RotorDiagnostics::look() {
  Moment moment;
  loop_.call([&] {
    moment.mode = loop_.mode();
    moment.step = simulation_.stepCount();
    moment.epoch = simulation_.epoch();
    moment.time = simulation_.time();
    moment.solver = simulation_.solver().counters();
    if (moment.mode == Mode::kFailed) moment.failure = task_.failureText();
    moment.wall = Clock::now();
  });
  if (loop_.ended()) moment.mode = Mode::kFinished;
  moment.timing = loop_.timing().report();
  moment.limits = limits_.reached();
  return moment;
}

void RotorDiagnostics::update() {
  before_ = now_;
  now_ = look();
  updater_.force_update();
}

void RotorDiagnostics::reportSimulation(Status& status) {
  if (now_.mode == Mode::kFailed) status.summary(Level::ERROR, now_.failure);
  else status.summary(Level::OK, text(now_.mode));
  if (now_.limits > before_.limits)
    for (const std::string& warning : limits_.warnings()) status.mergeSummary(Level::WARN, warning);
  status.add("state", text(now_.mode));
  status.add("step", now_.step);
  status.add("epoch", now_.epoch);
  status.add("simulation time [s]", now_.time);
  status.add("step size [s]", simulation_.stepSize());
  status.add("integrator", simulation_.options().method);
  status.add("limits of models reached [instants]", now_.limits);
}

void RotorDiagnostics::reportRealTime(Status& status) {
  const TimingReport &t = now_.timing, &earlier = before_.timing;
  const double wall = std::chrono::duration<double>(now_.wall - before_.wall).count();
  const double factor = wall > 0.0 ? static_cast<double>(t.steps - earlier.steps) * simulation_.stepSize() / wall : 0.0;
  const double target = loop_.options().real_time_factor;
  const std::uint64_t late_now = t.overruns - earlier.overruns, steps_now = t.steps - earlier.steps;

  status.summary(Level::OK, target > 0.0 ? "real-time factor held" : "as fast as possible");
  // A second in which the run was paused or waited for commands says nothing about keeping up.
  const bool ran = now_.mode == Mode::kRunning && before_.mode == Mode::kRunning && steps_now > 0;
  if (target > 0.0 && ran && static_cast<double>(late_now) > kOverrunShare * static_cast<double>(steps_now)) status.mergeSummary(Level::WARN, "many overruns");
  if (t.slips > earlier.slips) status.mergeSummary(Level::WARN, "schedule slipped");
  if (target > 0.0 && ran && factor < (1.0 - kFactorTolerance) * target && (late_now > 0 || t.slips > earlier.slips))
    status.mergeSummary(Level::WARN, "real-time factor too low");

  status.add("real-time factor", factor);
  status.add("real-time factor wanted", target);
  status.add("steps", t.steps);
  status.add("overruns", t.overruns);
  status.add("overruns: late wake-up", t.late_wake_ups);
  status.add("overruns: long step", t.long_steps);
  status.add("overruns in the last second", late_now);
  status.add("slips", t.slips);
  status.add("slipped [ms]", 1e-6 * static_cast<double>(t.slipped));
  const DurationHistogram::Counts lateness = t.lateness.since(earlier.lateness), duration = t.step_time.since(earlier.step_time);
  status.add("lateness p50 [us]", microseconds(lateness.percentile(0.5)));
  status.add("lateness p99 [us]", microseconds(lateness.percentile(0.99)));
  status.add("lateness max since start [us]", microseconds(t.lateness.maximum));
  status.add("step time p50 [us]", microseconds(duration.percentile(0.5)));
  status.add("step time p99 [us]", microseconds(duration.percentile(0.99)));
  status.add("step time max since start [us]", microseconds(t.step_time.maximum));
  status.add("scheduling", scheduling_);
}

void RotorDiagnostics::reportSolver(Status& status) {
  const SolverCounters &c = now_.solver, &earlier = before_.solver;
  const double steps = static_cast<double>(now_.step - before_.step);
  const auto perStep = [steps](std::uint64_t now, std::uint64_t before) { return steps > 0.0 ? static_cast<double>(now - before) / steps : 0.0; };
  status.summary(Level::OK, "converging");
  if (c.pruning_failures > earlier.pruning_failures) status.summary(Level::WARN, "a pruned dependency became active; solved without pruning");
  if (now_.mode == Mode::kFailed) status.summary(Level::ERROR, "stopped");
  status.add("solves per step", perStep(c.solves, earlier.solves));
  status.add("Newton iterations per step", perStep(c.newton_iterations, earlier.newton_iterations));
  status.add("residual evaluations per step", perStep(c.residual_evaluations, earlier.residual_evaluations));
  status.add("Jacobians", c.jacobians);
  status.add("factorizations", c.factorizations);
  status.add("pruning failures", c.pruning_failures);
}

void RotorDiagnostics::reportCommand(Status& status) {
  if (input_ == nullptr) {
    status.summary(Level::OK, "the configuration has no swashplate");
    return;
  }
  const CommandSource source = task_.source();
  if (source == CommandSource::kTimeout) status.summary(Level::WARN, "command too old: default in effect");
  else status.summary(Level::OK, source == CommandSource::kNone ? "default in effect" : "command in effect");
  status.add("source in effect", name(source));
  status.add("source of the last command", name(input_->lastSource()));
  const double age = input_->age();
  if (age < 0.0) status.add("age of the last command [s]", "none yet");
  else status.add("age of the last command [s]", age);
  status.add("accepted", input_->accepted());
  status.add("clamped", input_->clamped());
  status.add("refused", input_->refused());
}

void RotorDiagnostics::reportReaders(Status& status) {
  status.summary(Level::OK, "none lost");
  for (std::size_t i = 0; i < readers_.size(); ++i) {
    const Reader& reader = readers_[i];
    const std::uint64_t dropped = reader.ring->dropped();
    if (dropped > reported_drops_[i]) status.mergeSummary(Level::WARN, reader.name + " is too slow");
    reported_drops_[i] = dropped;
    status.add(reader.name + " delivered", reader.delivered());
    status.add(reader.name + " dropped", dropped);
    status.add(reader.name + " waiting", reader.ring->size());
    const std::string problem = reader.problem ? reader.problem() : "";
    if (!problem.empty()) status.mergeSummary(Level::ERROR, problem);
  }
}

}  // namespace heerk_rotor
