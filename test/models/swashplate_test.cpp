#include "heerk_rotor/models/swashplate.hpp"

#include <cmath>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kSpeed = 41.0, kFrequency = 40.0, kDamping = 0.8, kRateLimit = 0.7;

/// A hub that turns at constant speed.
class TurningHub : public SubsystemModel {
 public:
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override {
    return {{"hub_motion", 4, "rad, rad/s", "azimuth and speed, no twist", {}, 1.0, {"azimuth", "speed", "twist", "twist_rate"}}};
  }
  void evalOutput(Index, double t, const In&, const In&, Out y) noexcept override { y << kSpeed * t, kSpeed, 0.0, 0.0; }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
};

std::unique_ptr<Simulation> rig(double h, const Swashplate::Parameters& p = {}) {
  CouplingGraph graph;
  graph.add("hub", std::make_unique<TurningHub>());
  graph.add("swashplate", std::make_unique<Swashplate>(p));
  graph.connect("hub.hub_motion", "swashplate.hub_motion");
  StepOptions options;
  options.step = h;
  options.method = "HEERK4";
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

const std::vector<std::string> kPosition{"swashplate.collective", "swashplate.lateral_cyclic", "swashplate.longitudinal_cyclic"};

/// Unit step response of wn^2 / (s^2 + 2 zeta wn s + wn^2).
double stepResponse(double t) {
  const double decay = kDamping * kFrequency, wd = kFrequency * std::sqrt(1.0 - kDamping * kDamping);
  return 1.0 - std::exp(-decay * t) * (std::cos(wd * t) + decay / wd * std::sin(wd * t));
}

TEST(Swashplate, smallStepFollowsTheSecondOrderClosedForm) {
  auto simulation = rig(1e-3);
  Vector w = simulation->system().defaultCommand();
  const double step[3] = {1e-5, -2e-5, 3e-5};
  for (int i = 0; i < 3; ++i) w[i] = step[i];
  for (int k = 1; k <= 20; ++k) {
    ASSERT_TRUE(advance(*simulation, 10, w));
    const Vector position = look(*simulation, kPosition, w);
    for (int i = 0; i < 3; ++i) {
      // The smooth limit departs by (v / r)^2 / 3 < 6e-7 of the rate at v = 9e-4 rad/s; HEERK4 at wn h = 0.04 by less.
      EXPECT_NEAR(position[i], step[i] * stepResponse(0.01 * k), 2e-6 * std::abs(step[i])) << kPosition[static_cast<std::size_t>(i)];
    }
  }
}

TEST(Swashplate, largeStepIsLimitedInRateAndStillArrives) {
  auto simulation = rig(1e-3);
  Vector w = simulation->system().defaultCommand();
  w[0] = 0.3;
  double previous = 0.0, fastest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(advance(*simulation, 1, w));
    const double position = look(*simulation, kPosition, w)[0];
    fastest = std::max(fastest, std::abs(position - previous) / 1e-3);
    previous = position;
  }
  EXPECT_LE(fastest, kRateLimit);
  EXPECT_GE(fastest, 0.99 * kRateLimit) << "0.3 rad is far beyond what the limit lets pass at once";
  EXPECT_NEAR(previous, 0.3, 1e-6);  // e^-32 t is long gone after 2 s, whatever the limit cost
}

TEST(Swashplate, commandsBeyondTheTravelAreTakenAsItsEnds) {
  const Swashplate::Parameters p;
  auto simulation = rig(1e-3);
  Vector w = simulation->system().defaultCommand();
  w << 9.0, -9.0, 9.0;
  ASSERT_TRUE(advance(*simulation, 3000, w));
  const Vector high = look(*simulation, kPosition, w);
  EXPECT_NEAR(high[0], p.collective_max, 1e-6);
  EXPECT_NEAR(high[1], -p.cyclic_limit, 1e-6);
  EXPECT_NEAR(high[2], p.cyclic_limit, 1e-6);
  w << -9.0, 9.0, -9.0;
  ASSERT_TRUE(advance(*simulation, 3000, w));
  const Vector low = look(*simulation, kPosition, w);
  EXPECT_NEAR(low[0], p.collective_min, 1e-6);
  EXPECT_NEAR(low[1], p.cyclic_limit, 1e-6);
  EXPECT_NEAR(low[2], -p.cyclic_limit, 1e-6);
}

TEST(Swashplate, pitchFollowsTheCyclicConvention) {
  Swashplate::Parameters p;
  p.trim = {0.1, 0.02, -0.03};
  auto simulation = rig(1e-3, p);
  ASSERT_TRUE(advance(*simulation, 37));
  const Vector y = look(*simulation, {"swashplate.pitch_1", "swashplate.pitch_2", "swashplate.pitch_3", "swashplate.pitch_4"});
  for (int k = 0; k < 4; ++k) {
    const double psi = kSpeed * 0.037 + k * M_PI / 2.0;  // psi_k = psi + 2 pi (k-1) / 4
    EXPECT_NEAR(y[k], 0.1 + 0.02 * std::cos(psi) - 0.03 * std::sin(psi), 1e-14);
  }
}

