#include "heerk_rotor/assembly/shaft_view.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "assembly/offering.hpp"
#include "heerk_rotor/assembly/machine_kind.hpp"
#include "heerk_rotor/assembly/shaft_shape.hpp"

namespace heerk_rotor {
namespace {

using test::Offering;
using test::systemOf;

std::string refusal(const CoupledSystem& system) {
  try {
    machineKind(system);
    ShaftShapeView shape(system);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

/// y is 1, 2, 3, .. in the order of the ports.
ShaftReading readCounting(const CoupledSystem& system) {
  const Vector x, w, y = Vector::LinSpaced(system.outputSize(), 1.0, static_cast<double>(system.outputSize()));
  ShaftReading reading;
  ShaftView(system).read({7, 2, 0.25, x, w, y, SolverCounters(), 4, 9}, reading);
  return reading;
}

TEST(ShaftView, findsEveryQuantityWhateverSubsystemOffersIt) {
  const CoupledSystem system = systemOf(Offering({{"displacement", 4}, {"journal_motion", 4}, {"bearing_force", 4}, {"azimuth", 1}, {"rotor_speed", 1}}),
                                        Offering({{"film_force", 2}, {"eccentricity_ratio", 1}}));
  const ShaftReading r = readCounting(system);
  EXPECT_EQ(r.step, 7u);
  EXPECT_EQ(r.epoch, 2u);
  EXPECT_EQ(r.sim_time, 0.25);
  ASSERT_EQ(r.discs, 2);
  EXPECT_EQ(r.disc_x[0], 1.0);
  EXPECT_EQ(r.disc_y[0], 2.0);
  EXPECT_EQ(r.disc_x[1], 3.0);
  EXPECT_EQ(r.disc_y[1], 4.0);
  EXPECT_EQ(r.journal_x, 5.0);
  EXPECT_EQ(r.journal_y, 6.0);
  EXPECT_EQ(r.bearing_force_x, 9.0);
  EXPECT_EQ(r.bearing_force_y, 10.0);
  EXPECT_EQ(r.azimuth, 13.0);
  EXPECT_EQ(r.rotor_speed, 14.0);
  EXPECT_EQ(r.film_force_x, 15.0);
  EXPECT_EQ(r.film_force_y, 16.0);
  EXPECT_EQ(r.eccentricity_ratio, 17.0);
  EXPECT_EQ(r.newton_iterations, 4u);
  EXPECT_EQ(r.residual_evaluations, 9u);
}

TEST(ShaftView, whatIsAbsentStaysZero) {
  const ShaftReading r = readCounting(systemOf(Offering({{"displacement", 2}})));
  EXPECT_EQ(r.discs, 1);
  EXPECT_EQ(r.disc_y[0], 2.0);
  EXPECT_EQ(r.journal_x, 0.0);
  EXPECT_EQ(r.film_force_y, 0.0);
  EXPECT_EQ(r.eccentricity_ratio, 0.0);
}

TEST(ShaftView, everyNumberOfAReadingIsLookedAtForBeingFinite) {
  const CoupledSystem system = systemOf(Offering({{"displacement", 2 * ShaftReading::kMaxDiscs}, {"journal_motion", 4}, {"bearing_force", 2}, {"azimuth", 1}, {"rotor_speed", 1},
                                                  {"film_force", 2}, {"eccentricity_ratio", 1}}));
  const ShaftView view(system);
  const Vector x, w;
  for (Index i = 0; i <= system.outputSize(); ++i) {
    Vector y = Vector::Constant(system.outputSize(), 1e300);
    if (i < system.outputSize()) y[i] = i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    ShaftReading reading;
    view.read({0, 0, 0.0, x, w, y, SolverCounters(), 0, 0}, reading);
    const bool rate = i == 2 * ShaftReading::kMaxDiscs + 2 || i == 2 * ShaftReading::kMaxDiscs + 3;  // of the journal: not told
    EXPECT_EQ(isFinite(reading), rate || i == system.outputSize()) << "entry " << i;
  }
}

TEST(ShaftView, refusesWhatDoesNotFitAndSaysWhat) {
  EXPECT_NE(refusal(systemOf(Offering({{"displacement", 3}}))).find("displacement has 3 entries, expected an even number"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"displacement", 10}}))).find("displacement has 5 discs, expected at most 4"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"displacement", 2}, {"journal_motion", 2}}))).find("part_0.journal_motion has 2 entries, expected 4"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"film_force", 2}}), Offering({{"film_force", 2}}))).find("both part_0.film_force and part_1.film_force offer film_force"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"node_displacement", 3}}))).find("node_displacement has 3 entries, expected an even number"), std::string::npos);
}

TEST(ShaftView, theKindOfMachineIsWhatTheSystemOffers) {
  EXPECT_EQ(machineKind(systemOf(Offering({{"displacement", 4}, {"azimuth", 1}}))), MachineKind::kShaft);
  EXPECT_EQ(machineKind(systemOf(Offering({{"lag", 4}, {"azimuth", 1}}))), MachineKind::kRotor);
  EXPECT_EQ(machineKind(systemOf(Offering({{"azimuth", 1}}))), MachineKind::kOther);
  EXPECT_NE(refusal(systemOf(Offering({{"lag", 4}}), Offering({{"displacement", 4}}))).find("expected one of both"), std::string::npos);
}

TEST(ShaftShape, isTheCentreLineNodeByNode) {
  const CoupledSystem system = systemOf(Offering({{"azimuth", 1}, {"node_displacement", 6}}));
  Vector y(7);
  y << 9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;
  const Vector x, w;
  ShaftShape shape;
  ShaftShapeView(system).read({0, 0, 0.0, x, w, y, SolverCounters(), 0, 0}, shape);
  ASSERT_EQ(shape.nodes, 3);
  EXPECT_EQ(shape.x[1], 3.0f);
  EXPECT_EQ(shape.y[2], 6.0f);
  EXPECT_TRUE(isFinite(shape));
  shape.y[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(isFinite(shape));
}

TEST(ShaftShape, ofMoreNodesThanAPictureNeedsIsNotDrawn) {
  const CoupledSystem system = systemOf(Offering({{"node_displacement", 2 * ShaftShape::kMaxNodes + 2}}));
  const Vector x, w, y = Vector::Zero(system.outputSize());
  ShaftShape shape;
  ShaftShapeView(system).read({0, 0, 0.0, x, w, y, SolverCounters(), 0, 0}, shape);
  EXPECT_EQ(shape.nodes, 0);
}

}  // namespace
}  // namespace heerk_rotor
