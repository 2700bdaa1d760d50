#include "heerk_rotor/tools/sweep_progress.hpp"

#include <algorithm>

#include <unistd.h>

namespace heerk_rotor {
namespace {
constexpr int kWidth = 30;  // [characters] of the bar itself
}

SweepProgress::SweepProgress(std::uint64_t runs, bool enabled, std::FILE* stream)
    : stream_(enabled ? stream : nullptr), terminal_(::isatty(::fileno(stream)) == 1), runs_(runs), start_(std::chrono::steady_clock::now()) {}

void SweepProgress::update(std::uint64_t done) noexcept {
  if (stream_ == nullptr || runs_ == 0) return;
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double fraction = std::min(1.0, static_cast<double>(parts_.load(std::memory_order_relaxed)) / static_cast<double>(kPartsOfRun * runs_));
  char left[32] = "";  // nothing is known before the first part of a run
  if (fraction > 0.0) std::snprintf(left, sizeof left, "%.0f s left", elapsed * (1.0 - fraction) / fraction);
  if (!terminal_) {
    const std::uint64_t tenths = 10 * done / runs_;
    if (tenths <= tenths_) return;
    tenths_ = tenths;
    std::fprintf(stream_, "simulate: %llu %% (%llu of %llu runs), %s\n", number(10 * tenths), number(done), number(runs_), left);
  } else {
    const int filled = static_cast<int>(fraction * kWidth);
    char bar[kWidth + 1];
    std::fill(bar, bar + filled, '#');
    std::fill(bar + filled, bar + kWidth, '.');
    bar[kWidth] = '\0';
    std::fprintf(stream_, "\r[%s] %3.0f %%  %llu of %llu runs  %s \x1b[K", bar, 100.0 * fraction, number(done), number(runs_), left);
    drawn_ = true;
  }
  std::fflush(stream_);
}

void SweepProgress::finish() noexcept {
  if (drawn_) std::fprintf(stream_, "\r\x1b[K");
  if (drawn_) std::fflush(stream_);
  drawn_ = false;
}

}  // namespace heerk_rotor
