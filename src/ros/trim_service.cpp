#include "heerk_rotor/ros/trim_service.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <ros/console.h>

#include "heerk_rotor/analysis/trim.hpp"
#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/assembly/start_file.hpp"
#include "heerk_rotor/config/simulation_settings.hpp"

namespace heerk_rotor {

TrimService::TrimService(const ros::NodeHandle& private_node, const Configuration& configuration, Simulation& simulation, RotorTask& task, RealTimeLoop& loop)
    : configuration_(configuration), simulation_(simulation), task_(task), loop_(loop), node_(private_node), spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  server_ = node_.advertiseService("trim", &TrimService::serve, this);
}

TrimService::~TrimService() { stop(); }

void TrimService::start() { spinner_.start(); }

void TrimService::stop() {
  cancel_ = true;
  spinner_.stop();
}

bool TrimService::serve(Trim::Request& request, Trim::Response& response) {
  try {
    solve(request, response);
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  if (!response.success) ROS_WARN_STREAM("trim: " << response.message);
  return true;
}

void TrimService::solve(const Trim::Request& request, Trim::Response& response) {
  // Differences of the step map need a tighter algebraic part than a run.
  const Configuration tight = Configuration::parse(configuration_.resolvedText(), configuration_.file(), {"simulation.newton_tolerance=1e-12"});
  const std::unique_ptr<Simulation> model = buildSimulation(tight);
  const CoupledSystem& system = model->system();
  Problems problems;
  TrimSettings settings = readTrimSettings(tight, system, problems);
  const double revolution = readSimulationSettings(tight, problems).revolution();
  if (!problems.empty()) throw ConfigurationError(problems);
  if (!request.targets.empty() && request.targets.size() != settings.targets.size())
    throw std::invalid_argument("targets has " + std::to_string(request.targets.size()) + " values, expected " + std::to_string(settings.targets.size()) +
                                " as the section trim of " + configuration_.file() + ", or none");
  std::copy(request.targets.begin(), request.targets.end(), settings.targets.begin());

  TrimOptions options;
  options.threads = 1;  // the other processors belong to the simulation and its readers
  options.cancel = &cancel_;
  const TrimResult result = trim([&tight] { return buildSimulation(tight); }, revolution, settings, options);
  for (const Index control : settings.controls) {
    response.controls.push_back(system.commandNames()[static_cast<std::size_t>(control)]);
    response.values.push_back(result.w[control]);
  }
  if (!result.trimmed()) {
    response.message = cancel_ ? "given up because the node ends" : result.message;
    return;
  }
  const std::unique_ptr<Simulation> trimmed = buildSimulation(configuration_.withStart(startText(system, result.x, result.w, {{"made_by", "~trim"}}), "(~trim)"));
  Simulation::Checkpoint checkpoint = trimmed->checkpoint();
  checkpoint.w = result.w;
  const bool alive = loop_.recover([&] {
    simulation_.restore(checkpoint, true);
    task_.resume(checkpoint.w);
    task_.showPresent();
  });
  if (!alive) throw std::runtime_error("the simulation has ended");
  response.success = true;
  char text[96];
  std::snprintf(text, sizeof text, "largest residual %.1e of the quantity's magnitude, %ld iterations", std::max(result.worst_periodicity, result.worst_target), result.iterations);
  response.message = text;
}

}  // namespace heerk_rotor
