// Unsteady lift of one section through the model, against thin airfoil theory.
#include <complex>

#include <Eigen/Geometry>

#include "heerk_rotor/aero/unsteady_lift.hpp"
#include "models/blade_airloads_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Complex = std::complex<double>;

constexpr double kRho = 1.225, kSound = 340.3, kChord = 0.27, kSpeed = 60.0;
const std::string kThin = "    lift_slope: 6.283185307179586\n    drag: 0.0\n";

/// All sections in the same straight flow; the rotor stands still.
void straightFlow(AirloadsRig& rig, double speed, double pitch) {
  rig.level();
  for (Index j = 0; j < rig.sections.count(); ++j)
    for (Index k = 0; k < rig.blades(); ++k) {
      rig.at("section_velocity", j, 1, 3, k) = speed;
      rig.at("section_pitch", j, 0, 1, k) = pitch;
    }
}

Vector rates(AirloadsRig& rig, const Vector& x) {
  Vector xdot = Vector::Zero(x.size());
  rig.model->evalDerivatives(0.0, in(x), in(rig.u), view(xdot));
  return xdot;
}

void rungeKutta(AirloadsRig& rig, double h) {
  const Vector x = rig.x, k1 = rates(rig, x), k2 = rates(rig, x + 0.5 * h * k1), k3 = rates(rig, x + 0.5 * h * k2), k4 = rates(rig, x + h * k3);
  rig.x = x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

TEST(BladeAirloadsUnsteady, aStepInPitchIsAnsweredByWagnersFunction) {
  for (const int blades : {2, 4, 5}) {
    AirloadsRig rig(rotorOf(blades, 2), kThin + "    unsteady: wagner\n    kinematics: small_angle\n    compressible: false\n");
    ASSERT_EQ(rig.complaints, "");
    straightFlow(rig, kSpeed, 0.02);
    const double steady = 0.5 * kRho * kSpeed * kSpeed * kChord * rig.sections.width[0] * 2.0 * M_PI * 0.02;
    const double per_step = 0.05, h = per_step * kChord / (2.0 * kSpeed);
    // phi(0, 1, 5, 10, 20) of Jones' approximation to five digits, and its formula. RK4: (b h)^4 = 5e-8 per unit of s at b h = 0.015.
    const std::pair<int, double> printed[] = {{0, 0.5}, {1, 0.59417}, {5, 0.79383}, {10, 0.87864}, {20, 0.93275}};
    int step = 0;
    for (const auto& [s, phi] : printed) {
      for (; step < 20 * s; ++step) rungeKutta(rig, h);
      const Vector loads = rig.output("section_loads");
      EXPECT_NEAR(rig.loadOf(loads, 1, blades - 1)[2] / steady, phi, 6e-6) << s;
      EXPECT_NEAR(rig.loadOf(loads, 0, 0)[2] / steady, IndicialLag::jones().response(s), 1e-8) << s;
    }
  }
}

TEST(BladeAirloadsUnsteady, beddoesLagsByTheMachNumber) {
  AirloadsRig rig(rotorOf(4, 1), kThin + "    unsteady: beddoes\n    kinematics: small_angle\n");
  const double speed = 0.6 * kSound;
  straightFlow(rig, speed, 0.02);
  const double steady = 0.5 * kRho * speed * speed * kChord * rig.sections.width[0] * 2.0 * M_PI / 0.8 * 0.02;
  const IndicialLag lag = IndicialLag::beddoes(0.6);
  EXPECT_NEAR(rig.load(0, 0)[2], 0.0, 1e-12 * steady);
  for (int step = 1; step <= 200; ++step) {
    rungeKutta(rig, 0.05 * kChord / (2.0 * speed));
    if (step % 20 != 0) continue;
    EXPECT_NEAR(rig.load(0, 3)[2] / steady, lag.response(0.05 * step), 1e-7) << step;
  }
}

TEST(BladeAirloadsUnsteady, startsSteadyUnlessToldOtherwise) {
  for (const std::string kind : {"wagner", "beddoes"})
    for (const std::string kinematics : {"full", "small_angle"}) {
      const std::string keys = kThin + "    kinematics: " + kinematics + "\n    angle_of_attack_point: three_quarter_chord\n";
      AirloadsRig lagging(rotorOf(4), keys + "    unsteady: " + kind + "\n"), quasi_steady(rotorOf(4), keys);
      quasi_steady.randomize(4);
      lagging.u = quasi_steady.u;
      lagging.x.setZero();
      lagging.model->completeInitialState(in(lagging.u), view(lagging.x));
      const Vector expected = quasi_steady.output("section_loads");
      EXPECT_LT((lagging.output("section_loads") - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
      // z' = 2 U / c (w - b z): what is left is the round-off of its two terms, up to 2e3 1/s times 1e2 m/s.
      EXPECT_LT(rates(lagging, lagging.x).cwiseAbs().maxCoeff(), 1e-9);
      Vector given = Vector::Constant(lagging.x.size(), 0.5);
      lagging.model->completeInitialState(in(lagging.u), view(given));
      EXPECT_EQ(given, Vector::Constant(lagging.x.size(), 0.5));
    }
}

TEST(BladeAirloadsUnsteady, theLaggingFlowKeepsItsPartAlongTheChord) {
  // Full kinematics, zero states: half the downwash is effective at once (phi(0) = 1/2), so that the lift coefficient is that of
  // atan(tan(pitch) / 2); from behind just as from the front.
  for (const double speed : {kSpeed, -kSpeed}) {
    AirloadsRig rig(rotorOf(4), kThin + "    unsteady: wagner\n    compressible: false\n");
    straightFlow(rig, speed, 0.1);
    const double lift = 0.5 * kRho * kSpeed * kSpeed * kChord * rig.sections.width[0] * 2.0 * M_PI;
    EXPECT_NEAR(rig.load(0, 1)[2], std::copysign(lift * std::atan(0.5 * std::tan(0.1)), speed), 1e-12 * lift);
  }
}

/// Lift and nose-up moment about the axis per segment of a plate at rest-flow speed kSpeed that heaves (h up) or pitches harmonically, at
/// the instant `phase`, through the model with its lag states at their periodic values.
class Plate {
 public:
  Plate(double axis, double reduced_frequency)
      : rig_(rotorOf(4, 1), kThin + "    kinematics: small_angle\n    compressible: false\n    unsteady: wagner\n    virtual_mass: true\n"
                                    "    angle_of_attack_point: three_quarter_chord\n    elastic_axis: " + std::to_string(axis) + "\n"),
        omega_(reduced_frequency * kSpeed / kHalf) {}

  Eigen::Vector4d load(Complex heave, Complex pitch, double phase, double axis) {
    const Complex turn = std::polar(1.0, phase), i_omega(0.0, omega_);
    const double arm = (0.75 - axis) * kChord;
    straightFlow(rig_, kSpeed, std::real(pitch * turn));
    const Complex downwash = kSpeed * pitch - i_omega * heave + arm * i_omega * pitch;
    for (Index k = 0; k < 4; ++k) {
      rig_.at("section_velocity", 0, 2, 3, k) = std::real(i_omega * heave * turn);
      rig_.at("section_acceleration", 0, 2, 3, k) = std::real(i_omega * i_omega * heave * turn);
      rig_.at("section_pitch_rate", 0, 0, 1, k) = std::real(i_omega * pitch * turn);
      const IndicialLag lag = IndicialLag::jones();
      for (int i = 0; i < 2; ++i) {  // i omega z = U / b (w - b_i z)
        const double rate = kSpeed / kHalf;
        rig_.x[sectionEntry(0, i, 2, k, 4)] = std::real(downwash * rate / (i_omega + rate * lag.b[i]) * turn);
      }
    }
    return rig_.load(0, 2) / rig_.sections.width[0];
  }
  double omega() const { return omega_; }
  static constexpr double kHalf = 0.5 * kChord;  // b

 private:
  AirloadsRig rig_;
  double omega_;
};

TEST(BladeAirloadsUnsteady, aHeavingPlateHasTheodorsensLiftAndMoment) {
  // L = -pi rho b^2 h'' - 2 pi rho U b C(k) h',  about the quarter chord only the first part, at mid-chord: M = -b/2 of it. C of Jones' form.
  const double k = 0.3, b = Plate::kHalf;
  Plate plate(0.25, k);
  const Complex h = 1e-4, i_omega(0.0, plate.omega()), C = IndicialLag::jones().frequencyResponse(k);
  const Complex apparent = -M_PI * kRho * b * b * i_omega * i_omega * h, lift = apparent - 2.0 * M_PI * kRho * kSpeed * b * C * i_omega * h;
  for (const double phase : {0.0, 0.7, 1.9, 4.0}) {
    const Complex turn = std::polar(1.0, phase);
    const Eigen::Vector4d load = plate.load(h, 0.0, phase, 0.25);
    EXPECT_NEAR(load[2], std::real(lift * turn), 1e-10 * std::abs(lift));
    EXPECT_NEAR(load[3], std::real(-0.5 * b * apparent * turn), 1e-10 * b * std::abs(lift));
  }
}

TEST(BladeAirloadsUnsteady, aPlatePitchingAboutMidChordHasTheodorsensLiftAndMomentWithoutItsInertia) {
  // Axis at mid-chord, where theta'' makes no lift: L = pi rho b^2 U theta' + 2 pi rho U b C (U theta + b/2 theta'), and
  // M = b/2 (2 pi rho U b C (...)) - b/2 pi rho b^2 U theta'; the term -pi rho b^4 theta'' / 8 is not modelled.
  const double k = 0.3, b = Plate::kHalf;
  Plate plate(0.5, k);
  const Complex pitch = 1e-5, i_omega(0.0, plate.omega()), C = IndicialLag::jones().frequencyResponse(k);
  const Complex turning = M_PI * kRho * b * b * kSpeed * i_omega * pitch;
  const Complex circulatory = 2.0 * M_PI * kRho * kSpeed * b * C * (kSpeed + 0.5 * b * i_omega) * pitch;
  for (const double phase : {0.0, 0.7, 1.9, 4.0}) {
    const Complex turn = std::polar(1.0, phase);
    const Eigen::Vector4d load = plate.load(0.0, pitch, phase, 0.5);
    // Terms of second order in the pitch are 1e-5 smaller, and squared in the moment's cosine.
    EXPECT_NEAR(load[2], std::real((turning + circulatory) * turn), 1e-9 * std::abs(circulatory));
    EXPECT_NEAR(load[3], std::real(0.5 * b * (circulatory - turning) * turn), 1e-9 * b * std::abs(circulatory));
  }
}

TEST(BladeAirloadsUnsteady, steadyConingHasNoApparentMass) {
  // The centripetal acceleration has a part along the normal of a coned blade, but the flow across the section is steady: the turning
  // of the normal with the hub cancels it.
  AirloadsRig with(rotorOf(4), kThin + "    virtual_mass: true\n"), without(rotorOf(4), kThin);
  const double beta = 0.1;
  for (AirloadsRig* rig : {&with, &without}) {
    rig->turn(kOmega);
    for (Index j = 0; j < 3; ++j)
      for (Index k = 0; k < 4; ++k) {
        const double radius = rig->sections.r[j] * std::cos(beta);
        rig->set("section_velocity", j, k, {0.0, kOmega * radius, 0.0});
        rig->set("section_axes", j, k, {0, 1, 0, -std::sin(beta), 0, std::cos(beta)});
        if (rig == &with) rig->set("section_acceleration", j, k, {-kOmega * kOmega * radius, 0.0, 0.0});
      }
  }
  const Vector a = with.output("section_loads"), b = without.output("section_loads");
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 4; ++k) {
      const double r = with.sections.r[j], apparent = 0.25 * M_PI * kRho * kChord * kChord * with.sections.width[j] * kOmega * kOmega * r * beta;
      EXPECT_LT((with.loadOf(a, j, k) - without.loadOf(b, j, k)).head(3).norm(), 1e-12 * apparent);
    }
}

/// What a section does in any flight, as vectors in R_k.
struct Attitude {
  Attitude(AirloadsRig& rig, Index j, Index k) {
    for (Index c = 0; c < 3; ++c) {
      t[c] = rig.at("section_axes", j, c, 6, k);
      n[c] = rig.at("section_axes", j, 3 + c, 6, k);
      velocity[c] = rig.at("section_velocity", j, c, 3, k);
    }
    const double psi = rig.azimuth(k), *rates = rig.port("mount_velocity") + 3, *wind = rig.port("hub_wind"), *inflow = rig.port("inflow");
    Eigen::Matrix3d hub_to_blade;
    hub_to_blade << -std::cos(psi), -std::sin(psi), 0, std::sin(psi), -std::cos(psi), 0, 0, 0, 1;
    const double r = rig.sections.r[j] / rig.sections.radius;
    const double lambda = inflow[0] + r * (inflow[1] * std::sin(psi) + inflow[2] * std::cos(psi));
    through_air = velocity - hub_to_blade * Eigen::Vector3d(wind[0], wind[1], wind[2]) + lambda * kOmega * rig.sections.radius * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d turn = hub_to_blade * Eigen::Vector3d(rates[0], rates[1], rates[2] + rig.port("hub_motion")[1]);
    pitch = rig.at("section_pitch", j, 0, 1, k);
    pitch_rate = rig.at("section_pitch_rate", j, 0, 1, k) + turn.dot(t.cross(n));
  }
  Eigen::Vector3d t, n, velocity, through_air;
  double pitch, pitch_rate;  // relative to space, about the span
};

TEST(BladeAirloadsUnsteady, rateAboutTheSpanIncludesHubAndMountInAnyAttitude) {
  AirloadsRig rear(rotorOf(5), "    angle_of_attack_point: three_quarter_chord\n");
  rear.randomize(8);
  const Vector angles = rear.output("angle_of_attack");
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 5; ++k) {
      const Attitude at(rear, j, k);
      const double up = at.through_air.dot(at.n) - 0.5 * kChord * at.pitch_rate;
      EXPECT_NEAR(angles[sectionEntry(j, 0, 1, k, 5)], at.pitch - std::atan2(up, at.through_air.dot(at.t)), 1e-14);
    }
}

TEST(BladeAirloadsUnsteady, apparentMassActsAlongTheNormalOfThePitchedChord) {
  AirloadsRig with(rotorOf(3), kThin + "    virtual_mass: true\n"), without(rotorOf(3), kThin);
  with.randomize(6);
  for (const InputPort& port : without.inputs) std::copy_n(with.port(port.name), port.size, without.port(port.name));
  const Vector a = with.output("section_loads"), b = without.output("section_loads");
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < 3; ++k) {
      const Attitude at(with, j, k);
      for (Index c = 0; c < 3; ++c) with.at("section_acceleration", j, c, 3, k) = 300.0 * static_cast<double>(c + j - k) + 100.0;
      const Vector loads = with.output("section_loads");
      const Eigen::Vector3d normal = std::cos(at.pitch) * at.n - std::sin(at.pitch) * at.t, chord = -std::cos(at.pitch) * at.t - std::sin(at.pitch) * at.n;
      const Eigen::Vector3d acceleration(with.at("section_acceleration", j, 0, 3, k), with.at("section_acceleration", j, 1, 3, k), with.at("section_acceleration", j, 2, 3, k));
      const double mass = 0.25 * M_PI * kRho * kChord * kChord * with.sections.width[j];
      const double inertial = -mass * acceleration.dot(normal), turning = mass * -at.through_air.dot(chord) * at.pitch_rate;
      const Eigen::Vector4d added = with.loadOf(loads, j, k) - without.loadOf(b, j, k);
      // Differences of loads some times larger.
      const double scale = 1e-12 * with.loadOf(a, j, k).norm();
      EXPECT_LT((added.head(3) - (inertial + turning) * normal).norm(), scale + 1e-12 * mass * acceleration.norm());
      EXPECT_NEAR(added[3], -kChord * (0.25 * inertial + 0.5 * turning), scale + 1e-12 * mass * acceleration.norm());
    }
}

