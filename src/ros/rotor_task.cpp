#include "heerk_rotor/ros/rotor_task.hpp"

namespace heerk_rotor {

RotorTask::RotorTask(Simulation& simulation, Feed& feed, const CommandView& commands, CommandInput& input, const Options& options)
    : simulation_(simulation), feed_(feed), commands_(commands), input_(input), options_(options), w_(simulation.system().defaultCommand()) {
  simulation_.addObserver(feed_);
}

void RotorTask::apply(const Command& command) noexcept {
  if (commands_.collective() >= 0) w_[commands_.collective()] = command.values[0];
  if (commands_.lateralCyclic() >= 0) w_[commands_.lateralCyclic()] = command.values[1];
  if (commands_.longitudinalCyclic() >= 0) w_[commands_.longitudinalCyclic()] = command.values[2];
  feed_.setSource(command.source);
}

void RotorTask::useDefault(CommandSource source) noexcept {
  const Vector& standard = simulation_.system().defaultCommand();
  for (const Index entry : {commands_.collective(), commands_.lateralCyclic(), commands_.longitudinalCyclic()})
    if (entry >= 0) w_[entry] = standard[entry];
  feed_.setSource(source);
}

void RotorTask::latchHeldCommands() noexcept {
  for (HeldInput* input : held_) input->takeInto(w_);
}

void RotorTask::latchCommand() noexcept {
  latchHeldCommands();
  if (input_.take(command_)) apply(command_);
  if (options_.timeout_policy == TimeoutPolicy::kHold || options_.command_timeout == 0.0 || command_.source == CommandSource::kNone) return;
  if (1e-9 * static_cast<double>(clock_.now() - command_.arrival) <= options_.command_timeout) return;
  command_.source = CommandSource::kNone;  // dealt with
  useDefault(CommandSource::kTimeout);
}

bool RotorTask::ready() noexcept {
  if (options_.lock_step == 0 || granted_ > 0) return true;
  if (!input_.take(command_)) return false;
  apply(command_);
  latchHeldCommands();
  granted_ = options_.lock_step;
  return true;
}

StepTask::Result RotorTask::step() noexcept {
  if (options_.lock_step == 0) latchCommand();
  if (simulation_.step(w_) != StepStatus::kOk || !feed_.outputsAreFinite()) return Result::kFailed;
  const bool finished = options_.last_step > 0 && simulation_.stepCount() >= options_.last_step;
  const bool batch_done = granted_ > 0 && --granted_ == 0;
  // In lock step the controller answers to the instant that its command has led to; a run's last instant belongs to its record.
  if (finished || batch_done) showPresent();
  if (!feed_.outputsAreFinite()) return Result::kFailed;
  return finished ? Result::kFinished : Result::kOk;
}

void RotorTask::showPresent() noexcept {
  feed_.setToEveryone(true);
  simulation_.observe(w_);
  feed_.setToEveryone(false);
}

void RotorTask::startOver() {
  Command stale;
  while (input_.take(stale)) {
  }
  for (HeldInput* input : held_) input->forget();
  command_ = Command();
  granted_ = 0;
  feed_.startOver();
  w_ = simulation_.system().defaultCommand();
  feed_.setSource(CommandSource::kNone);
}

void RotorTask::resume(const Vector& command) {
  startOver();
  w_ = command;
  feed_.setSource(CommandSource::kSnapshot);
}

std::string RotorTask::failureText() const {
  const StepFailure failure = simulation_.failure();
  const std::string where = "step " + std::to_string(simulation_.stepCount()) + ", simulation time " + std::to_string(simulation_.time()) + " s: ";
  if (failure.status == StepStatus::kOk) return where + "a published output is not a finite number, although all states are";
  const std::string what = failure.status == StepStatus::kNonFinite ? " became non-finite; " : " could not be solved for; ";
  return where + (failure.where.empty() ? "the coupled system" : failure.where) + what + failure.cause;
}

}  // namespace heerk_rotor
