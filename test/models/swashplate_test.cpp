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
  options.method = &tableau("HEERK4");
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

}  // namespace
}  // namespace heerk_rotor