TEST(BladeAirloadsUnsteady, atThreeQuartersOfTheChordTheNoseUpRateAddsToTheAngle) {
  AirloadsRig rear(rotorOf(4), kThin + "    kinematics: small_angle\n    angle_of_attack_point: three_quarter_chord\n"), front(rotorOf(4), kThin + "    kinematics: small_angle\n");
  EXPECT_TRUE(rear.has("section_pitch_rate"));
  EXPECT_FALSE(front.has("section_pitch_rate"));
  EXPECT_FALSE(rear.has("section_acceleration"));
  straightFlow(rear, kSpeed, 0.02);
  straightFlow(front, kSpeed, 0.02);
  rear.at("section_pitch_rate", 1, 0, 1, 3) = 2.0;
  const double added = 2.0 * 0.5 * kChord / kSpeed;
  const Index entry = sectionEntry(1, 0, 1, 3, 4);
  EXPECT_NEAR(rear.output("angle_of_attack")[entry], front.output("angle_of_attack")[entry] + added, 1e-15);
  // A rolling mount turns the blade at psi = 90 deg, which points to the right (-y), about its span: roll = +x rates turn blades fore and
  // aft, pitch = +y (nose down of the fuselage) turns the right blade's nose down.
  rear.at("section_pitch_rate", 1, 0, 1, 3) = 0.0;
  rear.port("hub_motion")[0] = 0.5 * M_PI;
  rear.port("mount_velocity")[4] = 2.0;
  EXPECT_NEAR(rear.output("angle_of_attack")[sectionEntry(1, 0, 1, 0, 4)], 0.02 - added, 1e-15);
  EXPECT_NEAR(rear.output("angle_of_attack")[sectionEntry(1, 0, 1, 2, 4)], 0.02 + added, 1e-15);
  EXPECT_NEAR(rear.output("angle_of_attack")[sectionEntry(1, 0, 1, 1, 4)], 0.02, 1e-15);
}

}  // namespace
}  // namespace heerk_rotor
