#include "heerk_rotor/tools/progress_bar.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <unistd.h>

namespace heerk_rotor {
namespace {
constexpr double kPeriod = 0.1;  // [s] between redraws
constexpr int kWidth = 30;       // [characters] of the bar itself
}

ProgressBar::ProgressBar(std::uint64_t steps, double step_size, bool enabled, std::FILE* stream)
    : stream_(enabled && ::isatty(::fileno(stream)) ? stream : nullptr),
      steps_(steps),
      step_size_(step_size),
      next_(stream_ != nullptr ? 1 : std::numeric_limits<std::uint64_t>::max()),
      start_(std::chrono::steady_clock::now()) {}

void ProgressBar::redraw(std::uint64_t done) noexcept {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  // Look again after one period's worth of steps at the present pace, at most twice as many as so far.
  const double pace = static_cast<double>(done) / std::max(elapsed, 1e-9);  // [steps/s]
  next_ = done + std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::min(pace * kPeriod, static_cast<double>(done))));
  if (elapsed < kPeriod) return;  // a run that is over at once needs no bar
  const double fraction = steps_ > 0 ? static_cast<double>(done) / static_cast<double>(steps_) : 1.0;
  const int filled = static_cast<int>(fraction * kWidth);
  char bar[kWidth + 1];
  std::fill(bar, bar + filled, '#');
  std::fill(bar + filled, bar + kWidth, '.');
  bar[kWidth] = '\0';
  std::fprintf(stream_, "\r[%s] %3.0f %%  %.3f s simulated  %.3g x real time  %.0f s left \x1b[K", bar, 100.0 * fraction,
               static_cast<double>(done) * step_size_, static_cast<double>(done) * step_size_ / elapsed,
               static_cast<double>(steps_ - done) / pace);
  std::fflush(stream_);
  drawn_ = true;
}

void ProgressBar::finish() noexcept {
  if (drawn_) std::fprintf(stream_, "\r\x1b[K");
  if (drawn_) std::fflush(stream_);
  drawn_ = false;
}

}  // namespace heerk_rotor
