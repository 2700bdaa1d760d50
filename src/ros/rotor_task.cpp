#include "heerk_rotor/ros/rotor_task.hpp"

#include <algorithm>

namespace heerk_rotor {
namespace {

/// 0 * x is 0 for every finite x and not a number otherwise, so the sum tells without a branch per value.
template <class Values>
double nonFinite(const Values& values) noexcept {
  double sum = 0.0;
  for (const double value : values) sum += 0.0 * value;
  return sum;
}

bool isFinite(const RotorReading& r) noexcept {
  double sum = 0.0;
  for (const RotorReading::PerBlade* values : {&r.lag, &r.lag_rate, &r.flap, &r.flap_rate, &r.pitch, &r.pitch_rate, &r.tip_twist}) sum += nonFinite(*values);
  for (const auto* values : {&r.hub_force, &r.hub_moment, &r.position, &r.velocity, &r.angular_velocity}) sum += nonFinite(*values);
  sum += nonFinite(r.orientation) + nonFinite(r.inflow);
  sum += nonFinite(std::array<double, 6>{r.azimuth, r.rotor_speed, r.thrust_coefficient, r.torque_coefficient, r.power_coefficient, r.advance_ratio});
  return sum == 0.0;
}

bool isFinite(const BladeShapes& shapes) noexcept {
  double sum = 0.0;
  for (int k = 0; k < shapes.blades; ++k)
    for (int i = 0; i < shapes.sections; ++i) {
      const BladeShapes::Section& s = shapes.section[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      sum += nonFinite(s.position) + nonFinite(s.chordwise) + 0.0 * s.load;
    }
  return sum == 0.0;
}

}  // namespace

RotorTask::RotorTask(Simulation& simulation, RotorView& view, CommandInput& input, const Options& options)
    : simulation_(simulation), view_(view), input_(input), options_(options), blade_view_(simulation.system(), view.blades()), w_(simulation.system().defaultCommand()), history_(options.history) {
  simulation_.addObserver(*this);
}

void RotorTask::addRing(RotorRing& ring, std::uint64_t every) { readers_.push_back({&ring, every, nullptr}); }

void RotorTask::addLosslessRing(RotorRing& ring, const std::atomic<bool>& stop) { readers_.push_back({&ring, 1, &stop}); }

void RotorTask::apply(const Command& command) noexcept {
  if (view_.collectiveCommand() >= 0) w_[view_.collectiveCommand()] = command.values[0];
  if (view_.lateralCyclicCommand() >= 0) w_[view_.lateralCyclicCommand()] = command.values[1];
  if (view_.longitudinalCyclicCommand() >= 0) w_[view_.longitudinalCyclicCommand()] = command.values[2];
  source_in_effect_ = command.source;
}

void RotorTask::useDefault(CommandSource source) noexcept {
  const Vector& standard = simulation_.system().defaultCommand();
  for (const Index entry : {view_.collectiveCommand(), view_.lateralCyclicCommand(), view_.longitudinalCyclicCommand()})
    if (entry >= 0) w_[entry] = standard[entry];
  source_in_effect_ = source;
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
  if (simulation_.step(w_) != StepStatus::kOk || output_not_finite_) return Result::kFailed;
  const bool finished = options_.last_step > 0 && simulation_.stepCount() >= options_.last_step;
  const bool batch_done = granted_ > 0 && --granted_ == 0;
  // In lock step the controller answers to the instant that its command has led to; a run's last instant belongs to its record.
  if (finished || batch_done) showPresent();
  if (output_not_finite_) return Result::kFailed;
  return finished ? Result::kFinished : Result::kOk;
}

void RotorTask::showPresent() noexcept {
  to_everyone_ = true;
  simulation_.observe(w_);
  to_everyone_ = false;
}

void RotorTask::observe(const Sample& sample) noexcept {
  const bool shown = shown_ && sample.step == instant_.reading.step && sample.epoch == instant_.reading.epoch;
  if (!shown) take(sample);
  if (!output_not_finite_) handOut();
}

void RotorTask::take(const Sample& sample) noexcept {
  view_.read(sample, instant_.reading);
  instant_.source = source_in_effect_.load(std::memory_order_relaxed);
  shown_ = true;
  blade_view_.read(sample, picture_.blades);
  if (!isFinite(instant_.reading) || !isFinite(picture_.blades)) {
    output_not_finite_ = true;
    return;
  }
  for (Reader& reader : readers_) reader.served = false;
  newest_.write(picture_);
  if (!history_.empty()) history_[history_count_++ % history_.size()] = instant_;
}

void RotorTask::handOut() noexcept {
  for (Reader& reader : readers_) {
    if (reader.served || (!to_everyone_ && instant_.reading.step % reader.every != 0)) continue;
    reader.served = true;
    if (reader.stop != nullptr) reader.ring->pushWaiting(instant_, *reader.stop);
    else reader.ring->push(instant_);
  }
}

void RotorTask::startOver() {
  Command stale;
  while (input_.take(stale)) {
  }
  for (HeldInput* input : held_) input->forget();
  command_ = Command();
  granted_ = 0;
  output_not_finite_ = false;
  history_count_ = 0;  // of another epoch: a failure to come has not grown out of it
  w_ = simulation_.system().defaultCommand();
  source_in_effect_ = CommandSource::kNone;
}

void RotorTask::resume(const Vector& command) {
  startOver();
  w_ = command;
  source_in_effect_ = CommandSource::kSnapshot;
}

std::vector<RotorInstant> RotorTask::history() const {
  const std::uint64_t size = std::min<std::uint64_t>(history_count_, history_.size());
  std::vector<RotorInstant> instants;
  for (std::uint64_t i = history_count_ - size; i < history_count_; ++i) instants.push_back(history_[i % history_.size()]);
  return instants;
}

std::string RotorTask::failureText() const {
  const StepFailure failure = simulation_.failure();
  const std::string where = "step " + std::to_string(simulation_.stepCount()) + ", simulation time " + std::to_string(simulation_.time()) + " s: ";
  if (failure.status == StepStatus::kOk) return where + "an output of the rotor is not a finite number, although all states are";
  const std::string what = failure.status == StepStatus::kNonFinite ? " became non-finite; " : " could not be solved for; ";
  return where + (failure.where.empty() ? "the coupled system" : failure.where) + what + failure.cause;
}

}  // namespace heerk_rotor
