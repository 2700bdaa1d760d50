#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// The last instants of a run: step number, state and command in effect, in memory taken at construction. Keeping only
/// what the outputs follow from makes an instant cost a copy of x and w, so that it can run along in every step.
class RecentInstants {
 public:
  /// Room for `revolution` [s] of steps (less when that takes more than 64 MiB).
  RecentInstants(const Simulation& simulation, double revolution);

  /// The instant a step is about to start from.
  void push(const Simulation& simulation, const Vector& command) noexcept;

  std::size_t size() const { return count_ < steps_.size() ? static_cast<std::size_t>(count_) : steps_.size(); }
  std::size_t capacity() const { return steps_.size(); }
  /// i = 0 is the oldest one.
  std::uint64_t step(std::size_t i) const { return steps_[slot(i)]; }
  Vector state(std::size_t i) const { return states_.col(static_cast<Index>(slot(i))); }
  Vector command(std::size_t i) const { return commands_.col(static_cast<Index>(slot(i))); }
  /// Where the run began, with a solver cache that nothing has spoiled yet.
  const Simulation::Checkpoint& start() const { return start_; }

 private:
  std::size_t slot(std::size_t i) const { return static_cast<std::size_t>((count_ - size() + i) % steps_.size()); }
  Simulation::Checkpoint start_;
  std::vector<std::uint64_t> steps_;
  Matrix states_;    // (n_x x capacity)
  Matrix commands_;  // (n_w x capacity)
  std::uint64_t count_ = 0;
};

/// Writes the remembered instants as CSV: all states, then `signals`. The outputs are solved again from state and
/// command; where the solver cannot any more they are written as nan. Leaves `simulation` somewhere else: for the end of
/// a failed run only. Throws RecordError when the file cannot be written.
void writeFailureDump(const std::string& file, Simulation& simulation, const RecentInstants& instants,
                      const std::vector<Signal>& signals, double rotor_speed);

}  // namespace heerk_rotor
