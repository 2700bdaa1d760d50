// Ports under every combination of options: a wrong feedthrough list would give wrong results silently.
#include "models/allocation_counter.hpp"
#include "models/blade_airloads_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// All combinations of the given alternatives of lines.
std::vector<std::string> combinations() {
  const std::vector<std::vector<std::string>> alternatives{{"kinematics: full", "kinematics: small_angle"},
                                                           {"angle_of_attack_point: quarter_chord", "angle_of_attack_point: three_quarter_chord"},
                                                           {"unsteady: none", "unsteady: wagner", "unsteady: beddoes"},
                                                           {"virtual_mass: false", "virtual_mass: true"},
                                                           {"inflow_position: undeformed", "inflow_position: deformed"},
                                                           {"elastic_axis: 0.25", "elastic_axis: 0.3"},
                                                           {"compressible: true", "compressible: false"}};
  std::vector<std::string> list{""};
  for (const auto& choices : alternatives) {
    std::vector<std::string> longer;
    for (const std::string& begin : list)
      for (const std::string& choice : choices) longer.push_back(begin + "    " + choice + "\n");
    list = longer;
  }
  return list;
}

TEST(BladeAirloadsOptions, outputsReadTheInputsTheyDeclareAndNoOthers) {
  for (const std::string& keys : combinations()) {
    AirloadsRig rig(rotorOf(3, 2), keys + "    moment: -0.02\n");
    ASSERT_EQ(rig.complaints, "") << keys;
    rig.randomize(9);
    const Vector u = rig.u;
    // Beddoes' function starts at zero: with small angles pitch then acts only through the states, which no list can tell.
    const bool delayed = keys.find("small_angle") != std::string::npos && keys.find("beddoes") != std::string::npos;
    for (const OutputPort& port : rig.outputs) {
      const Vector before = rig.output(port.name);
      EXPECT_TRUE(before.allFinite());
      for (const InputPort& input : rig.inputs) {
        const bool declared = std::find(port.feedthrough.begin(), port.feedthrough.end(), input.name) != port.feedthrough.end();
        for (Index i = 0; i < input.size; ++i) rig.port(input.name)[i] = declared ? rig.port(input.name)[i] + 0.01 * static_cast<double>(1 + i % 5) : std::nan("");
        const Vector after = rig.output(port.name);
        if (declared) EXPECT_FALSE(after == before && !delayed) << port.name << " does not read " << input.name << " with\n" << keys;
        else EXPECT_EQ(after, before) << port.name << " reads " << input.name << " with\n" << keys;
        rig.u = u;
      }
      for (const std::string& name : port.feedthrough) EXPECT_TRUE(rig.has(name)) << name << " with\n" << keys;
    }
  }
}

TEST(BladeAirloadsOptions, nothingIsAllocatedWhateverTheOptions) {
  if (!heapIsCounted()) GTEST_SKIP() << "the heap belongs to a sanitizer";
  for (const std::string& keys : combinations()) {
    AirloadsRig rig(rotorOf(4, 2), keys);
    rig.randomize(9);
    std::vector<Vector> y;
    for (const OutputPort& port : rig.outputs) y.push_back(Vector::Zero(port.size));
    Vector xdot = Vector::Zero(rig.x.size());
    std::uint64_t calls = 0;
    {
      HeapCalls heap;
      for (std::size_t p = 0; p < y.size(); ++p) rig.model->evalOutput(static_cast<Index>(p), 0.0, in(rig.x), in(rig.u), view(y[p]));
      rig.model->evalDerivatives(0.0, in(rig.x), in(rig.u), view(xdot));
      calls = heap.count();
    }
    EXPECT_EQ(calls, 0u) << keys;
  }
}

TEST(BladeAirloadsOptions, notANumberStaysOnItsBlade) {
  // Lanes do not leak: a blade with a NaN has NaN loads, the others the loads they had; and it is seen in the rotor's loads.
  for (const int blades : {3, 4, 8}) {
    AirloadsRig rig(rotorOf(blades), "    unsteady: wagner\n");
    rig.randomize(1);
    const Vector before = rig.output("section_loads");
    rig.at("section_velocity", 1, 2, 3, 1) = std::nan("");
    const Vector after = rig.output("section_loads");
    for (Index k = 0; k < blades; ++k) {
      if (k == 1) EXPECT_TRUE(std::isnan(rig.loadOf(after, 1, k)[2]));
      else EXPECT_EQ(rig.loadOf(after, 1, k), rig.loadOf(before, 1, k));
      EXPECT_EQ(rig.loadOf(after, 0, k), rig.loadOf(before, 0, k));
    }
    EXPECT_TRUE(std::isnan(rig.output("rotor_loads")[0]));
  }
}

}  // namespace
}  // namespace heerk_rotor
