#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// Watches what a model limits although the physics would go on: every output port whose name ends in `_clamped` is 1 while that happens (squeeze-film
/// damper: journal against the housing). Looks about every degree of the nominal revolution.
class LimitWatch : public Observer {
 public:
  /// Registers itself when there is something to watch. revolution: [s].
  LimitWatch(Simulation& simulation, double revolution);

  bool wants(std::uint64_t step) const noexcept override { return step % every_ == 0; }
  void observe(const Sample& sample) noexcept override;

  /// One sentence per limit that was reached, with the share of instants, the first one, and the largest value of an `eccentricity_ratio` beside it.
  /// Any thread.
  std::vector<std::string> warnings() const;

  /// Watched instants at which a limit was reached so far, all limits together. Any thread.
  std::uint64_t reached() const noexcept;

 private:
  struct Limit {
    std::string name;
    Index entry, ratio;  // of y; ratio: -1 when there is none
    std::atomic<std::uint64_t> reached{0};
    std::atomic<double> first{0.0}, largest{0.0};
  };
  std::vector<std::unique_ptr<Limit>> limits_;
  std::uint64_t every_ = 1;
  std::atomic<std::uint64_t> looked_{0};
};

}  // namespace heerk_rotor
