// Cost of the airloads of four blades with ten sections: one evaluation of section_loads at inputs that were not seen before, and of a
// second port at the same inputs. Forward flight; the azimuth wanders, so that the tables are read all over.
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/aero/c81_reader.hpp"
#include "heerk_rotor/models/blade_airloads.hpp"

namespace heerk_rotor {
namespace {

constexpr int kInputs = 64;
constexpr int kSections = 10;

BladeAirloads::Parameters parameters(int blades, bool tabulated, TableInterpolation interpolation = TableInterpolation::kLinear) {
  BladeAirloads::Parameters p;
  p.sections.blades = blades;
  p.sections.radius = 4.91;
  placeSections(SectionRule::kMidpoint, kSections, 1.08, 4.91, p.sections);
  p.chord.assign(kSections, 0.27);
  if (tabulated) {
    const C81Deck deck = readC81File(std::string(HEERK_SOURCE_DIR) + "/config/airfoils/naca0012_analytic.c81").deck;
    p.polars = blendedPolars({deck}, {0.0}, p.sections.r, interpolation);
  }
  return p;
}

/// Inputs of rigid blades in forward flight at random azimuths.
std::vector<Vector> flights(const BladeAirloads& model, const RotorSections& sections, double rotor_speed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector> list;
  for (int i = 0; i < kInputs; ++i) {
    std::vector<double> u;
    const double azimuth = 3.0 * unit(random);
    for (const InputPort& port : model.inputs()) {
      const std::size_t begin = u.size();
      u.resize(begin + static_cast<std::size_t>(port.size), 0.0);
      for (Index j = 0; j < sections.count(); ++j)
        for (Index k = 0; k < sections.blades; ++k) {
          const auto entry = [&](Index c, Index components) -> double& { return u[begin + static_cast<std::size_t>(sectionEntry(j, c, components, k, sections.blades))]; };
          const double psi = azimuth + 2.0 * M_PI * static_cast<double>(k) / sections.blades;
          if (port.name == "section_velocity") {
            entry(0, 3) = -45.0 * std::cos(psi);
            entry(1, 3) = rotor_speed * sections.r[j] + 45.0 * std::sin(psi);
            entry(2, 3) = 4.0 * unit(random);
          }
          if (port.name == "section_axes") entry(1, 6) = entry(5, 6) = 1.0;
          if (port.name == "section_pitch") entry(0, 1) = 0.12 - 0.08 * std::sin(psi);
        }
      if (port.name == "hub_motion") {
        u[begin] = azimuth;
        u[begin + 1] = rotor_speed;
      }
      if (port.name == "inflow") u[begin] = 0.02;
    }
    list.push_back(Eigen::Map<Vector>(u.data(), static_cast<Index>(u.size())));
  }
  return list;
}

void evaluate(benchmark::State& state, const BladeAirloads::Parameters& p, bool again) {
  BladeAirloads model(p);
  const std::vector<Vector> inputs = flights(model, p.sections, p.rotor_speed);
  const Vector x = Vector::Zero(static_cast<Index>(model.states().size()));
  Vector loads = Vector::Zero(p.sections.portSize(4)), rotor = Vector::Zero(3);
  std::size_t i = 0;
  for (auto _ : state) {
    const In u = view(inputs[i]);
    if (!again) i = (i + 1) % kInputs;
    model.evalOutput(0, 0.0, view(x), u, view(loads));
    benchmark::DoNotOptimize(loads.data());
    if (!again) continue;
    model.evalOutput(1, 0.0, view(x), u, view(rotor));
    benchmark::DoNotOptimize(rotor.data());
  }
}

void linearPolar(benchmark::State& state) { evaluate(state, parameters(static_cast<int>(state.range(0)), false), false); }
void table(benchmark::State& state, TableInterpolation interpolation) { evaluate(state, parameters(static_cast<int>(state.range(0)), true, interpolation), false); }
void unsteadyTable(benchmark::State& state) {
  BladeAirloads::Parameters p = parameters(static_cast<int>(state.range(0)), true);
  p.unsteady = BladeAirloads::Unsteady::kWagner;
  p.virtual_mass = true;
  p.angle_of_attack_point = BladeAirloads::AnglePoint::kThreeQuarterChord;
  evaluate(state, p, false);
}
/// Two ports at inputs already evaluated: what the kept results cost.
void bothPortsAgain(benchmark::State& state) { evaluate(state, parameters(static_cast<int>(state.range(0)), true), true); }

BENCHMARK(linearPolar)->ArgName("blades")->Arg(3)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(table, linear, TableInterpolation::kLinear)->ArgName("blades")->Arg(3)->Arg(4)->Arg(8);
BENCHMARK_CAPTURE(table, cubic, TableInterpolation::kMonotoneCubic)->ArgName("blades")->Arg(4);
BENCHMARK(unsteadyTable)->ArgName("blades")->Arg(4);
BENCHMARK(bothPortsAgain)->ArgName("blades")->Arg(4);

}  // namespace
}  // namespace heerk_rotor
