#include "heerk_rotor/beam/blade_properties.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "heerk_rotor/beam/blade_elements.hpp"

#include "blade_data.hpp"

namespace heerk_rotor {
namespace {

TEST(BladeProperties, shippedBladesAreInOrder) {
  EXPECT_TRUE(bladeProblems(bo105Blade()).empty());
  EXPECT_TRUE(bladeProblems(hart2Blade()).empty());
  EXPECT_TRUE(bladeProblems(uniformBlade(3)).empty());
}

TEST(BladeProperties, allProblemsAreNamedWithFoundAndExpected) {
  BladeProperties p = bo105Blade();
  p.nodes[3] = 0.1;
  p.mass[2] = 0.0;
  p.GJ = {1.0, 2.0};
  p.e = {0.2};
  p.tip_mass = -1;
  p.damping_stiffness = std::numeric_limits<double>::quiet_NaN();
  p.root.lag_damper = 5;
  const std::vector<std::string> problems = bladeProblems(p);
  ASSERT_EQ(problems.size(), 6u);
  EXPECT_EQ(problems[0], "nodes[3] = 0.1 m, expected more than nodes[2] = 0.37 m");
  EXPECT_EQ(problems[1], "mass[2] = 0 kg/m, expected a finite number > 0");
  EXPECT_EQ(problems[2], "GJ has 2 values, expected 1 or one for each of the 4 stations");
  EXPECT_EQ(problems[3], "tip_mass = -1 kg, expected a finite number >= 0");
  EXPECT_EQ(problems[4], "damping_stiffness = nan s, expected a finite number >= 0");
  EXPECT_EQ(problems[5], "lag_spring, lag_damper = 0, 5, expected 0: there is no lag hinge");
  EXPECT_THROW(assembleBlade(p), std::invalid_argument);
}

TEST(BladeProperties, massCentreOutsideTheSectionIsRefused) {
  BladeProperties p = uniformBlade(2);
  p.e = {0.02};  // km2 = 0.01
  ASSERT_EQ(bladeProblems(p).size(), 1u);
  EXPECT_NE(bladeProblems(p)[0].find("expected km1^2 + km2^2 > e^2"), std::string::npos);
}

TEST(BladeProperties, stationsMustCoverTheNodes) {
  BladeProperties p = bo105Blade();
  p.stations.front() = 0.25;
  p.stations.back() = 4.8;
  EXPECT_EQ(bladeProblems(p).size(), 2u);
}

TEST(BladeProperties, tablesAreLinearBetweenStations) {
  const BladeProperties p = bo105Blade();
  EXPECT_NEAR(static_cast<double>(bladeSection(p, 0.485L).mass), 0.5 * (22.20 + 5.55), 1e-14);
  EXPECT_NEAR(static_cast<double>(bladeSection(p, 0.20L).EI_flap), 69600, 1e-9);
  EXPECT_NEAR(static_cast<double>(bladeSection(p, 4.91L).EI_flap), 8700, 1e-9);
  const BladeSection middle = bladeSection(p, 2.0L);
  EXPECT_NEAR(static_cast<double>(middle.twist_rate), -8 * M_PI / 180 / 4.91, 1e-15);
  EXPECT_NEAR(static_cast<double>(middle.twist), -8 * M_PI / 180 * (2.0 / 4.91 - 0.75), 1e-15);
}

TEST(BladeTension, isTheExactIntegralOfTheMassDistribution) {
  // m = 3 - 2 r on 0..1 and a tip mass of 0.5: t = int_x^1 (3 r - 2 r^2) dr + 0.5.
  BladeProperties p = uniformBlade(3);
  p.stations = {0.0, 0.4, 1.0};  // an extra station on the same line changes nothing
  p.mass = {3.0, 2.2, 1.0};
  p.tip_mass = 0.5;
  const BladeTension t(p);
  for (double x : {0.0, 0.1, 1.0 / 3, 0.4, 0.77, 1.0})
    EXPECT_NEAR(static_cast<double>(t(x)), 1.5 * (1 - x * x) - 2.0 / 3 * (1 - x * x * x) + 0.5, 1e-15) << x;
  const BladeInertia inertia = bladeInertia(p);
  EXPECT_NEAR(inertia.mass, 2.5, 1e-15);
  EXPECT_NEAR(inertia.first_moment, static_cast<double>(t(0)), 1e-15);
  EXPECT_NEAR(inertia.second_moment, 1.0 - 0.5 + 0.5, 1e-15);
}

TEST(BladeElements, stationInsideAnElementIsIntegratedExactly) {
  // Mass with a kink inside an element: rigid translation and rotation give back the exact moments.
  BladeProperties p = uniformBlade(2);
  p.stations = {0.0, 0.3, 0.8, 1.0};
  p.mass = {5.0, 1.0, 2.0, 1.0};
  p.root.flap_hinge = p.root.lag_hinge = true;
  const BladeMatrices blade = assembleBlade(p);
  BeamVector flap = BeamVector::Zero(blade.size());  // w = r
  for (std::size_t node = 0; node < p.nodes.size(); ++node) {
    const int w = blade.free_dof[kNodeDofs * node + kDofW], slope = blade.free_dof[kNodeDofs * node + kDofSlopeW];
    if (w >= 0) flap[w] = p.nodes[node];
    if (slope >= 0) flap[slope] = 1;
  }
  const BladeInertia inertia = bladeInertia(p);
  EXPECT_NEAR(static_cast<double>(flap.dot(blade.M * flap)), inertia.second_moment, 1e-15);
  EXPECT_NEAR(static_cast<double>(flap.dot(blade.inertia_w)), inertia.first_moment, 1e-15);
  EXPECT_NEAR(static_cast<double>(flap.dot(blade.inertia_rw)), inertia.second_moment, 1e-15);
  // int t dr = int m r^2 dr: the tension stiffens rigid flapping by the moment of inertia.
  EXPECT_NEAR(static_cast<double>(flap.dot(blade.stiffness(1) * flap)), inertia.second_moment, 1e-15);
}

TEST(BladeElements, shapeRowsReproduceCubicsAndRefuseOtherRadii) {
  const BladeProperties p = uniformBlade(3);
  const BladeMatrices blade = assembleBlade(p);
  BeamVector q = BeamVector::Zero(blade.size());
  for (std::size_t node = 1; node < p.nodes.size(); ++node) {
    const BeamReal r = p.nodes[node];
    q[blade.free_dof[kNodeDofs * node + kDofV]] = r * r * r;
    q[blade.free_dof[kNodeDofs * node + kDofSlopeV]] = 3 * r * r;
    q[blade.free_dof[kNodeDofs * node + kDofW]] = r * r;
    q[blade.free_dof[kNodeDofs * node + kDofSlopeW]] = 2 * r;
    q[blade.free_dof[kNodeDofs * node + kDofTwist]] = 2 * r;
  }
  for (double r : {0.0, 0.2, 1.0 / 3, 0.5, 0.9, 1.0}) {
    const BeamVector y = blade.shapeRows(r) * q;
    EXPECT_NEAR(static_cast<double>(y[kRowV]), r * r * r, 1e-15);
    EXPECT_NEAR(static_cast<double>(y[kRowSlopeV]), 3 * r * r, 1e-14);
    EXPECT_NEAR(static_cast<double>(y[kRowW]), r * r, 1e-15);
    EXPECT_NEAR(static_cast<double>(y[kRowSlopeW]), 2 * r, 1e-14);
    EXPECT_NEAR(static_cast<double>(y[kRowTwist]), 2 * r, 1e-15);
  }
  EXPECT_THROW(blade.shapeRows(1.01), std::invalid_argument);
  EXPECT_THROW(blade.shapeRows(-0.01), std::invalid_argument);
}

TEST(BladeElements, tensionUntwistsAndBendsTheBladeItIsEccentricTo) {
  // Uniform blade: int t dr = int m r^2 dr = 1/3. Untwisting: -int t kA^2 beta' dphi'; eccentricity: int t eA (s dw'' + c dv'').
  BladeProperties p = uniformBlade(3);
  p.km1 = p.km2 = {0.01};  // no propeller moment
  p.stations = {0.0, 1.0};
  p.twist = {0.0, 0.3};
  p.kA = {0.05};
  const BladeMatrices twisted = assembleBlade(p);
  p.twist = {0.2};
  p.eA = {0.04};
  const BladeMatrices eccentric = assembleBlade(p);
  BeamVector twist = BeamVector::Zero(twisted.size()), flap = twist, lag = twist;  // phi = r; w = r^2 / 2; v = r^2 / 2
  for (std::size_t node = 1; node < p.nodes.size(); ++node) {
    const int* row = &twisted.free_dof[kNodeDofs * node];
    const BeamReal r = p.nodes[node];
    twist[row[kDofTwist]] = r;
    flap[row[kDofW]] = lag[row[kDofV]] = r * r / 2;
    flap[row[kDofSlopeW]] = lag[row[kDofSlopeV]] = r;
  }
  EXPECT_NEAR(static_cast<double>(twisted.steadyLoad(2).dot(twist)), -4 * 0.05 * 0.05 * 0.3 / 3, 1e-16);
  EXPECT_NEAR(static_cast<double>(eccentric.steadyLoad(2).dot(flap)), 4 * 0.04 * std::sin(0.2) / 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(eccentric.steadyLoad(2).dot(lag)), 4 * 0.04 * std::cos(0.2) / 3, 1e-15);
  EXPECT_NEAR(static_cast<double>(eccentric.steadyLoad(2).dot(twist)), 0, 1e-16);
}

}  // namespace
}  // namespace heerk_rotor
