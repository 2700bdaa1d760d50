#pragma once
#include <cstdint>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// What a signal of a run comes to.
struct SignalSummary {
  double final = 0.0;              // at the last instant
  double mean = 0.0;               // over the last revolution
  double half_peak_to_peak = 0.0;  // (max - min)/2 over the last revolution: the vibratory part
  double min = 0.0, max = 0.0;     // over the whole run
};

/// Summarises signals while a run of known length goes on. Takes every N-th instant and the last one. The last revolution is the last `window`
/// seconds, or the whole run when that is shorter; the mean is the integral of the straight lines between the instants, begun within a step
/// where the window begins there: for a periodic signal and a whole number of steps per revolution, the mean of the samples.
class SignalStatistics final : public Observer {
 public:
  /// `last_step`: the number of the step that will be the final instant; `first_step`: of the first one.
  SignalStatistics(std::vector<Signal> signals, std::uint64_t first_step, std::uint64_t last_step, double step_size, double window, std::uint64_t every = 1);

  bool wants(std::uint64_t step) const noexcept override { return (step - first_step_) % every_ == 0 || step == last_step_; }
  void observe(const Sample& sample) noexcept override;

  const std::vector<Signal>& signals() const { return signals_; }
  /// Of the i-th signal, once the final instant was observed.
  SignalSummary summary(std::size_t i) const;

 private:
  struct Accumulated {
    double last = 0.0, integral = 0.0;  // integral over the window so far
    double window_min = 0.0, window_max = 0.0, min = 0.0, max = 0.0;
  };
  std::vector<Signal> signals_;
  std::vector<Accumulated> accumulated_;
  std::uint64_t first_step_, last_step_, every_;
  double window_begin_, window_length_;  // [s]
  double last_time_ = 0.0;               // [s]
  bool started_ = false, in_window_ = false;
};

}  // namespace heerk_rotor
