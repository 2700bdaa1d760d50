// How the cost of a step of the elastic rotor (config/bo105.yaml) grows with elements and sections per blade and with blades, one at a time, the
// others as shipped (10, 10, 4). The modes kept are 44 of 50 per blade as shipped, in the same proportion for other numbers of elements. Two short
// stiff root elements stay; the others share the rest of the blade. Starts from the initial values: a trimmed start fits one size only.
#include <string>

#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

constexpr int kWarmUp = 360;          // steps, one revolution
constexpr std::uint64_t kLength = 720;
constexpr int kStretch = 60;          // a sixth of a revolution

std::string nodes(int elements) {
  const double root = 0.37, radius = 4.91;  // [m]
  std::string list = "[0.20, 0.285, 0.37";
  for (int i = 1; i <= elements - 2; ++i) list += ", " + std::to_string(root + (radius - root) * i / (elements - 2));
  return list + "]";
}

void stepOf(benchmark::State& state, std::vector<std::string> overrides) {
  overrides.push_back("simulation.start=none");
  const auto simulation = make("bo105.yaml", overrides);
  state.counters["states"] = static_cast<double>(simulation->state().size());
  stepOn(state, *simulation, kWarmUp, kLength, kStretch);
}

void elements(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  stepOf(state, {"subsystems.rotor.nodes=" + nodes(n), "subsystems.rotor.modes=" + std::to_string(5 * n * 44 / 50)});
}
void sections(benchmark::State& state) { stepOf(state, {"subsystems.rotor.sections=" + std::to_string(state.range(0))}); }
void blades(benchmark::State& state) { stepOf(state, {"subsystems.rotor.blades=" + std::to_string(state.range(0))}); }

BENCHMARK(elements)->Arg(5)->Arg(7)->Arg(10)->Arg(14)->Arg(20)->Arg(28)->Arg(40)->Unit(benchmark::kMicrosecond);
BENCHMARK(sections)->Arg(10)->Arg(14)->Arg(20)->Arg(28)->Arg(40)->Arg(56)->Arg(80)->Unit(benchmark::kMicrosecond);
BENCHMARK(blades)->DenseRange(2, 8)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace heerk_rotor
