#include "heerk_rotor/assembly/blade_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"

namespace heerk_rotor {
namespace {

/// Offers section ports of given sizes.
class Sections : public SubsystemModel {
 public:
  explicit Sections(std::vector<std::pair<std::string, Index>> ports) : ports_(std::move(ports)) {}
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override {
    std::vector<OutputPort> list;
    for (const auto& port : ports_) list.push_back({port.first, port.second, "-", "offered"});
    return list;
  }
  void evalOutput(Index, double, const In&, const In&, Out y) noexcept override { y.setZero(); }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  std::vector<std::pair<std::string, Index>> ports_;
};

CoupledSystem systemOf(std::vector<std::pair<std::string, Index>> ports) {
  CouplingGraph graph;
  graph.add("rotor", std::make_unique<Sections>(std::move(ports)));
  return std::move(graph).build();
}

Index beginOf(const CoupledSystem& system, const std::string& name) {
  for (const CoupledSystem::Output& output : system.outputs())
    if (output.name == "rotor." + name) return output.begin;
  return -1;
}

BladeShapes readOnce(const CoupledSystem& system, int blades, const Vector& y) {
  const BladeShapeView view(system, blades);
  EXPECT_TRUE(view.present());
  const Vector x, w;
  const SolverCounters counters;
  BladeShapes shapes;
  view.read({0, 0, 0.0, x, w, y, counters, 0, 0}, shapes);
  return shapes;
}

TEST(BladeShapes, pitchTurnsTheUnpitchedSectionAxesNoseUp) {
  const CoupledSystem system = systemOf({{"section_position", 18}, {"section_axes", 36}, {"section_pitch", 6}, {"section_loads", 24}});
  Vector y = Vector::Zero(system.outputSize());
  const Index section = 1, blade = 2;  // of 2 sections and 3 blades
  const auto set = [&](const char* port, Index component, Index components, double value) {
    y[beginOf(system, port) + sectionEntry(section, component, components, blade, 3)] = value;
  };
  set("section_position", 0, 3, 4.5);
  set("section_position", 1, 3, -0.1);
  set("section_position", 2, 3, 0.25);
  set("section_axes", 1, 6, 1.0);  // t along y, n along z
  set("section_axes", 5, 6, 1.0);
  set("section_pitch", 0, 1, 0.2);
  set("section_loads", 2, 4, 700.0);
  const BladeShapes shapes = readOnce(system, 3, y);
  EXPECT_EQ(shapes.blades, 3);
  ASSERT_EQ(shapes.sections, 2);
  const BladeShapes::Section& s = shapes.section[2][1];
  EXPECT_FLOAT_EQ(s.position[0], 4.5f);
  EXPECT_FLOAT_EQ(s.position[1], -0.1f);
  EXPECT_FLOAT_EQ(s.position[2], 0.25f);
  EXPECT_FLOAT_EQ(s.chordwise[1], static_cast<float>(std::cos(0.2)));
  EXPECT_FLOAT_EQ(s.chordwise[2], static_cast<float>(std::sin(0.2)));  // leading edge up
  EXPECT_FLOAT_EQ(s.load, 700.0f);
  EXPECT_EQ(shapes.section[1][1].load, 0.0f);  // the others untouched
  EXPECT_EQ(shapes.section[2][0].load, 0.0f);
}

TEST(BladeShapes, manySectionsAreThinnedOutEvenlyWithBothEnds) {
  for (const Index total : {1, 2, 13, 14, 15, 40, 200}) {
    const Index count = std::min<Index>(total, BladeShapes::kMaxSections);
    EXPECT_EQ(BladeShapeView::chosenSection(0, total), 0);
    EXPECT_EQ(BladeShapeView::chosenSection(count - 1, total), total - 1);
    for (Index i = 0; i + 1 < count; ++i) {
      const Index gap = BladeShapeView::chosenSection(i + 1, total) - BladeShapeView::chosenSection(i, total);
      EXPECT_GE(gap, (total - 1) / (count - 1)) << total;
      EXPECT_LE(gap, (total - 1) / (count - 1) + 1) << total;
    }
  }
}

TEST(BladeShapes, rigidBladesHaveNone) {
  const CoupledSystem system = systemOf({{"lag", 4}});
  EXPECT_FALSE(BladeShapeView(system, 4).present());
}

TEST(BladeShapes, sizesThatDoNotFitAreRefused) {
  const CoupledSystem system = systemOf({{"section_position", 17}, {"section_axes", 36}, {"section_pitch", 6}});
  try {
    BladeShapeView view(system, 3);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rotor.section_position has 17 entries, expected 18"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace heerk_rotor
