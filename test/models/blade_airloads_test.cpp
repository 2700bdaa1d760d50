#include "heerk_rotor/models/blade_airloads.hpp"

#include "models/blade_airloads_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kRho = 1.225, kSound = 340.3, kChord = 0.27, kSlope = 5.7, kDrag0 = 0.012, kDrag2 = 0.7;
const std::string kLinear = "    lift_slope: 5.7\n    drag: [0.012, 0.0, 0.7]\n    moment: -0.02\n    zero_lift_angle: -0.01\n";

class BladeAirloadsOf : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Blades, BladeAirloadsOf, testing::Values(2, 3, 4, 5, 8), [](const auto& info) { return "n" + std::to_string(info.param); });

/// Load of one section, written down blade by blade from the model card, attached flow.
Eigen::Vector4d expectedLoad(AirloadsRig& rig, Index j, Index k) {
  const auto component = [&](const std::string& port, Index c, Index components) { return rig.at(port, j, c, components, k); };
  const double psi = rig.azimuth(k), tip_speed = kOmega * rig.sections.radius, r = rig.sections.r[j] / rig.sections.radius;
  Eigen::Matrix3d hub_to_blade;  // rows: e_r, e_y, z in hub_link
  hub_to_blade << -std::cos(psi), -std::sin(psi), 0, std::sin(psi), -std::cos(psi), 0, 0, 0, 1;
  const double* const wind = rig.port("hub_wind");
  const double* const inflow = rig.port("inflow");
  const double lambda = inflow[0] + r * (inflow[1] * std::sin(psi) + inflow[2] * std::cos(psi));
  Eigen::Vector3d velocity, t, n;
  for (Index c = 0; c < 3; ++c) {
    velocity[c] = component("section_velocity", c, 3);
    t[c] = component("section_axes", c, 6);
    n[c] = component("section_axes", 3 + c, 6);
  }
  const Eigen::Vector3d air = hub_to_blade * Eigen::Vector3d(wind[0], wind[1], wind[2]) - lambda * tip_speed * Eigen::Vector3d::UnitZ() - velocity;
  const double ut = -air.dot(t), up = -air.dot(n), speed = std::hypot(ut, up), phi = std::atan2(up, ut);
  const double alpha = component("section_pitch", 0, 1) - phi, mach = speed / kSound;
  const double cl = kSlope / std::sqrt(1.0 - mach * mach) * (alpha + 0.01), cd = kDrag0 + kDrag2 * alpha * alpha;
  const double q = 0.5 * kRho * speed * speed * kChord * rig.sections.width[j];
  const Eigen::Vector3d force = q * ((cl * std::cos(phi) - cd * std::sin(phi)) * n - (cl * std::sin(phi) + cd * std::cos(phi)) * t);
  return {force.x(), force.y(), force.z(), -0.02 * q * kChord};
}

