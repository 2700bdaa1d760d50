#include "heerk_rotor/tools/signal_statistics.hpp"

#include <algorithm>

namespace heerk_rotor {

SignalStatistics::SignalStatistics(std::vector<Signal> signals, std::uint64_t first_step, std::uint64_t last_step, double step_size, double window, std::uint64_t every)
    : signals_(std::move(signals)), accumulated_(signals_.size()), first_step_(first_step), last_step_(last_step), every_(every) {
  const double begin = static_cast<double>(first_step) * step_size, end = static_cast<double>(last_step) * step_size;
  window_begin_ = std::max(begin, end - window);
  window_length_ = end - window_begin_;
}

void SignalStatistics::observe(const Sample& sample) noexcept {
  const bool enters = !in_window_ && sample.t >= window_begin_;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    Accumulated& a = accumulated_[i];
    const Index index = signals_[i].index;
    const double value = signals_[i].kind == Signal::Kind::kState ? sample.x[index] : sample.y[index];
    if (!started_) {
      a.min = a.max = value;
    } else {
      a.min = std::min(a.min, value);
      a.max = std::max(a.max, value);
    }
    // Value at the beginning of this instant's piece of the window: between two instants where the window begins there.
    double from = a.last, from_time = last_time_;
    if (enters) {
      from = value;
      from_time = sample.t;
      if (started_ && sample.t > window_begin_) {
        from_time = window_begin_;
        from = a.last + (value - a.last) * (window_begin_ - last_time_) / (sample.t - last_time_);
      }
      a.window_min = a.window_max = from;
    }
    if (enters || in_window_) {
      a.integral += 0.5 * (from + value) * (sample.t - from_time);
      a.window_min = std::min(a.window_min, value);
      a.window_max = std::max(a.window_max, value);
    }
    a.last = value;
  }
  in_window_ = in_window_ || enters;
  last_time_ = sample.t;
  started_ = true;
}

SignalSummary SignalStatistics::summary(std::size_t i) const {
  const Accumulated& a = accumulated_[i];
  const double mean = window_length_ > 0.0 ? a.integral / window_length_ : a.last;
  return {a.last, mean, 0.5 * (a.window_max - a.window_min), a.min, a.max};
}

}  // namespace heerk_rotor
