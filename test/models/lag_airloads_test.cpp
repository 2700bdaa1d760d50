// Airloads of the lag rotor against closed forms and an independent evaluation of their definition.
#include "heerk_rotor/models/lag_airloads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace heerk_rotor {
namespace {

enum Port { kBladeLoad, kThrustLoad, kThrustCoefficient, kTorqueCoefficient, kPowerCoefficient, kAdvanceRatio, kInflow };
constexpr double kTwoPi = 2.0 * M_PI;

/// Hub, controls and flight state of one evaluation.
struct Flight {
  double azimuth = 0.0, speed = 41.0;
  double collective = 0.17, lateral = 0.0, longitudinal = 0.0;  // theta_0, theta_1c, theta_1s
  double lag_rate[4] = {};
  double velocity_x = 0.0, velocity_y = 0.0;

  double psi(int blade) const { return azimuth + blade * M_PI / 2.0; }
  double pitch(int blade) const { return collective + lateral * std::cos(psi(blade)) + longitudinal * std::sin(psi(blade)); }
  Vector input() const {
    Vector u = Vector::Zero(15);
    u[0] = azimuth;
    u[1] = speed;
    for (int i = 0; i < 4; ++i) {
      u[4 + i] = pitch(i);
      u[8 + i] = lag_rate[i];
    }
    u[12] = velocity_x;
    u[13] = velocity_y;
    return u;
  }
};

class Airloads {
 public:
  explicit Airloads(const LagAirloads::Parameters& p) : model_(p) {}
  Vector operator()(Port port, const Flight& flight) {
    const Vector u = flight.input(), x(0);
    Vector y = Vector::Zero(model_.outputs()[port].size);
    model_.evalOutput(port, 0.0, view(x), view(u), view(y));
    return y;
  }
  double number(Port port, const Flight& flight) { return (*this)(port, flight)[0]; }

 private:
  LagAirloads model_;
};

LagAirloads::Parameters fullBlade() {
  LagAirloads::Parameters p;
  p.root_cutout = 0.0;
  return p;
}

double solidity(const LagAirloads::Parameters& p) { return 4.0 * p.chord / (M_PI * p.radius); }

TEST(LagAirloads, hoverThrustAndInflowAreTheClosedForm) {
  const LagAirloads::Parameters p = fullBlade();
  Airloads airloads(p);
  const double sigma = solidity(p);
  for (const double collective : {0.05, 0.12, 0.17, 0.25}) {
    Flight hover;
    hover.collective = collective;
    // CT = sigma a / 2 (theta_75 / 3 - lambda / 2) and lambda = sqrt(CT / 2): a quadratic in lambda. Linear twist leaves the
    // thrust unchanged when the collective is quoted at 0.75 R.
    const double k = sigma * p.lift_slope / 16.0;
    const double lambda = k * (std::sqrt(1.0 + 64.0 * collective / (3.0 * sigma * p.lift_slope)) - 1.0);
    const double ct = 0.5 * sigma * p.lift_slope * (collective / 3.0 - 0.5 * lambda);
    ASSERT_NEAR(lambda, std::sqrt(0.5 * ct), 1e-14);
    // Gauss quadrature is exact for these polynomials: round-off only.
    EXPECT_NEAR(airloads.number(kThrustCoefficient, hover), ct, 1e-13);
    EXPECT_NEAR(airloads.number(kInflow, hover), lambda, 1e-13);
    // Momentum theory: CQ = lambda CT + sigma cd0 / 8, whatever the twist.
    EXPECT_NEAR(airloads.number(kTorqueCoefficient, hover), lambda * ct + sigma * p.profile_drag / 8.0, 1e-13);
    EXPECT_NEAR(airloads.number(kPowerCoefficient, hover), airloads.number(kTorqueCoefficient, hover), 1e-15);  // at nominal speed
    EXPECT_EQ(airloads.number(kAdvanceRatio, hover), 0.0);
  }
}

TEST(LagAirloads, hoverThrustWithCutOutIsTheIntegralOfTheSections) {
  LagAirloads::Parameters p;
  p.twist = -0.2;
  Airloads airloads(p);
  Flight hover;
  const double lambda = airloads.number(kInflow, hover), x0 = p.root_cutout / p.radius;
  const auto power = [&](int n) { return (1.0 - std::pow(x0, n)) / n; };  // integral of x^(n-1) from the cut-out to 1
  const double ct = 0.5 * solidity(p) * p.lift_slope * (hover.collective * power(3) + p.twist * (power(4) - 0.75 * power(3)) - lambda * power(2));
  EXPECT_NEAR(airloads.number(kThrustCoefficient, hover), ct, 1e-13);
  EXPECT_NEAR(lambda, std::sqrt(0.5 * ct), 1e-13);
  const double cq = 0.5 * solidity(p) * (p.lift_slope * lambda * (hover.collective * power(3) + p.twist * (power(4) - 0.75 * power(3)) - lambda * power(2)) + p.profile_drag * power(4));
  EXPECT_NEAR(airloads.number(kTorqueCoefficient, hover), cq, 1e-13);
}

TEST(LagAirloads, thrustOfANegativeCollectiveIsTheMirrorImage) {
  LagAirloads::Parameters p = fullBlade();
  p.twist = 0.0;
  Airloads airloads(p);
  Flight up, down;
  down.collective = -up.collective;
  EXPECT_NEAR(airloads.number(kThrustCoefficient, down), -airloads.number(kThrustCoefficient, up), 1e-15);
  EXPECT_NEAR(airloads.number(kInflow, down), -airloads.number(kInflow, up), 1e-15);
  EXPECT_NEAR(airloads.number(kTorqueCoefficient, down), airloads.number(kTorqueCoefficient, up), 1e-15);
  Flight flat;
  flat.collective = 0.0;
  EXPECT_EQ(airloads.number(kInflow, flat), 0.0);
}

/// Loads of every blade by their definition, integrated with Simpson's rule on 4000 intervals, with the induced velocity
/// found by bisection of T = 2 rho A v sqrt(V^2 + v^2): nothing in common with the model but the definition.
struct Definition {
  double force[4], moment[4], thrust = 0.0, roll = 0.0, pitch = 0.0, induced = 0.0;

