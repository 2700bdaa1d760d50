#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// What most ports carry: a few numbers, written one by one just before. Copied likewise, because a vector load would have to wait until all of them
/// have left the store buffer, and a call of the library costs more than the copy.
inline void copyShort(const double* from, Index size, double* to) noexcept {
  if (size > 16) {
    std::memcpy(to, from, static_cast<std::size_t>(size) * sizeof(double));
    return;
  }
#pragma GCC unroll 1
  for (Index i = 0; i < size; ++i) {
    to[i] = from[i];
    asm volatile("" ::: "memory");  // keeps the loop a loop
  }
}

/// y and u of a coupled system while a solve finds them, and which of them are up to date: a port in a loop is when it has been evaluated in this solve
/// and none of its inputs has changed since.
struct PortValues {
  explicit PortValues(CoupledSystem& s) : system(s), y(Vector::Zero(s.outputSize())), u(Vector::Zero(s.inputSize())), g(y), evaluations(s.outputs().size(), 0), input_stamp_(s.inputs().size(), 0) {
    for (const CoupledSystem::Output& output : s.outputs()) {
      const auto first = static_cast<Index>(reads_.size());
      reads_.insert(reads_.end(), output.feedthrough.begin(), output.feedthrough.end());
      ports_.push_back({output.begin, first, static_cast<Index>(reads_.size()), 0});
    }
  }

  CoupledSystem& system;
  Vector y, u;
  Vector g;                                  // latest evaluation of ports in loops
  bool in_stage = false;                     // the state is given as a stage's z instead of x
  std::vector<std::uint64_t> evaluations;    // per output

  /// From here on everything in loops is out of date.
  void beginSolve() noexcept { solve_stamp_ = ++clock_; }

  /// An input that a loop may change while it iterates.
  void gather(Index input, const Vector& w) noexcept {
    if (system.gather(input, y, w, u)) input_stamp_[static_cast<std::size_t>(input)] = ++clock_;
  }

  /// Brings g of ports in a loop, all of one subsystem, up to date with x and u; where nothing changed nothing is evaluated. At most kTogether.
  void evaluate(const Index* ports, Index count, double t, const Vector& x) noexcept {
    Index stale[CoupledSystem::kTogether], number = 0;
    double* results[CoupledSystem::kTogether];
    for (Index k = 0; k < count; ++k) {
      Port& port = ports_[static_cast<std::size_t>(ports[k])];
      std::uint64_t newest = solve_stamp_;
      for (Index r = port.reads_begin; r < port.reads_end; ++r) newest = std::max(newest, input_stamp_[static_cast<std::size_t>(reads_[static_cast<std::size_t>(r)])]);
      if (port.stamp >= newest) continue;
      port.stamp = ++clock_;
      stale[number] = ports[k];
      results[number++] = g.data() + port.begin;
    }
    if (number > 0) evaluateInto(stale, number, t, x, results);
  }

  /// Ports of one subsystem, at x and u. At most kTogether.
  void evaluateInto(const Index* ports, Index count, double t, const Vector& x, double* const* results) noexcept {
    for (Index k = 0; k < count; ++k) ++evaluations[static_cast<std::size_t>(ports[k])];
    if (count > 1) in_stage ? system.evalStageOutputs(ports, count, t, x, u, results) : system.evalOutputs(ports, count, t, x, u, results);
    else in_stage ? system.evalStageOutput(ports[0], t, x, u, results[0]) : system.evalOutput(ports[0], t, x, u, results[0]);
  }

 private:
  struct Port {
    Index begin;                             // of its values
    Index reads_begin, reads_end;            // in reads_
    std::uint64_t stamp;                     // of the last evaluation in a loop
  };
  std::uint64_t clock_ = 1, solve_stamp_ = 1;
  std::vector<Port> ports_;
  std::vector<Index> reads_;                 // input ports that reach each output port at once
  std::vector<std::uint64_t> input_stamp_;
};

/// Neighbours in a list of ports that one call can evaluate: [begin, end) of the same subsystem.
struct PortGroup {
  std::size_t begin, end;
};

inline std::vector<PortGroup> groupBySubsystem(const CoupledSystem& system, const std::vector<Index>& ports) {
  std::vector<PortGroup> groups;
  for (std::size_t k = 0; k < ports.size(); ++k) {
    const auto owner = [&](std::size_t i) { return system.outputs()[static_cast<std::size_t>(ports[i])].subsystem; };
    if (!groups.empty() && owner(groups.back().begin) == owner(k) && k - groups.back().begin < static_cast<std::size_t>(CoupledSystem::kTogether)) ++groups.back().end;
    else groups.push_back({k, k + 1});
  }
  return groups;
}

}  // namespace heerk_rotor
