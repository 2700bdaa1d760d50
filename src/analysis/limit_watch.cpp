#include "heerk_rotor/analysis/limit_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace heerk_rotor {
namespace {

bool endsWith(const std::string& text, const std::string& end) { return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0; }

}  // namespace

LimitWatch::LimitWatch(Simulation& simulation, double revolution) : every_(static_cast<std::uint64_t>(std::max(1.0, std::round(revolution / 360.0 / simulation.stepSize())))) {
  const std::vector<CoupledSystem::Output>& outputs = simulation.system().outputs();
  for (const CoupledSystem::Output& output : outputs) {
    if (!endsWith(output.name, "_clamped")) continue;
    const auto ratio = std::find_if(outputs.begin(), outputs.end(), [&output](const CoupledSystem::Output& other) {
      return other.subsystem == output.subsystem && endsWith(other.name, ".eccentricity_ratio");
    });
    auto limit = std::make_unique<Limit>();
    limit->name = output.name;
    limit->entry = output.begin;
    limit->ratio = ratio == outputs.end() ? -1 : ratio->begin;
    limits_.push_back(std::move(limit));
  }
  if (!limits_.empty()) simulation.addObserver(*this);
}

void LimitWatch::observe(const Sample& sample) noexcept {
  ++looked_;
  for (const auto& limit : limits_) {
    if (limit->ratio >= 0) limit->largest = std::max(limit->largest.load(), sample.y[limit->ratio]);  // only this thread writes
    if (sample.y[limit->entry] == 0.0) continue;
    if (limit->reached == 0) limit->first = sample.t;
    ++limit->reached;
  }
}

std::uint64_t LimitWatch::reached() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& limit : limits_) sum += limit->reached;
  return sum;
}

std::vector<std::string> LimitWatch::warnings() const {
  std::vector<std::string> list;
  for (const auto& owned : limits_) {
    const Limit& limit = *owned;
    if (limit.reached == 0) continue;
    char text[320];
    std::snprintf(text, sizeof text, "%s: the model's limit was reached at %llu of %llu watched instants, first at t = %g s", limit.name.c_str(),
                  static_cast<unsigned long long>(limit.reached.load()), static_cast<unsigned long long>(looked_.load()), limit.first.load());
    list.push_back(text);
    if (limit.ratio >= 0) {
      std::snprintf(text, sizeof text, "; largest eccentricity ratio %.4g, where the film force is that of 0.999: the result is not physical there", limit.largest.load());
      list.back() += text;
    }
  }
  return list;
}

}  // namespace heerk_rotor