  Definition(const LagAirloads::Parameters& p, const Flight& f) {
    const auto tangential = [&](int i, double r) {
      return f.speed * r + f.lag_rate[i] * (r - p.hinge_offset) + f.velocity_x * std::sin(f.psi(i)) - f.velocity_y * std::cos(f.psi(i));
    };
    const auto theta = [&](int i, double r) { return f.pitch(i) + p.twist * (r / p.radius - 0.75); };
    const auto lift = [&](int i, double r, double v) {
      const double ut = tangential(i, r);
      return 0.5 * p.air_density * p.chord * p.lift_slope * std::abs(ut) * (theta(i, r) * ut - v);
    };
    const auto drag = [&](int i, double r, double v) {
      const double ut = tangential(i, r);
      return lift(i, r, v) * v / ut + 0.5 * p.air_density * p.chord * p.profile_drag * std::abs(ut) * ut;
    };
    const auto integral = [&](const std::function<double(double)>& g) {
      constexpr int n = 4000;
      const double h = (p.radius - p.root_cutout) / n;
      double sum = g(p.root_cutout) + g(p.radius);
      for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * g(p.root_cutout + k * h);
      return sum * h / 3.0;
    };
    // T(v) falls linearly, the momentum flux rises: one root.
    double lift0 = 0.0, lift1 = 0.0;
    for (int i = 0; i < 4; ++i) {
      lift0 += integral([&](double r) { return lift(i, r, 0.0); });
      lift1 += integral([&](double r) { return lift(i, r, 1.0); });
    }
    const double v2 = f.velocity_x * f.velocity_x + f.velocity_y * f.velocity_y, disc = 2.0 * p.air_density * M_PI * p.radius * p.radius;
    double low = -200.0, high = 200.0;
    for (int k = 0; k < 200; ++k) {
      const double v = 0.5 * (low + high);
      (disc * v * std::sqrt(v2 + v * v) > lift0 + (lift1 - lift0) * v ? high : low) = v;
    }
    induced = 0.5 * (low + high);
    for (int i = 0; i < 4; ++i) {
      force[i] = -integral([&](double r) { return drag(i, r, induced); });
      moment[i] = -integral([&](double r) { return (r - p.hinge_offset) * drag(i, r, induced); });
      const double t = integral([&](double r) { return lift(i, r, induced); }), arm = integral([&](double r) { return r * lift(i, r, induced); });
      thrust += t;
      // (r e_r) x (dT e_z), e_r = (-cos psi, -sin psi, 0) in hub_link
      roll += -std::sin(f.psi(i)) * arm;
      pitch += std::cos(f.psi(i)) * arm;
    }
  }
};

TEST(LagAirloads, equalTheirDefinitionInGeneralFlight) {
  LagAirloads::Parameters p;
  Airloads airloads(p);
  Flight flights[4];
  flights[1].lateral = 0.03;
  flights[1].longitudinal = -0.05;
  flights[1].azimuth = 0.7;
  flights[2] = flights[1];
  flights[2].velocity_x = 12.0;  // not fast enough for reverse flow outside the cut-out: integrands stay smooth
  flights[2].velocity_y = -4.0;
  for (int i = 0; i < 4; ++i) flights[2].lag_rate[i] = 0.3 * (i - 1.3);
  flights[3] = flights[2];
  flights[3].collective = -0.04;
  flights[3].azimuth = 4.1;
  flights[3].speed = 36.0;
  for (const Flight& f : flights) {
    const Definition expected(p, f);
    const Vector load = airloads(kBladeLoad, f), hub = airloads(kThrustLoad, f);
    for (int i = 0; i < 4; ++i) {
      // Bisection and Simpson are good to 1e-13 relative of loads of 1e4; five Gauss points are exact.
      EXPECT_NEAR(load[i], expected.force[i], 1e-8) << i;
      EXPECT_NEAR(load[4 + i], expected.moment[i], 1e-8) << i;
    }
    EXPECT_NEAR(hub[0], expected.thrust, 1e-7);
    EXPECT_NEAR(hub[1], expected.roll, 1e-7);
    EXPECT_NEAR(hub[2], expected.pitch, 1e-7);
    EXPECT_NEAR(airloads.number(kInflow, f), expected.induced / (p.rotor_speed * p.radius), 1e-12);
    double torque = 0.0;
    for (int i = 0; i < 4; ++i) torque -= expected.moment[i] + p.hinge_offset * expected.force[i];
    const double area = M_PI * p.radius * p.radius, tip = p.rotor_speed * p.radius;
    EXPECT_NEAR(airloads.number(kTorqueCoefficient, f), torque / (p.air_density * area * tip * tip * p.radius), 1e-12);
    EXPECT_NEAR(airloads.number(kPowerCoefficient, f), torque * f.speed / (p.air_density * area * tip * tip * tip), 1e-12);
    EXPECT_NEAR(airloads.number(kAdvanceRatio, f), std::hypot(f.velocity_x, f.velocity_y) / tip, 1e-15);
  }
}

TEST(LagAirloads, inducedVelocityIsTheGlauertRootAtAllSpeeds) {
  LagAirloads::Parameters p;
  Airloads airloads(p);
  double previous = 1.0;
  for (const double v : {0.0, 1e-6, 0.01, 0.3, 2.0, 10.0, 20.0}) {
    Flight f;
    f.velocity_x = v;
    const double tip = p.rotor_speed * p.radius, ct = airloads.number(kThrustCoefficient, f), lambda = airloads.number(kInflow, f), mu = v / tip;
    EXPECT_NEAR(lambda, 0.5 * ct / std::hypot(mu, lambda), 1e-14) << v;
    EXPECT_LE(lambda, previous) << "induced velocity falls with speed";
    previous = lambda;
    // lambda^2 = (-mu^2 + sqrt(mu^4 + CT^2)) / 2, disc edgewise (aeromechanics, section 3); that form cancels at high mu.
    EXPECT_NEAR(lambda * lambda, 0.5 * (-mu * mu + std::sqrt(mu * mu * mu * mu + ct * ct)), 1e-14) << v;
  }
}

/// Average over one revolution.
double mean(const std::function<double(double)>& g) {
  double sum = 0.0;
  for (int k = 0; k < 360; ++k) sum += g(kTwoPi * k / 360.0) / 360.0;
  return sum;
}

TEST(LagAirloads, cyclicPitchInHoverGivesTheClosedFormHubMoments) {
  const LagAirloads::Parameters p = fullBlade();
  Airloads airloads(p);
  const double tip = p.rotor_speed * p.radius, area = M_PI * p.radius * p.radius, unit = p.air_density * area * tip * tip * p.radius;
  for (const auto& [lateral, longitudinal] : {std::pair<double, double>{0.04, 0.0}, {0.0, 0.04}, {-0.02, 0.03}}) {
    const double theta_c = lateral, theta_s = longitudinal;
    const auto moment = [&](int axis) {
      return mean([&](double psi) {
        Flight f;
        f.azimuth = psi;
        f.lateral = theta_c;
        f.longitudinal = theta_s;
        return airloads(kThrustLoad, f)[axis];
      }) / unit;
    };
    // Lift per radius sigma a / 2 x^2 theta(psi): the integral of x^3 is 1/4, the mean of sin^2 is 1/2, so roll is
    // -sigma a / 16 theta_1s (more pitch to starboard rolls to port) and pitch is +sigma a / 16 theta_1c.
    EXPECT_NEAR(moment(1), -solidity(p) * p.lift_slope / 16.0 * theta_s, 1e-13);
    EXPECT_NEAR(moment(2), solidity(p) * p.lift_slope / 16.0 * theta_c, 1e-13);
  }
}

TEST(LagAirloads, cyclicPitchMakesAnInPlaneForceFromTheInflow) {
  // In hover dF = -rho/2 c a0 (theta U_T v - v^2) dr - profile drag: only the 1/rev part of theta survives the mean of
  // sum F_i e_t,i, four blades times one half (mean of sin^2), times the integral of omega r.
  const LagAirloads::Parameters p = fullBlade();
  Airloads airloads(p);
  for (const auto& [lateral, longitudinal] : {std::pair<double, double>{0.04, 0.0}, {0.0, 0.04}}) {
    const double theta_c = lateral, theta_s = longitudinal;
    double x = 0.0, y = 0.0, v = 0.0;
    for (int k = 0; k < 360; ++k) {
      Flight f;
      f.azimuth = kTwoPi * k / 360.0;
      f.lateral = theta_c;
      f.longitudinal = theta_s;
      const Vector load = airloads(kBladeLoad, f);
      for (int i = 0; i < 4; ++i) {
        x += load[i] * std::sin(f.psi(i)) / 360.0;  // e_t = (sin psi, -cos psi) in hub_link
        y -= load[i] * std::cos(f.psi(i)) / 360.0;
      }
      v = airloads.number(kInflow, f) * p.rotor_speed * p.radius;
    }
    const double scale = 0.5 * p.air_density * p.chord * p.lift_slope * v * p.rotor_speed * 0.5 * p.radius * p.radius;  // per rad of pitch
    EXPECT_NEAR(x, -2.0 * scale * theta_s, 1e-9 * scale);
    EXPECT_NEAR(y, 2.0 * scale * theta_c, 1e-9 * scale);
  }
}

TEST(LagAirloads, signsFollowTheConventions) {
  Airloads airloads((LagAirloads::Parameters()));
  const Flight hover;
  const Vector load = airloads(kBladeLoad, hover);
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT(load[i], 0.0) << "drag pulls the blade towards lag";
    EXPECT_LT(load[4 + i], 0.0);
  }
  EXPECT_GT(airloads(kThrustLoad, hover)[0], 0.0);