TEST(Swashplate, pitchRateIsTheDerivativeOfPitchWhileThePlateMoves) {
  const double h = 1e-4;
  auto simulation = rig(h);
  std::vector<std::string> names;
  for (const char* what : {"pitch", "pitch_rate"})
    for (int k = 1; k <= 4; ++k) names.push_back(std::string("swashplate.") + what + "_" + std::to_string(k));
  Vector w = simulation->system().defaultCommand();
  w << 0.1, -0.08, 0.15;  // fast enough for the rate limit to work
  Recorder record(*simulation, names);
  ASSERT_TRUE(advance(*simulation, 1000, w));
  double worst = 0.0, largest = 0.0;
  for (std::size_t n = 2; n + 2 < record.rows.size(); ++n)
    for (Index k = 0; k < 4; ++k) {
      const auto pitch = [&](std::size_t m) { return record.rows[m][k]; };
      const double rate = (8.0 * (pitch(n + 1) - pitch(n - 1)) - (pitch(n + 2) - pitch(n - 2))) / (12.0 * h);
      worst = std::max(worst, std::abs(rate - record.rows[n][4 + k]));
      largest = std::max(largest, std::abs(rate));
    }
  EXPECT_GT(largest, 3.0);
  // Fourth-order differences; the limiter reaches saturation within r / (wn^2 0.15 rad) = 3 ms, so (h / 3 ms)^4 / 30 = 4e-8.
  EXPECT_LE(worst, 1e-7 * largest);
}

/// A hub whose speed varies, and blades that flap, both as given functions of time.
class UnsteadyRotor : public SubsystemModel {
 public:
  explicit UnsteadyRotor(int blades) : blades_(blades) {}
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override {
    return {{"hub_motion", 4, "rad, rad/s", "azimuth and speed, no twist"}, {"hub_acceleration", 2, "rad/s^2", "of hub and drive"},
            {"flap", blades_, "rad", "of each blade"}, {"flap_rate", blades_, "rad/s", "its rate"}, {"flap_acceleration", blades_, "rad/s^2", "its acceleration"}};
  }
  void evalOutput(Index port, double t, const In&, const In&, Out y) noexcept override {
    const double a = 0.3, n = 7.0;
    if (port == 0) y << kSpeed * t + a * std::sin(n * t), kSpeed + a * n * std::cos(n * t), 0.0, 0.0;
    else if (port == 1) y << -a * n * n * std::sin(n * t), 0.0;
    else
      for (int k = 0; k < blades_; ++k) {
        const double m = 40.0 + k, phase = m * t + k;
        y[k] = 0.05 * (port == 2 ? std::sin(phase) : port == 3 ? m * std::cos(phase) : -m * m * std::sin(phase));
      }
  }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  int blades_;
};

