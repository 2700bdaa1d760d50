#include "heerk_rotor/analysis/analysis_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace heerk_rotor {
namespace {

template <class... Values>
std::string print(const char* format, Values... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// JSON has no infinity: a command without limit has null.
std::string number(double value) { return std::isfinite(value) ? print("%.17g", value) : "null"; }

const char* name(TrimResult::Status status) {
  switch (status) {
    case TrimResult::Status::kTrimmed: return "trimmed";
    case TrimResult::Status::kInfeasible: return "infeasible";
    case TrimResult::Status::kStalled: return "stalled";
    case TrimResult::Status::kIterationsExhausted: return "iterations_exhausted";
    case TrimResult::Status::kSimulationFailed: return "simulation_failed";
  }
  return "unknown";
}

bool inDegrees(const std::string& unit) { return unit == "rad"; }

int widest(const std::vector<std::string>& names) {
  std::size_t width = 8;
  for (const std::string& name : names) width = std::max(width, name.size());
  return static_cast<int>(width);
}

/// Units of the entries of w, from the input ports.
std::string commandUnit(const CoupledSystem& system, Index entry) {
  for (const CoupledSystem::Input& input : system.inputs()) {
    if (input.command < 0 || entry < input.command || entry >= input.command + input.size) continue;
    const CoupledSystem::Subsystem& owner = system.subsystems()[static_cast<std::size_t>(input.subsystem)];
    for (const InputPort& port : owner.model->inputs())
      if (owner.name + "." + port.name == input.name) return port.unit;
  }
  return "";
}

}  // namespace

std::string text(const TrimResult& result, const TrimSettings& settings, const CoupledSystem& system) {
  std::string out = print("%s after %ld iterations, %ld gradients, %ld revolutions simulated\n", name(result.status), result.iterations, result.gradients, result.revolutions);
  if (!result.message.empty()) out += result.message + "\n";
  std::vector<std::string> names;
  for (const Signal& signal : settings.signals) names.push_back(signal.name);
  for (const Index control : settings.controls) names.push_back(system.commandNames()[static_cast<std::size_t>(control)]);
  const int width = widest(names);
  if (!settings.signals.empty()) out += print("%-*s %16s %16s %11s\n", width, "target", "wanted", "mean reached", "residual");
  for (std::size_t k = 0; k < settings.signals.size(); ++k) {
    const double reached = result.means[static_cast<Index>(k)];
    out += print("%-*s %16.9g %16.9g %11.2e %s\n", width, settings.signals[k].name.c_str(), settings.targets[k], reached, reached - settings.targets[k], settings.signals[k].unit.c_str());
  }
  if (!settings.controls.empty()) out += print("%-*s %16s %16s %11s\n", width, "control", "value", "low", "high");
  for (const Index control : settings.controls) {
    const std::string unit = commandUnit(system, control);
    out += print("%-*s %16.9g %16.6g %11.6g %s", width, system.commandNames()[static_cast<std::size_t>(control)].c_str(), result.w[control], system.commandLow()[control],
                 system.commandHigh()[control], unit.c_str());
    out += inDegrees(unit) ? print(" (%.4f deg)\n", result.w[control] * 57.29577951308232) : "\n";
  }
  return out + print("periodicity: at most %.2e of the state's magnitude (%s)\n", result.worst_periodicity, result.worst_state.c_str());
}

std::string json(const TrimResult& result, const TrimSettings& settings, const CoupledSystem& system) {
  std::string out = print("{\"status\": \"%s\", \"message\": \"", name(result.status));
  for (const char c : result.message) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  out += print("\", \"iterations\": %ld, \"gradients\": %ld, \"revolutions\": %ld, \"period\": %.17g, \"periodicity\": ", result.iterations, result.gradients, result.revolutions, result.period);
  out += number(result.worst_periodicity) + ", \"periodicity_state\": \"" + result.worst_state + "\", \"targets\": {";
  for (std::size_t k = 0; k < settings.signals.size(); ++k) {
    const double reached = result.means[static_cast<Index>(k)];
    out += (k > 0 ? ", \"" : "\"") + settings.signals[k].name + "\": {\"wanted\": " + number(settings.targets[k]) + ", \"reached\": " + number(reached) +
           ", \"residual\": " + number(reached - settings.targets[k]) + "}";
  }
  out += "}, \"controls\": {";
  for (std::size_t k = 0; k < settings.controls.size(); ++k) {
    const Index control = settings.controls[k];
    out += (k > 0 ? ", \"" : "\"") + system.commandNames()[static_cast<std::size_t>(control)] + "\": {\"value\": " + number(result.w[control]) +
           ", \"low\": " + number(system.commandLow()[control]) + ", \"high\": " + number(system.commandHigh()[control]) + "}";
  }
  out += "}, \"history\": [";
  for (std::size_t i = 0; i < result.history.size(); ++i) out += (i > 0 ? ", " : "") + number(result.history[i]);
  return out + "]}";
}

std::string text(const Stability& stability, const std::string& what, double revolution, std::size_t shown) {
  std::string out = print("%s: spectral radius %.12g (1 %+.2e)\n", what.c_str(), stability.spectral_radius, stability.spectral_radius - 1.0);
  if (stability.unstable()) out += "WARNING: " + what + " is unstable: its spectral radius is above 1\n";
  if (stability.modes.empty()) return out;
  out += print("  %14s %12s %10s %12s  %s\n", "|mu|", "freq. [Hz]", "[per rev]", "damping", "state of largest participation");
  for (std::size_t i = 0; i < stability.modes.size() && i < shown; ++i) {
    const Multiplier& mode = stability.modes[i];
    out += print("  %14.10f %12.5g %10.5f %12.4e  %s\n", std::abs(mode.mu), mode.frequency, mode.frequency * revolution, mode.damping_ratio, mode.state.c_str());
  }
  if (stability.modes.size() > shown) out += print("  and %zu more, of smaller modulus\n", stability.modes.size() - shown);
  return out;
}

std::string json(const Stability& stability, double revolution, std::size_t shown) {
  std::string out = "{\"period\": " + number(stability.period) + ", \"spectral_radius\": " + number(stability.spectral_radius) + ", \"unstable\": " + (stability.unstable() ? "true" : "false") + ", \"modes\": [";
  for (std::size_t i = 0; i < stability.modes.size() && i < shown; ++i) {
    const Multiplier& mode = stability.modes[i];
    out += (i > 0 ? ", " : "") + ("{\"real\": " + number(mode.mu.real())) + ", \"imaginary\": " + number(mode.mu.imag()) + ", \"modulus\": " + number(std::abs(mode.mu)) +
           ", \"frequency\": " + number(mode.frequency) + ", \"per_revolution\": " + number(mode.frequency * revolution) + ", \"damping_ratio\": " + number(mode.damping_ratio) +
           ", \"state\": \"" + mode.state + "\"}";
  }
  return out + "]}";
}

}  // namespace heerk_rotor