TEST_P(BladeAirloadsOf, loadsAreThoseOfTheModelCard) {
  // Sections far enough out for attached flow in any random flight.
  AirloadsRig rig("blades: " + std::to_string(GetParam()) + ", nodes: [0.2, 4.91], root_cutout: 2.5, sections: 5", kLinear);
  ASSERT_EQ(rig.complaints, "");
  for (unsigned seed = 1; seed <= 10; ++seed) {
    rig.randomize(seed);
    const Vector loads = rig.output("section_loads"), alpha = rig.output("angle_of_attack"), mach = rig.output("mach");
    double thrust = 0.0, sine = 0.0, cosine = 0.0;
    for (Index j = 0; j < rig.sections.count(); ++j)
      for (Index k = 0; k < rig.blades(); ++k) {
        const Index entry = sectionEntry(j, 0, 1, k, rig.blades());
        ASSERT_LT(std::abs(alpha[entry]), 0.25 * M_PI);  // where the formulas of expectedLoad hold
        ASSERT_LT(mach[entry], LinearPolar::kMachLimit);
        const Eigen::Vector4d expected = expectedLoad(rig, j, k);
        // Some twenty operations of relative error 1e-16, amplified by 1 / alpha and by the nearness of Mach to 1.
        EXPECT_LT((rig.loadOf(loads, j, k) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.norm()) << j << ", " << k;
        const double r = rig.sections.r[j] / rig.sections.radius;
        thrust += expected[2];
        sine += r * std::sin(rig.azimuth(k)) * expected[2];
        cosine += r * std::cos(rig.azimuth(k)) * expected[2];
      }
    const double R = rig.sections.radius, reference = kRho * M_PI * R * R * std::pow(kOmega * R, 2);
    const Vector rotor = rig.output("rotor_loads");
    const double scale = 1e-12 * loads.cwiseAbs().sum() / reference;
    EXPECT_NEAR(rotor[0], thrust / reference, scale);
    EXPECT_NEAR(rotor[1], sine / reference, scale);
    EXPECT_NEAR(rotor[2], cosine / reference, scale);
  }
}

TEST_P(BladeAirloadsOf, renumberingTheBladesChangesOnlyTheLabels) {
  // Blade k of the turned rotor stands where blade k + 1 stood, and moves like it.
  for (const std::string options : {"", "    unsteady: beddoes\n    virtual_mass: true\n    angle_of_attack_point: three_quarter_chord\n    inflow_position: deformed\n"}) {
    AirloadsRig one(rotorOf(GetParam(), 4), kLinear + options), other(rotorOf(GetParam(), 4), kLinear + options);
    one.randomize(7);
    other.u = one.u;
    other.x = one.x;
    const Index N = one.blades();
    other.port("hub_motion")[0] += 2.0 * M_PI / static_cast<double>(N);
    const auto shift = [&](const double* from, Index size, double* to) {
      for (Index i = 0; i < size; ++i) to[i] = from[i / N * N + (i % N + 1) % N];
    };
    for (const InputPort& port : one.inputs)
      if (port.name.rfind("section_", 0) == 0) shift(one.port(port.name), port.size, other.port(port.name));
    shift(one.x.data(), one.x.size(), other.x.data());

    const Vector before = one.output("section_loads"), after = other.output("section_loads");
    Vector expected = before;
    shift(before.data(), before.size(), expected.data());
    // The azimuth is rounded to 4e-16 rad when it is shifted, and so are the products of sines and cosines that turn wind and inflow.
    EXPECT_LT((after - expected).cwiseAbs().maxCoeff(), 1e-14 * before.cwiseAbs().maxCoeff() * static_cast<double>(N));
    EXPECT_LT((one.output("rotor_loads") - other.output("rotor_loads")).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST_P(BladeAirloadsOf, turningRotorWindAndInflowTogetherChangesNothingOnTheBlades) {
  AirloadsRig rig(rotorOf(GetParam()), kLinear);
  rig.randomize(3);
  const Vector loads = rig.output("section_loads"), rotor = rig.output("rotor_loads"), flow = rig.output("hub_flow");
  const double delta = 0.7, c = std::cos(delta), s = std::sin(delta);
  const auto turnVector = [&](double* v) {
    const double x = v[0], y = v[1];
    v[0] = c * x - s * y;
    v[1] = s * x + c * y;
  };
  turnVector(rig.port("hub_wind"));
  turnVector(rig.port("mount_velocity"));
  rig.port("hub_motion")[0] += delta;
  // l1s sin psi + l1c cos psi with psi one turn delta further: (l1c, l1s) turns like a vector.
  double harmonics[2] = {rig.port("inflow")[2], rig.port("inflow")[1]};
  turnVector(harmonics);
  rig.port("inflow")[2] = harmonics[0];
  rig.port("inflow")[1] = harmonics[1];
  EXPECT_LT((rig.output("section_loads") - loads).cwiseAbs().maxCoeff(), 1e-13 * loads.cwiseAbs().maxCoeff());
  double expected[2] = {rotor[2], rotor[1]}, expected_flow[2] = {flow[0], flow[1]};
  turnVector(expected);
  turnVector(expected_flow);
  const Vector turned = rig.output("rotor_loads"), turned_flow = rig.output("hub_flow");
  EXPECT_NEAR(turned[0], rotor[0], 1e-15);
  EXPECT_NEAR(turned[1], expected[1], 1e-15);
  EXPECT_NEAR(turned[2], expected[0], 1e-15);
  EXPECT_NEAR(turned_flow[0], expected_flow[0], 1e-15);
  EXPECT_NEAR(turned_flow[1], expected_flow[1], 1e-15);
  EXPECT_EQ(turned_flow[2], flow[2]);
}

TEST(BladeAirloads, windIsMotionTheOtherWay) {
  AirloadsRig still(rotorOf(4), kLinear), windy(rotorOf(4), kLinear);
  still.randomize(5);
  windy.u = still.u;
  for (int i = 0; i < 3; ++i) {
    const double wind = still.port("hub_wind")[i];
    still.port("hub_wind")[i] = 0.0;
    still.port("mount_velocity")[i] -= wind;
    for (Index j = 0; j < still.sections.count(); ++j)
      for (Index k = 0; k < 4; ++k) {
        const double c = std::cos(still.azimuth(k)), s = std::sin(still.azimuth(k));
        const double x[3] = {-c, -s, 0.0}, y[3] = {s, -c, 0.0}, z[3] = {0.0, 0.0, 1.0};
        still.at("section_velocity", j, 0, 3, k) -= wind * x[i];
        still.at("section_velocity", j, 1, 3, k) -= wind * y[i];
        still.at("section_velocity", j, 2, 3, k) -= wind * z[i];
      }
  }
  const Vector loads = windy.output("section_loads");
  EXPECT_LT((still.output("section_loads") - loads).cwiseAbs().maxCoeff(), 1e-12 * loads.cwiseAbs().maxCoeff());
  EXPECT_LT((still.output("hub_flow") - windy.output("hub_flow")).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(BladeAirloads, liftDoesNoWorkAndDragTakesItAll) {
  // Without induced flow and wind the force's power is -D W, exactly: lift is perpendicular to the motion across the span.
  for (const std::string drag : {"0.0", "0.02"}) {
    AirloadsRig rig(rotorOf(4, 6), "    lift_slope: 5.7\n    drag: " + drag + "\n");
    rig.randomize(11);
    for (int i = 0; i < 3; ++i) rig.port("hub_wind")[i] = rig.port("inflow")[i] = 0.0;
    const Vector loads = rig.output("section_loads"), mach = rig.output("mach");
    for (Index j = 0; j < rig.sections.count(); ++j)
      for (Index k = 0; k < 4; ++k) {
        const Eigen::Vector4d load = rig.loadOf(loads, j, k);
        double power = 0.0, scale = 0.0;
        for (Index c = 0; c < 3; ++c) {
          power += load[c] * rig.at("section_velocity", j, c, 3, k);
          scale += std::abs(load[c] * rig.at("section_velocity", j, c, 3, k));
        }
        const double speed = mach[sectionEntry(j, 0, 1, k, 4)] * kSound;
        EXPECT_NEAR(power, -0.5 * kRho * kChord * rig.sections.width[j] * std::stod(drag) * speed * speed * speed, 1e-13 * scale);
      }
  }
}

TEST(BladeAirloads, inReverseFlowPitchUpPushesDownAndDragOpposesTheMotion) {
  AirloadsRig rig(rotorOf(2), "    lift_slope: 5.7\n    drag: 0.02\n    compressible: false\n");
  rig.level();
  rig.set("section_velocity", 1, 0, {0.0, -30.0, 0.0});
  rig.set("section_pitch", 1, 0, {0.05});
  const Eigen::Vector4d load = rig.load(1, 0);
  const double q = 0.5 * kRho * 30.0 * 30.0 * kChord * rig.sections.width[1];
  EXPECT_NEAR(load[2], -q * 5.7 * 0.05, 1e-12 * q);
  EXPECT_NEAR(load[1], q * 0.02, 1e-12 * q);
  EXPECT_NEAR(rig.output("mach")[sectionEntry(1, 0, 1, 0, 2)], 30.0 / kSound, 1e-15);  // told although not used
}

TEST(BladeAirloads, tipLossTakesTheLiftAndLeavesTheDrag) {
  AirloadsRig with(rotorOf(4, 40), "    tip_loss_factor: 0.97\n    kinematics: small_angle\n"), without(rotorOf(4, 40), "    kinematics: small_angle\n");
  with.turn(kOmega, 0.1);
  without.turn(kOmega, 0.1);
  const Vector a = with.output("section_loads"), b = without.output("section_loads");
  for (Index j = 0; j < 40; ++j) {
    const double r = with.sections.r[j] / with.sections.radius;
    if (std::abs(r - 0.97) < 0.005 + 0.5 * with.sections.width[j] / with.sections.radius) continue;  // the step is in this segment
    EXPECT_EQ(with.loadOf(a, j, 2)[2], r < 0.97 ? without.loadOf(b, j, 2)[2] : 0.0) << r;
    EXPECT_EQ(with.loadOf(a, j, 2)[1], without.loadOf(b, j, 2)[1]) << r;
  }
}

TEST(BladeAirloads, aFewSectionsLoseAsMuchTipLiftAsMany) {
  // Share of the thrust lost, and the share that sections outside B R have of it without tip loss.
  const auto thrustLost = [](int sections, double& outside) {
    const std::string rotor = rotorOf(4, sections);
    const std::string polar = "    kinematics: small_angle\n";
    AirloadsRig with(rotor, polar + "    tip_loss_factor: 0.97\n"), without(rotor, polar);
    with.turn(kOmega, 0.1);
    without.turn(kOmega, 0.1);
    const Vector loads = without.output("section_loads");
    double all = 0.0;
    outside = 0.0;
    for (Index j = 0; j < sections; ++j) {
      double lift = 0.0;  // along the shaft, of all blades
      for (int k = 0; k < 4; ++k) lift += loads[sectionEntry(j, 2, 4, k, 4)];
      all += lift;
      if (without.sections.r[j] > 0.97 * without.sections.radius) outside += lift;
    }
    outside /= all;
    return 1.0 - with.output("rotor_loads")[0] / without.output("rotor_loads")[0];
  };
  double outside, ignored;
  const double many = thrustLost(200, outside), few = thrustLost(10, ignored);
  EXPECT_NEAR(many, outside, 0.006);            // half a section: 1.3 % of the thrust at most
  EXPECT_NEAR(few, many, 0.08 * many);          // the load is taken as constant within a segment, which its growth towards the tip is not
}

TEST(BladeAirloads, theChordIsLinearBetweenItsStations) {
  AirloadsRig tapered(rotorOf(4, 10), "    chord: [0.3, 0.3, 0.2]\n    chord_stations: [0.0, 0.5, 1.0]\n    kinematics: small_angle\n");
  AirloadsRig unit(rotorOf(4, 10), "    chord: 1.0\n    kinematics: small_angle\n");
  ASSERT_EQ(tapered.complaints, "");
  tapered.turn(kOmega, 0.1);
  unit.turn(kOmega, 0.1);
  for (Index j = 0; j < 10; ++j) {
    const double r = tapered.sections.r[j] / tapered.sections.radius;
    EXPECT_NEAR(tapered.load(j, 1)[2] / unit.load(j, 1)[2], r < 0.5 ? 0.3 : 0.3 - 0.2 * (r - 0.5), 1e-14);
  }
}

TEST(BladeAirloads, aDisplacedSectionSeesTheInflowWhereItIs) {
  // A section of a blade at psi, displaced by a quarter turn ahead, feels what a straight blade a quarter turn ahead feels.
  AirloadsRig bent(rotorOf(4), "    inflow_position: deformed\n"), straight(rotorOf(4), "");
  for (AirloadsRig* rig : {&bent, &straight}) {
    rig->turn(kOmega, 0.1);
    rig->port("inflow")[0] = 0.05;
    rig->port("inflow")[1] = 0.02;
    rig->port("inflow")[2] = -0.03;
    rig->port("hub_motion")[0] = 0.4;
  }
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 4; ++k) bent.set("section_position", j, k, {0.0, bent.sections.r[j], 0.1});
  const Vector loads = straight.output("section_loads");
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 4; ++k) {
      const Eigen::Vector4d expected = straight.loadOf(loads, j, (k + 1) % 4);
      EXPECT_LT((bent.load(j, k) - expected).norm(), 1e-13 * expected.norm());
    }
  const Vector a = bent.output("rotor_loads"), b = straight.output("rotor_loads");
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-16);  // the same forces at the same places
}

TEST(BladeAirloads, bitsDecideWhetherResultsAreStillValid) {
  // Kept results must not outlive the smallest change of an input or state.
  AirloadsRig rig(rotorOf(4), kLinear + "    unsteady: wagner\n");
  rig.randomize(2);
  const Vector before = rig.output("section_loads");
  for (double* value : {&rig.at("section_velocity", 0, 1, 3, 0), &rig.at("section_pitch", 2, 0, 1, 3), &rig.port("inflow")[0], &rig.port("hub_motion")[0], &rig.x[0]}) {
    const double old = *value;
    *value = old + 1e-9 * (1.0 + std::abs(old));
    const Vector changed = rig.output("section_loads");
    EXPECT_FALSE(changed == before);
    *value = old;
    EXPECT_TRUE(rig.output("section_loads") == before);
  }
}

}  // namespace
}  // namespace heerk_rotor
