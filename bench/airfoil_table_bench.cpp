// Cost of the table lookup and of section loads, over inputs that wander through the table so that neither the branch
// predictor nor one cached cell flatters the result. Time per item: one lookup or one section of one blade.
#include <cmath>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/aero/airfoil_table.hpp"
#include "heerk_rotor/aero/c81_reader.hpp"
#include "heerk_rotor/aero/linear_polar.hpp"
#include "heerk_rotor/aero/section_loads.hpp"

namespace heerk_rotor {
namespace {

constexpr int kInputs = 1024;

C81Deck deck() { return readC81File(std::string(HEERK_SOURCE_DIR) + "/config/airfoils/naca0012_analytic.c81").deck; }

/// A smooth airfoil on a grid of alpha_count x mach_count points, evenly spaced.
C81Deck gridDeck(int alpha_count, int mach_count) {
  C81Block block;
  for (int j = 0; j < mach_count; ++j) block.mach.push_back(static_cast<double>(j) / (mach_count - 1));
  for (int i = 0; i < alpha_count; ++i) block.alpha_deg.push_back(-180.0 + 360.0 * i / (alpha_count - 1));
  for (const double alpha : block.alpha_deg)
    for (const double mach : block.mach) block.values.push_back(std::sin(alpha * M_PI / 180.0) * (1.0 + 0.3 * mach * mach));
  return {"grid", block, block, block};
}

template <int N>
void lookup(benchmark::State& state, const AirfoilTable& table) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> alpha(-0.3, 0.3), mach(0.1, 0.9);
  std::vector<Lanes<N>> alphas(kInputs), machs(kInputs);
  for (int i = 0; i < kInputs; ++i)
    for (int k = 0; k < N; ++k) {
      alphas[i][k] = alpha(random);
      machs[i][k] = mach(random);
    }
  int i = 0;
  for (auto _ : state) {
    Lanes<N> lift, drag, moment;
    table.at(alphas[i], machs[i], lift, drag, moment);
    benchmark::DoNotOptimize(lift);
    benchmark::DoNotOptimize(drag);
    benchmark::DoNotOptimize(moment);
    i = (i + 1) % kInputs;
  }
  state.counters["time/item"] = benchmark::Counter(static_cast<double>(state.iterations()) * N, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <int N, class Polar>
void sections(benchmark::State& state, const Polar& polar, double elastic_axis = 0.25) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> tangential(-20.0, 240.0), perpendicular(-10.0, 20.0), pitch(-0.1, 0.3);
  std::vector<SectionFlow<N>> flows(kInputs);
  for (SectionFlow<N>& flow : flows)
    for (int k = 0; k < N; ++k) {
      flow.tangential[k] = tangential(random);
      flow.perpendicular[k] = perpendicular(random);
      flow.pitch[k] = pitch(random);
      flow.lag_angle[k] = 0.0;
    }
  BladeSection section;
  section.elastic_axis = elastic_axis;
  int i = 0;
  for (auto _ : state) {
    SectionLoads<N> loads;
    sectionLoads(section, polar, Air(), SectionKinematics::kFull, flows[i], loads);
    benchmark::DoNotOptimize(loads);
    i = (i + 1) % kInputs;
  }
  state.counters["time/item"] = benchmark::Counter(static_cast<double>(state.iterations()) * N, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Calls run(state, lanes) with as many lanes as the benchmark's argument says.
template <class Run>
void withLanes(benchmark::State& state, const Run& run) {
  switch (state.range(0)) {
    case 1: return run(std::integral_constant<int, 1>());
    case 4: return run(std::integral_constant<int, 4>());
    case 8: return run(std::integral_constant<int, 8>());
    default: state.SkipWithError("no such number of lanes");
  }
}

void airfoilLookup(benchmark::State& state, TableInterpolation interpolation) {
  withLanes(state, [&](auto lanes) { lookup<lanes>(state, AirfoilTable(deck(), interpolation)); });
}
/// Four lanes; arguments: points in alpha and in Mach number. The largest table is 1.5 MB, beyond the second-level cache.
void lookupOfSize(benchmark::State& state) {
  lookup<4>(state, AirfoilTable(gridDeck(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)))));
}
void tableSection(benchmark::State& state, TableInterpolation interpolation, double elastic_axis) {
  withLanes(state, [&](auto lanes) { sections<lanes>(state, AirfoilTable(deck(), interpolation), elastic_axis); });
}
void linearSection(benchmark::State& state) {
  withLanes(state, [&](auto lanes) { sections<lanes>(state, LinearPolar()); });
}

constexpr TableInterpolation kLinear = TableInterpolation::kLinear, kCubic = TableInterpolation::kMonotoneCubic;
BENCHMARK_CAPTURE(airfoilLookup, linear, kLinear)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(airfoilLookup, cubic, kCubic)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK(lookupOfSize)->ArgNames({"alpha", "mach"})->Args({19, 3})->Args({37, 6})->Args({73, 11})->Args({181, 21})->Args({361, 41})->Args({721, 61});
BENCHMARK(linearSection)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(tableSection, linear, kLinear, 0.25)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(tableSection, linear_offset_axis, kLinear, 0.27)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(tableSection, cubic, kCubic, 0.25)->ArgName("lanes")->Arg(1)->Arg(4)->Arg(8);

}  // namespace
}  // namespace heerk_rotor
