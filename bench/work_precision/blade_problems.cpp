// Problems with elastic blades. They start smoothly, as a helicopter does: the rotor rests in hover, then collective and cyclic pitch move along a
// polynomial in time, and the comparison begins while blades, inflow and actuators still follow. A load that begins at once would let modes
// ring that no method resolves at a practical step, and every method would show the same large error.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/models/fe_rotor.hpp"
#include "heerk_rotor/models/static_inflow.hpp"
#include "heerk_rotor/models/swashplate.hpp"
#include "problem.hpp"
#include "smooth_airloads.hpp"

namespace heerk_rotor::work_precision {
namespace {

const char* const kFile = "/config/bo105.yaml";
constexpr double kRotorSpeed = 44.40;                        // Omega [rad/s], of that file
constexpr double kRevolution = 2.0 * M_PI / kRotorSpeed;     // [s]
constexpr double kHover[3] = {0.12, 0.0, 0.0};               // collective, lateral and longitudinal cyclic [rad]
constexpr double kManoeuvre[3] = {0.14, 0.02, -0.03};
constexpr double kMeanInflow = 0.05;                         // over Omega R: that of hover, prescribed on the hub that does not move
// Structural damping alpha while the rotor comes to rest [1/s]: torsion alone would need 400 revolutions. Hover is a state of rest in blade axes,
// so the equilibrium does not depend on it.
const char* const kStrongDamping = "subsystems.rotor.damping_mass=60.0";
constexpr int kRestRevolutions = 60, kRestSteps = 360;       // steps per revolution
constexpr int kRampRevolutions = 2, kRampSteps = 4000;

/// A hub that turns with constant speed and does nothing else.
class TurningHub final : public SubsystemModel {
 public:
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override {
    return {{"hub_motion", 4, "rad, rad/s", "azimuth and speed of the hub, twist (none) and its rate", {}, kRotorSpeed, {"azimuth", "speed", "twist", "twist_rate"}}};
  }
  void evalOutput(Index, double t, const In&, const In&, Out y) noexcept override { y << kRotorSpeed * t, kRotorSpeed, 0.0, 0.0; }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
};

/// Rotor and airloads of the configuration with another number of blades, which the configuration itself does not let go below two.
CoupledSystem buildBladesOnHub(int blades, const Problem::Overrides& more) {
  Problem::Overrides overrides{"subsystems.rotor.modes=0"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const Configuration configuration = Configuration::load(std::string(HEERK_SOURCE_DIR) + kFile, overrides);
  Problems problems;
  Section rotor(configuration, "subsystems.rotor", problems);
  rotor.word("type", "");
  FeRotorParameters p = readFeRotorParameters(rotor, kRotorSpeed);
  if (!problems.empty()) throw ConfigurationError(problems);
  p.sections.blades = blades;
  p.blades.resize(static_cast<std::size_t>(blades), p.blades.front());

  Swashplate::Parameters s;
  s.blades = blades;
  std::copy(std::begin(kHover), std::end(kHover), s.trim.begin());

  CouplingGraph graph;
  graph.add("hub", std::make_unique<TurningHub>());
  graph.add("rotor", makeFeRotorModel(p));
  graph.add("swashplate", std::make_unique<Swashplate>(s));
  graph.add("airloads", makeSmoothAirloads(configuration, p.sections, kRotorSpeed));
  graph.add("inflow", std::make_unique<PrescribedInflow>(std::vector<double>{kMeanInflow, 0.0, 0.0}));
  for (const char* follower : {"rotor", "swashplate", "airloads"}) graph.connect("hub.hub_motion", std::string(follower) + ".hub_motion");
  for (const char* port : {"pitch", "pitch_rate", "pitch_acceleration"}) graph.connect(std::string("swashplate.") + port, std::string("rotor.") + port);
  for (const char* port : {"section_position", "section_velocity", "section_axes", "section_pitch"})
    graph.connect(std::string("rotor.") + port, std::string("airloads.") + port);
  graph.connect("airloads.section_loads", "rotor.section_loads");
  graph.connect("inflow.inflow", "airloads.inflow");
  return std::move(graph).build();
}

CoupledSystem buildCompleteRotor(const Problem::Overrides& more) {
  Problem::Overrides overrides{"subsystems.airloads.polar=linear", "simulation.start=none", "subsystems.fuselage.shaft_tilt_forward_deg=0.0"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return buildSystem(Configuration::load(std::string(HEERK_SOURCE_DIR) + kFile, overrides));
}

std::unique_ptr<Simulation> simulationOf(CoupledSystem system, int steps_per_revolution) {
  StepOptions options;
  options.step = kRevolution / steps_per_revolution;
  options.solver.tolerance = 1e-13;
  return std::make_unique<Simulation>(std::move(system), options);
}

void advance(Simulation& simulation, const Vector& command) {
  if (simulation.step(command) != StepStatus::kOk) throw std::runtime_error("start of the blades: " + simulation.failure().cause);
}

/// Adds start and command to the problem.
void startSmoothly(Problem& problem) {
  auto rest = simulationOf(problem.build({kStrongDamping}), kRestSteps);
  Vector command = rest->system().defaultCommand();
  std::vector<Index> entries;
  for (const char* name : {"collective", "lateral_cyclic", "longitudinal_cyclic"}) {
    const auto& names = rest->system().commandNames();
    entries.push_back(std::find(names.begin(), names.end(), std::string("swashplate.") + name) - names.begin());
  }
  for (std::size_t i = 0; i < 3; ++i) command[entries[i]] = kHover[i];
  for (int k = 0; k < kRestRevolutions * kRestSteps; ++k) advance(*rest, command);

  auto ramp = simulationOf(problem.build({}), kRampSteps);
  ramp->setState(rest->state());
  const int steps = kRampRevolutions * kRampSteps;
  for (int k = 0; k < steps; ++k) {
    const double s = (k + 0.5) / steps, part = s * s * s * s * (35.0 - 84.0 * s + 70.0 * s * s - 20.0 * s * s * s);
    for (std::size_t i = 0; i < 3; ++i) command[entries[i]] = kHover[i] + part * (kManoeuvre[i] - kHover[i]);
    advance(*ramp, command);
  }
  const std::vector<std::string> names = ramp->system().stateNames();
  for (std::size_t i = 0; i < names.size(); ++i) problem.start[names[i]] = ramp->state()[static_cast<Index>(i)];
  problem.command = command;
}

Problem bladeProblem(const std::string& name, const std::string& group, const std::string& meaning, std::function<CoupledSystem(const Problem::Overrides&)> build) {
  Problem problem;
  problem.name = name;
  problem.group = group;
  problem.meaning = meaning;
  problem.build = std::move(build);
  problem.duration = kRevolution;
  problem.instants = 5;  // no divisor of four blades: every instant sees other azimuths
  problem.fine_step = kRevolution / 15000;
  startSmoothly(problem);
  return problem;
}

}  // namespace

Problem bladesOnHub(int blades) {
  const std::string what = std::to_string(blades) + (blades == 1 ? " elastic blade" : " elastic blades");
  const std::string meaning = what + ", all 50 modes, smooth airloads, on a turning hub, one revolution; all published outputs";
  const auto build = [blades](const Problem::Overrides& more) { return buildBladesOnHub(blades, more); };
  Problem problem = bladeProblem("blades_" + std::to_string(blades), "blades", meaning, build);
  problem.mode_counts = {40, 30, 20, 15, 12, 9, 6};
  return problem;
}

Problem completeRotor() {
  const std::string meaning = "complete rotor of config/bo105.yaml (44 modes per blade) with smooth airloads, one revolution; all published outputs";
  Problem problem = bladeProblem("rotor", "rotor", meaning, buildCompleteRotor);
  problem.mode_counts = {40, 30, 20, 15, 12, 9, 6};
  return problem;
}

}  // namespace heerk_rotor::work_precision
