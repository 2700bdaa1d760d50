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
  explicit PortValues(CoupledSystem& s) : system(s), y(Vector::Zero(s.outputSize())), u(Vector::Zero(s.inputSize())), g(y), evaluations(s.outputs().size(), 0) {
    for (const CoupledSystem::Output& output : s.outputs()) {
      const auto first = static_cast<Index>(reads_.size());
      reads_.insert(reads_.end(), output.feedthrough.begin(), output.feedthrough.end());
      ports_.push_back({output.begin, first, static_cast<Index>(reads_.size()), 0});
    }
    for (const CoupledSystem::Input& input : s.inputs()) inputs_.push_back({input.source_begin.size() == 1 ? y.data() + input.source_begin[0] : nullptr, u.data() + input.begin, input.size, 0});
    for (const CoupledSystem::Subsystem& subsystem : s.subsystems())
      if (subsystem.model->holdState(false)) holding_.push_back(subsystem.model.get());
  }
  PortValues(const PortValues&) = delete;
  PortValues& operator=(const PortValues&) = delete;

  CoupledSystem& system;
  Vector y, u;
  Vector g;                                  // latest evaluation of ports in loops
  bool in_stage = false;                     // the state is given as a stage's z instead of x
  std::vector<std::uint64_t> evaluations;    // per output

  /// From here on everything in loops is out of date, and x stays as it is until the end of the solve.
  void beginSolve() noexcept {
    solve_stamp_ = ++clock_;
    for (SubsystemModel* model : holding_) model->holdState(true);
  }
  void endSolve() noexcept {
    for (SubsystemModel* model : holding_) model->holdState(false);
  }

  /// An input that a loop may change while it iterates.
  void gather(Index number, const Vector& w) noexcept {
    Input& input = inputs_[static_cast<std::size_t>(number)];
    if (!input.from) {
      if (system.gather(number, y, w, u)) input.stamp = ++clock_;
      return;
    }
    std::uint64_t changed = 0;  // bits; inputs are short, library calls would cost more than they do
#pragma GCC unroll 1
    for (Index i = 0; i < input.size; ++i) {
      std::uint64_t before, after;
      std::memcpy(&before, input.to + i, sizeof before);
      std::memcpy(&after, input.from + i, sizeof after);
      changed |= before ^ after;
      input.to[i] = input.from[i];
    }
    if (changed != 0) input.stamp = ++clock_;
  }

  /// Brings g of ports in a loop, all of one subsystem, up to date with x and u; where nothing changed nothing is evaluated. At most kTogether.
  void evaluate(const Index* ports, Index count, double t, const Vector& x) noexcept {
    if (count == 1) {
      if (isStale(ports[0])) evaluateInto(ports[0], t, x, g.data() + ports_[static_cast<std::size_t>(ports[0])].begin);
      return;
    }
    Index stale[CoupledSystem::kTogether], number = 0;
    double* results[CoupledSystem::kTogether];
    for (Index k = 0; k < count; ++k) {
      if (!isStale(ports[k])) continue;
      stale[number] = ports[k];
      results[number++] = g.data() + ports_[static_cast<std::size_t>(ports[k])].begin;
    }
    if (number > 0) evaluateInto(stale, number, t, x, results);
  }

  void evaluateInto(Index port, double t, const Vector& x, double* result) noexcept {
    ++evaluations[static_cast<std::size_t>(port)];
    system.outputCall(port, in_stage)(t, x.data(), u.data(), result);
  }

  /// Ports of one subsystem, at x and u. At most kTogether.
  void evaluateInto(const Index* ports, Index count, double t, const Vector& x, double* const* results) noexcept {
    for (Index k = 0; k < count; ++k) ++evaluations[static_cast<std::size_t>(ports[k])];
    system.evalTogether(ports, count, in_stage, t, x, u, results);
  }

 private:
  struct Port {
    Index begin;                             // of its values
    Index reads_begin, reads_end;            // in reads_
    std::uint64_t stamp;                     // of the last evaluation in a loop
  };
  /// Whether an input has changed since the port was evaluated in this solve; it counts as evaluated from here on.
  bool isStale(Index number) noexcept {
    Port& port = ports_[static_cast<std::size_t>(number)];
    std::uint64_t newest = solve_stamp_;
    for (Index r = port.reads_begin; r < port.reads_end; ++r) newest = std::max(newest, inputs_[static_cast<std::size_t>(reads_[static_cast<std::size_t>(r)])].stamp);
    if (port.stamp >= newest) return false;
    port.stamp = ++clock_;
    return true;
  }

  struct Input {
    const double* from;                      // the only source; nullptr: none or several
    double* to;
    Index size;
    std::uint64_t stamp;                     // of the last change
  };
  std::uint64_t clock_ = 1, solve_stamp_ = 1;
  std::vector<Port> ports_;
  std::vector<Index> reads_;                 // input ports that reach each output port at once
  std::vector<Input> inputs_;
  std::vector<SubsystemModel*> holding_;     // models that make use of holdState()
};

/// Neighbours in a list of ports that one call can evaluate: they belong to one subsystem.
struct PortGroup {
  Index begin, size;
};

inline std::vector<PortGroup> groupBySubsystem(const CoupledSystem& system, const std::vector<Index>& ports) {
  std::vector<PortGroup> groups;
  const auto owner = [&](Index k) { return system.outputs()[static_cast<std::size_t>(ports[static_cast<std::size_t>(k)])].subsystem; };
  for (Index k = 0; k < static_cast<Index>(ports.size()); ++k) {
    if (!groups.empty() && owner(groups.back().begin) == owner(k) && groups.back().size < CoupledSystem::kTogether) ++groups.back().size;
    else groups.push_back({k, 1});
  }
  return groups;
}

}  // namespace heerk_rotor
