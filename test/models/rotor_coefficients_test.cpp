#include "heerk_rotor/models/rotor_coefficients.hpp"

#include <cmath>
#include <map>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kDegree = M_PI / 180.0, kRadius = 5.0, kOmega = 40.0, kDensity = 1.2;

/// The model with named inputs and outputs.
class Coefficients {
 public:
  explicit Coefficients(int blades) : model_({blades, kRadius, kOmega, kDensity, 0.3}) {
    Index begin = 0;
    for (const InputPort& port : model_.inputs()) {
      begin_[port.name] = begin;
      begin += port.size;
    }
    u_ = Vector::Zero(begin);
    (*this)("hub_motion", 1) = kOmega;
  }
  double& operator()(const std::string& input, Index entry = 0) { return u_[begin_.at(input) + entry]; }
  Vector get(const std::string& output) {
    const auto ports = model_.outputs();
    for (std::size_t p = 0; p < ports.size(); ++p)
      if (ports[p].name == output) {
        Vector y = Vector::Zero(ports[p].size);
        model_.evalOutput(static_cast<Index>(p), 0.0, in(Vector()), in(u_), view(y));
        return y;
      }
    throw std::out_of_range(output);
  }

 private:
  RotorCoefficients model_;
  std::map<std::string, Index> begin_;
  Vector u_;
};

TEST(RotorCoefficients, loadsHaveTheSignsAndMagnitudesOfTheUsConvention) {
  // rho A (Omega R)^2 = 1.2 * 78.53981634 * 200^2 = 3769911.184 N.
  Coefficients c(4);
  c("rotor_force", 0) = -700.0;  // pulls aft
  c("rotor_force", 1) = -300.0;  // pulls right
  c("rotor_force", 2) = 20000.0;
  c("tilting_moment", 0) = 1500.0;
  c("tilting_moment", 1) = -900.0;
  c("blade_reaction") = -8000.0;  // drag brakes the hub
  const double force = 3769911.184, digits = 1e-9;  // ten digits of the reference
  EXPECT_NEAR(c.get("thrust_coefficient")[0], 20000.0 / force, digits);
  EXPECT_NEAR(c.get("torque_coefficient")[0], 8000.0 / (force * 5.0), digits);
  EXPECT_NEAR(c.get("in_plane_force_coefficients")[0], 700.0 / force, digits);
  EXPECT_NEAR(c.get("in_plane_force_coefficients")[1], 300.0 / force, digits);
  EXPECT_NEAR(c.get("hub_moment_coefficients")[0], 1500.0 / (force * 5.0), digits);
  EXPECT_NEAR(c.get("hub_moment_coefficients")[1], -900.0 / (force * 5.0), digits);
  EXPECT_NEAR(c.get("blade_loading")[0], 20000.0 / force / (4 * 0.3 / (M_PI * 5.0)), 1e-8);
  EXPECT_NEAR(c.get("thrust_coefficient")[0], 0.00530516, 1e-8);
}

TEST(RotorCoefficients, torqueAndPowerCoefficientAreEqualAtNominalSpeedOnly) {
  Coefficients c(4);
  c("blade_reaction") = -8000.0;
  EXPECT_DOUBLE_EQ(c.get("power_coefficient")[0], c.get("torque_coefficient")[0]);
  c("hub_motion", 1) = 0.9 * kOmega;
  EXPECT_DOUBLE_EQ(c.get("power_coefficient")[0], 0.9 * c.get("torque_coefficient")[0]);
  // In watts: Q times the speed of the hub over rho A (Omega R)^3.
  EXPECT_NEAR(c.get("power_coefficient")[0], 8000.0 * 36.0 / (kDensity * M_PI * 25.0 * 200.0 * 200.0 * 200.0), 1e-18);
}

TEST(RotorCoefficients, figureOfMeritIsIdealOverActualPower) {
  Coefficients c(4);
  c("rotor_force", 2) = 20000.0;
  c("blade_reaction") = -8000.0;
  c("hub_motion", 1) = 42.0;
  // T sqrt(T / (2 rho A)) over Q Omega_hub, in watts.
  const double ideal = 20000.0 * std::sqrt(20000.0 / (2.0 * kDensity * M_PI * 25.0));
  EXPECT_NEAR(c.get("figure_of_merit")[0], ideal / (8000.0 * 42.0), 1e-14);
  c("blade_reaction") = 8000.0;
  EXPECT_EQ(c.get("figure_of_merit")[0], 0.0) << "windmill";
  c("blade_reaction") = -8000.0;
  c("rotor_force", 2) = -20000.0;
  EXPECT_EQ(c.get("figure_of_merit")[0], 0.0) << "thrust down";
}