std::unique_ptr<Simulation> unsteadyRig(const Swashplate::Parameters& p, double h) {
  CouplingGraph graph;
  graph.add("rotor", std::make_unique<UnsteadyRotor>(p.blades));
  graph.add("swashplate", std::make_unique<Swashplate>(p));
  for (const char* port : {"hub_motion", "hub_acceleration"}) graph.connect(std::string("rotor.") + port, std::string("swashplate.") + port);
  if (p.delta3 != 0.0)
    for (const char* port : {"flap", "flap_rate", "flap_acceleration"}) graph.connect(std::string("rotor.") + port, std::string("swashplate.") + port);
  StepOptions options;
  options.step = h;
  options.method = "HEERK4";
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

std::vector<std::string> perBlade(const std::string& port, int blades) {
  std::vector<std::string> names;
  for (int k = 1; k <= blades; ++k) names.push_back("swashplate." + port + "_" + std::to_string(k));
  return names;
}

TEST(Swashplate, rateAndAccelerationAreTheDerivativesOfThePitchForAnyNumberOfBlades) {
  const double h = 1e-4;
  double worst = 0.0;
  for (int blades = 2; blades <= 8; ++blades) {
    Swashplate::Parameters p;
    p.blades = blades;
    p.phase = 0.2;
    p.delta3 = blades % 2 ? 0.4 : 0.0;
    auto simulation = unsteadyRig(p, h);
    const auto names = perBlade("pitch", blades) + perBlade("pitch_rate", blades) + perBlade("pitch_acceleration", blades);
    Vector w = simulation->system().defaultCommand();
    w << 0.1, -0.08, 0.15;  // fast enough for the rate limit to work
    Recorder record(*simulation, names);
    ASSERT_TRUE(advance(*simulation, 1500, w));
    for (Index order = 1; order <= 2; ++order)
      for (Index k = 0; k < blades; ++k) {
        double error = 0.0, largest = 0.0;
        for (std::size_t n = 3; n + 3 < record.rows.size(); ++n) {
          const auto before = [&](std::size_t m) { return record.rows[m][(order - 1) * blades + k]; };
          const double slope = (45.0 * (before(n + 1) - before(n - 1)) - 9.0 * (before(n + 2) - before(n - 2)) + (before(n + 3) - before(n - 3))) / (60.0 * h);
          error = std::max(error, std::abs(slope - record.rows[n][order * blades + k]));
          largest = std::max(largest, std::abs(slope));
        }
        // Differences of sixth order; the trajectory itself is of fourth, with the limiter's 3 ms: (h / 3 ms)^4 / 30 = 4e-8.
        EXPECT_LE(error, 1e-7 * largest) << blades << " blades, derivative " << order << ", blade " << k + 1;
        worst = std::max(worst, error / largest);
      }
  }
  report("pitch derivatives against differences, relative", worst);
}

TEST(Swashplate, bladesAreRelabelledByTurningTheHubOneBladeAngle) {
  // theta_k at psi + 2 pi / N is theta_{k+1} at psi: exact for N = 4, where the constants are, to round-off of psi otherwise.
  for (int blades = 2; blades <= 8; ++blades) {
    Swashplate::Parameters p;
    p.blades = blades;
    p.phase = -0.3;
    Swashplate plate(p);
    const Vector x = (Vector(6) << 0.1, 0.03, -0.05, 0.2, -0.3, 0.5).finished();
    Vector u = (Vector(9) << 0.2, 0.01, 0.02, 1.3, kSpeed, 0.0, 0.0, 5.0, 0.0).finished(), turned = u;
    turned[3] += 2.0 * M_PI / blades;
    for (Index port = 0; port < 3; ++port) {
      Vector y = Vector::Zero(blades), z = y;
      plate.evalOutput(port, 0.0, in(x), in(u), view(y));
      plate.evalOutput(port, 0.0, in(x), in(turned), view(z));
      for (Index k = 0; k < blades; ++k) EXPECT_NEAR(z[k], y[(k + 1) % blades], 4e-15 * y.cwiseAbs().maxCoeff()) << blades << ", port " << port;
    }
  }
}

TEST(Swashplate, flapUpLowersThePitchByTheTangentOfDelta3) {
  Swashplate::Parameters p;
  p.delta3 = 0.5;
  p.trim = {0.1, 0.0, 0.0};
  auto simulation = unsteadyRig(p, 1e-3);
  ASSERT_TRUE(advance(*simulation, 100));
  const Vector y = look(*simulation, perBlade("pitch", 4) + std::vector<std::string>{"rotor.flap_1", "rotor.flap_2", "rotor.flap_3", "rotor.flap_4"});
  for (Index k = 0; k < 4; ++k) EXPECT_NEAR(y[k], 0.1 - std::tan(0.5) * y[4 + k], 1e-15);
}

TEST(Swashplate, controlPhaseMovesTheLargestPitchAheadOfThePlate) {
  // With only theta_1c the pitch is largest where psi + Delta = 0: at psi = -Delta.
  Swashplate::Parameters p;
  p.phase = 0.25;
  Swashplate plate(p);
  const Vector x = (Vector(6) << 0.0, 0.1, 0.0, 0.0, 0.0, 0.0).finished(), u = (Vector(9) << 0, 0, 0, -0.25, kSpeed, 0, 0, 0, 0).finished();
  Vector y = Vector::Zero(4);
  plate.evalOutput(0, 0.0, in(x), in(u), view(y));
  EXPECT_EQ(y[0], 0.1);
  EXPECT_EQ(y[1], 0.0);  // exactly: no cos(pi / 2) of 6e-17
  EXPECT_EQ(y[2], -0.1);
}

TEST(BladeAzimuths, constantsAreExactToTheLastBitAndSymmetric) {
  for (int blades = 1; blades <= 8; ++blades) {
    const BladeAzimuths azimuths(blades);
    double cosine[8], sine[8];
    azimuths.evaluate(0.0, cosine, sine);
    for (int k = 0; k < blades; ++k) {
      const long double angle = 2.0L * 3.141592653589793238462643383279502884L * k / blades;
      EXPECT_NEAR(cosine[k], static_cast<double>(std::cos(angle)), 1.2e-16);  // one unit in the last place
      EXPECT_NEAR(sine[k], static_cast<double>(std::sin(angle)), 1.2e-16);
      if (k > 0) {
        EXPECT_EQ(cosine[k], cosine[blades - k]);
        EXPECT_EQ(sine[k], -sine[blades - k]);
      }
    }
  }
  EXPECT_THROW(BladeAzimuths(9), std::invalid_argument);
}

}  // namespace
}  // namespace heerk_rotor