  // Blade 2 advances (psi = 90 deg is starboard) when the hub moves forward: more thrust there, so the left side is heavy:
  // a rolling moment to the left, negative about x forward.
  Flight forward;
  forward.velocity_x = 10.0;
  EXPECT_LT(airloads(kThrustLoad, forward)[1], 0.0);
  EXPECT_GT(airloads(kThrustLoad, forward)[0], airloads(kThrustLoad, hover)[0]);
  EXPECT_LT(airloads(kBladeLoad, forward)[1], airloads(kBladeLoad, forward)[3]) << "the advancing blade drags more";

  // More pitch aft (theta_1c > 0) lifts the tail: nose down, positive about y to port.
  Flight lateral;
  lateral.lateral = 0.03;
  EXPECT_GT(airloads(kThrustLoad, lateral)[2], 0.0);

  // A blade that leads faster sees more wind and drags more: aerodynamic lag damping.
  Flight leading;
  leading.lag_rate[0] = 0.5;
  EXPECT_LT(airloads(kBladeLoad, leading)[4], load[4]);
}

TEST(LagAirloads, reverseFlowDragsTheOtherWay) {
  LagAirloads::Parameters p;
  p.profile_drag = 0.05;
  Airloads airloads(p);
  Flight f;
  f.collective = 0.0;
  f.velocity_x = 300.0;  // beyond the tip speed of 205 m/s: blade 4, retreating, is blown from behind all along
  const Vector load = airloads(kBladeLoad, f);
  EXPECT_LT(load[1], 0.0);
  EXPECT_GT(load[3], 0.0);
}

}  // namespace
}  // namespace heerk_rotor
