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
  explicit PortValues(CoupledSystem& s) : system(s), y(Vector::Zero(s.outputSize())), u(Vector::Zero(s.inputSize())), g(y), evaluations(s.subsystems().size(), 0),
        input_stamp(s.inputs().size(), 0), output_stamp(s.outputs().size(), 0) {}

  CoupledSystem& system;
  Vector y, u;
  Vector g;                                  // latest evaluation of ports in loops
  bool in_stage = false;                     // the state is given as a stage's z instead of x
  std::vector<std::uint64_t> evaluations;    // per subsystem

  /// From here on everything in loops is out of date.
  void beginSolve() noexcept { solve_stamp = ++clock; }

  /// An input that a loop may change while it iterates.
  void gather(Index input, const Vector& w) noexcept {
    if (system.gather(input, y, w, u)) input_stamp[static_cast<std::size_t>(input)] = ++clock;
  }

  /// Brings g (of a port in a loop) up to date with x and u; returns without evaluating when nothing changed.
  void evaluate(Index port, double t, const Vector& x) noexcept {
    std::uint64_t newest = solve_stamp;
    for (const Index input : system.outputs()[static_cast<std::size_t>(port)].feedthrough) newest = std::max(newest, input_stamp[static_cast<std::size_t>(input)]);
    if (output_stamp[static_cast<std::size_t>(port)] >= newest) return;
    evaluateInto(port, t, x, g);
    output_stamp[static_cast<std::size_t>(port)] = ++clock;
  }

  /// A port's entries of `values`, at x and u.
  void evaluateInto(Index port, double t, const Vector& x, Vector& values) noexcept {
    const CoupledSystem::Output& output = system.outputs()[static_cast<std::size_t>(port)];
    ++evaluations[static_cast<std::size_t>(output.subsystem)];
    if (in_stage) system.evalStageOutput(port, t, x, u, values.data() + output.begin);
    else system.evalOutput(port, t, x, u, values.data() + output.begin);
  }

 private:
  std::uint64_t clock = 1, solve_stamp = 1;
  std::vector<std::uint64_t> input_stamp, output_stamp;
};

}  // namespace heerk_rotor