TEST(RotorCoefficients, staysFiniteAtStandstillInStillAir) {
  for (int blades = 2; blades <= 8; ++blades) {
    Coefficients c(blades);
    c("hub_motion", 1) = 0.0;
    for (const OutputPort& port : RotorCoefficients({blades, kRadius, kOmega, kDensity, 0.3}).outputs()) EXPECT_TRUE(c.get(port.name).allFinite()) << port.name;
  }
}

TEST(RotorCoefficients, flowAndAnglesOfATunnelWithTheShaftTiltedAft) {
  Coefficients c(4);
  const double alpha = 5.0 * kDegree;  // aft: air from below, mu_z = -V sin alpha / (Omega R)
  c("hub_flow", 0) = 0.2 * std::cos(alpha);
  c("hub_flow", 2) = -0.2 * std::sin(alpha);
  c("inflow", 0) = 0.03;
  EXPECT_NEAR(c.get("advance_ratio")[0], 0.2 * std::cos(alpha), 1e-16);
  EXPECT_NEAR(c.get("axial_advance_ratio")[0], -0.2 * std::sin(alpha), 1e-16);
  EXPECT_NEAR(c.get("inflow_ratio")[0], 0.03 - 0.2 * std::sin(alpha), 1e-16);
  EXPECT_NEAR(c.get("shaft_angle")[0], alpha, 1e-15);
  EXPECT_NEAR(c.get("tip_path_plane_angle")[0], alpha, 1e-15);
}

/// Blade angles b0 + bc cos psi_k + bs sin psi_k + bd (-1)^(k-1).
void plant(Coefficients& c, const std::string& port, int blades, double psi, double b0, double bc, double bs, double bd) {
  c("hub_motion", 0) = psi;
  for (int k = 0; k < blades; ++k) {
    const double psi_k = psi + 2.0 * M_PI * k / blades;
    c(port, k) = b0 + bc * std::cos(psi_k) + bs * std::sin(psi_k) + (k % 2 == 0 ? bd : -bd);
  }
}

TEST(RotorCoefficients, tippingTheDiscIntoTheDirectionOfFlightLowersItsAngleOfAttack) {
  Coefficients c(4);
  const double tilt = 3.0 * kDegree;
  c("hub_flow", 0) = 0.2;  // forward: beta_1c > 0, aft side up
  plant(c, "flap", 4, 0.7, 0.05, tilt, 0.01, 0.0);
  EXPECT_NEAR(c.get("tip_path_plane_angle")[0], -tilt, 1e-15);
  c("hub_flow", 0) = 0.0;  // to the left: beta_1s > 0, right side up
  c("hub_flow", 1) = 0.2;
  plant(c, "flap", 4, 0.7, 0.05, 0.01, tilt, 0.0);
  EXPECT_NEAR(c.get("tip_path_plane_angle")[0], -tilt, 1e-15);
  c("hub_flow", 1) = -0.2;  // to the right the same disc meets the air from below
  EXPECT_NEAR(c.get("tip_path_plane_angle")[0], tilt, 1e-15);
}

TEST(RotorCoefficients, multibladeCoordinatesOfThreeToEightBladesAreTheirAmplitudes) {
  for (int blades = 3; blades <= 8; ++blades)
    for (const char* angle : {"flap", "lag"}) {
      Coefficients c(blades);
      const double bd = blades % 2 == 0 ? 0.007 : 0.0;
      plant(c, angle, blades, 1.9, 0.05, -0.02, 0.03, bd);
      const Vector y = c.get(std::string(angle) + "_coordinates");
      ASSERT_EQ(y.size(), blades % 2 == 0 ? 4 : 3);
      EXPECT_NEAR(y[0], 0.05, 1e-16);
      EXPECT_NEAR(y[1], -0.02, 1e-16);
      EXPECT_NEAR(y[2], 0.03, 1e-16);
      for (Index i = 3; i < y.size(); ++i) EXPECT_NEAR(y[i], bd, 1e-16);
    }
}

TEST(RotorCoefficients, twoBladesHaveADifferentialCoordinateAndTheirTiltInTheMean) {
  Coefficients c(2);
  Vector mean = Vector::Zero(4);
  const int steps = 36;
  for (int i = 0; i < steps; ++i) {
    const double psi = 2.0 * M_PI * i / steps;
    plant(c, "flap", 2, psi, 0.05, 0.02, -0.01, 0.0);
    const Vector y = c.get("flap_coordinates");
    mean += y / steps;
    EXPECT_NEAR(y[0], 0.05, 1e-16);
    EXPECT_NEAR(y[3], 0.02 * std::cos(psi) - 0.01 * std::sin(psi), 1e-15);
  }
  // (2/N) sum beta cos = 2 (bc cos + bs sin) cos = bc + 2/rev.
  EXPECT_NEAR(mean[1], 0.02, 1e-15);
  EXPECT_NEAR(mean[2], -0.01, 1e-15);
}

}  // namespace
}  // namespace heerk_rotor
