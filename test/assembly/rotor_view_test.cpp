#include "heerk_rotor/assembly/rotor_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "assembly/offering.hpp"

namespace heerk_rotor {
namespace {

using test::Offering;
using test::systemOf;

std::string refusal(const CoupledSystem& system) {
  try {
    RotorView view(system);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

RotorReading readOnce(const CoupledSystem& system, const Vector& y, const Vector& w) {
  RotorView view(system);
  const Vector x;
  const SolverCounters counters;
  RotorReading reading;
  view.read({7, 2, 0.5, x, w, y, counters, 0, 0}, reading);
  return reading;
}

TEST(RotorView, findsQuantitiesByNameWhateverSubsystemOffersThem) {
  const CoupledSystem system = systemOf(Offering({{"unrelated", 2}, {"azimuth", 1}, {"hub_force", 3}}),
                                        Offering({{"lag", 3}, {"pitch", 3}, {"inflow", 2}, {"fuselage_orientation", 4}}, {"longitudinal_cyclic", "collective", "lateral_cyclic"}));
  Vector y(system.outputSize());
  for (Index i = 0; i < y.size(); ++i) y[i] = 10.0 + static_cast<double>(i);  // in the order the ports are declared
  Vector w(3);
  w << 1.0, 2.0, 3.0;
  const RotorReading r = readOnce(system, y, w);
  EXPECT_EQ(r.step, 7u);
  EXPECT_EQ(r.epoch, 2u);
  EXPECT_EQ(r.sim_time, 0.5);
  EXPECT_EQ(r.blades, 3);
  EXPECT_EQ(r.azimuth, 12.0);
  EXPECT_EQ(r.hub_force, (std::array<double, 3>{13.0, 14.0, 15.0}));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(r.lag[k], 16.0 + static_cast<double>(k));
    EXPECT_EQ(r.pitch[k], 19.0 + static_cast<double>(k));
  }
  EXPECT_EQ(r.lag[3], 0.0);
  EXPECT_EQ(r.inflow_states, 2);
  EXPECT_EQ(r.inflow[1], 23.0);
  EXPECT_EQ(r.orientation, (std::array<double, 4>{24.0, 25.0, 26.0, 27.0}));
  EXPECT_EQ(r.longitudinal_cyclic, 1.0);
  EXPECT_EQ(r.collective, 2.0);
  EXPECT_EQ(r.lateral_cyclic, 3.0);
}

TEST(RotorView, whatIsAbsentStaysZeroAndTheOrientationIdentity) {
  const CoupledSystem system = systemOf(Offering({{"lag", 4}}));
  const RotorView view(system);
  EXPECT_FALSE(CommandView(system).hasSwashplate());
  EXPECT_EQ(view.blades(), 4);
  const RotorReading r = readOnce(system, Vector::Constant(4, 0.5), Vector());
  EXPECT_EQ(r.azimuth, 0.0);
  EXPECT_EQ(r.hub_force, (std::array<double, 3>{}));
  EXPECT_EQ(r.orientation, (std::array<double, 4>{1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(r.collective, 0.0);
}

TEST(RotorView, multibladeCoordinatesReturnTheHarmonicsThatMadeTheAngles) {
  const CoupledSystem system = systemOf(Offering({{"azimuth", 1}, {"lag", 4}, {"flap", 4}}));
  const double azimuth = 123.4, lag0 = -0.03, lagc = 0.01, lags = -0.02;
  Vector y(9);
  y[0] = azimuth;
  for (int k = 0; k < 4; ++k) {
    const double psi = azimuth + k * M_PI / 2.0;
    y[1 + k] = lag0 + lagc * std::cos(psi) + lags * std::sin(psi);
    y[5 + k] = 0.05 + 0.004 * std::cos(psi);
  }
  const RotorReading r = readOnce(system, y, Vector());
  EXPECT_NEAR(r.lag_collective, lag0, 1e-15);
  EXPECT_NEAR(r.lag_cosine, lagc, 1e-14);
  EXPECT_NEAR(r.lag_sine, lags, 1e-14);
  EXPECT_NEAR(r.flap_collective, 0.05, 1e-15);
  EXPECT_NEAR(r.flap_cosine, 0.004, 1e-14);
  EXPECT_NEAR(r.flap_sine, 0.0, 1e-14);
}

TEST(RotorView, passesOnWhatTheSolverSpentOnTheStep) {
  const CoupledSystem system = systemOf(Offering({{"lag", 2}}));
  const RotorView view(system);
  const Vector x, w, y = Vector::Zero(2);
  RotorReading reading;
  view.read({1, 0, 0.1, x, w, y, SolverCounters(), 4, 7}, reading);
  EXPECT_EQ(reading.newton_iterations, 4u);
  EXPECT_EQ(reading.residual_evaluations, 7u);
}

TEST(RotorView, refusesTwoSourcesOfOneQuantityAndNamesBoth) {
  const std::string text = refusal(systemOf(Offering({{"lag", 4}}), Offering({{"lag", 4}})));
  EXPECT_NE(text.find("part_0.lag"), std::string::npos) << text;
  EXPECT_NE(text.find("part_1.lag"), std::string::npos) << text;
  const std::string commands = refusal(systemOf(Offering({{"lag", 4}}, {"collective"}), Offering({{"flap", 4}}, {"collective"})));
  EXPECT_NE(commands.find("part_0.collective"), std::string::npos) << commands;
  EXPECT_NE(commands.find("part_1.collective"), std::string::npos) << commands;
}

TEST(RotorView, refusesSizesThatDisagree) {
  EXPECT_NE(refusal(systemOf(Offering({{"hub_force", 2}}))).find("part_0.hub_force has 2 entries, expected 3"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"lag", 4}, {"pitch", 3}}))).find("pitch has 3 blades, but lag has 4"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"lag", 9}}))).find("lag has 9 blades, expected at most 8"), std::string::npos);
  EXPECT_NE(refusal(systemOf(Offering({{"inflow", 9}}))).find("inflow has 9 entries, expected at most 8"), std::string::npos);
}

TEST(CommandView, findsDisturbancesCompleteOrNotAtAll) {
  const CoupledSystem system = systemOf(Offering({{"azimuth", 1}}, {"speed", "wind_z", "wind_x", "wind_y"}),
                                        Offering({{"lag", 3}}, {"external_moment_x", "external_moment_y", "external_moment_z", "external_force_x", "external_force_y", "external_force_z"}));
  const CommandView view(system);
  EXPECT_EQ(view.speed(), (std::vector<Index>{0}));
  EXPECT_EQ(view.wind(), (std::vector<Index>{2, 3, 1}));
  EXPECT_EQ(view.externalWrench(), (std::vector<Index>{7, 8, 9, 4, 5, 6}));
  const CommandView none(systemOf(Offering({{"lag", 3}})));
  EXPECT_TRUE(none.speed().empty() && none.wind().empty() && none.externalWrench().empty());
  EXPECT_EQ(refusal(systemOf(Offering({{"lag", 3}}, {"wind_x", "wind_y"}))), "command view: the system takes the command part_0.wind_x but none called wind_z");
}

}  // namespace
}  // namespace heerk_rotor
