#include "heerk_rotor/config/simulation_settings.hpp"

#include <cmath>

#include "heerk_rotor/config/yaml_value.hpp"

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kAzimuthStepDeg = 1.0;      // [deg] default: every result of the paper study is at least converged there
constexpr double kMaxNewtonTolerance = 0.1;  // a relative error above 10 % is no solution

double readRotorSpeed(Section& section) {
  const double omega = section.has("rotor_speed_rpm") ? section.requiredNumber("rotor_speed_rpm", "rpm", positive()) * kPi / 30.0
                                                      : section.requiredNumber("rotor_speed", "rad/s", positive());
  if (section.has("rotor_speed") && section.has("rotor_speed_rpm")) {
    section.text("rotor_speed");
    section.problem("rotor_speed", "either rotor_speed [rad/s] or rotor_speed_rpm, not both");
  }
  section.text("rotor_speed_rpm");  // known, also when the other one is used
  return omega;
}

double readStep(Section& section, double rotor_speed) {
  Range turn = positive();
  turn.high = 360.0;
  const double azimuth_step = section.number("azimuth_step_deg", kAzimuthStepDeg, "deg", turn) * kPi / 180.0;
  return section.number("step", azimuth_step / rotor_speed, "s", positive());
}

void readNewtonTolerance(const Configuration& configuration, Section& section, SimulationSettings& settings) {
  const std::string text = section.text("newton_tolerance");
  if (text.empty()) return;
  settings.paper_tolerance = text == "paper" || text == "\"paper\"";
  if (settings.paper_tolerance) return;
  double value = 0.0;
  if (readNumber(findValue(configuration.root(), "simulation.newton_tolerance"), value) && value > 0.0 && value <= kMaxNewtonTolerance) {
    settings.newton_tolerance = value;
  } else {
    section.problem("newton_tolerance", "a number in (0, 0.1] [relative error of a loop], or the word paper");
  }
}

}  // namespace

double SimulationSettings::revolution() const { return 2.0 * kPi / rotor_speed; }

SimulationSettings readSimulationSettings(const Configuration& configuration, Problems& problems) {
  Section section(configuration, "simulation", problems);
  SimulationSettings settings;
  settings.integrator = section.word("integrator", settings.integrator);
  settings.rotor_speed = readRotorSpeed(section);
  settings.step = readStep(section, settings.rotor_speed);
  if (!std::isfinite(settings.step) || settings.step <= 0.0) {
    section.problem(section.has("rotor_speed_rpm") ? "rotor_speed_rpm" : "rotor_speed", "a speed at which the step is a positive, finite time");
  }
  settings.formulation = section.word("formulation", settings.formulation, {"absolute_lag", "printed"});
  readNewtonTolerance(configuration, section, settings);
  settings.duration = section.number("duration", settings.duration, "s", positive());
  section.child("start");  // read where the system is known, see assembly/start_file.hpp
  section.finish();
  return settings;
}

}  // namespace heerk_rotor
