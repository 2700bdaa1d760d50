#include "heerk_rotor/ros/rotor_services.hpp"

#include <exception>
#include <sstream>

#include <ros/console.h>

#include "heerk_rotor/assembly/snapshot.hpp"

namespace heerk_rotor {
namespace {

std::string instantText(std::uint64_t step, double time) {
  std::ostringstream text;
  text << "step " << step << ", simulation time " << time << " s";
  return text.str();
}

const char* const kEnded = "the simulation has ended";

std::string notAbsolute(const std::string& path) {
  return path.empty() || path[0] != '/' ? "path '" + path + "': expected an absolute path on the machine of the node" : "";
}

}  // namespace

RotorServices::RotorServices(ros::NodeHandle& private_node, Simulation& simulation, RotorTask& task, RealTimeLoop& loop, std::string configuration, bool lock_step)
    : simulation_(simulation), task_(task), loop_(loop), configuration_(std::move(configuration)), lock_step_(lock_step) {
  servers_ = {private_node.advertiseService("pause", &RotorServices::pause, this),
              private_node.advertiseService("unpause", &RotorServices::unpause, this),
              private_node.advertiseService("reset", &RotorServices::reset, this),
              private_node.advertiseService("step", &RotorServices::step, this),
              private_node.advertiseService("save_snapshot", &RotorServices::save, this),
              private_node.advertiseService("load_snapshot", &RotorServices::load, this)};
}

bool RotorServices::pause(Empty::Request&, Empty::Response&) {
  return loop_.pause() && loop_.call([this] { task_.showPresent(); });
}

bool RotorServices::unpause(Empty::Request&, Empty::Response&) { return loop_.unpause(); }

bool RotorServices::reset(Empty::Request&, Empty::Response&) {
  return loop_.recover([this] {
    simulation_.reset();
    task_.startOver();
    task_.showPresent();
  });
}

std::string RotorServices::failureText() const {
  std::string text;
  loop_.call([&] { text = task_.failureText(); });
  return text;
}

std::string RotorServices::whyNoStep(std::uint32_t n) const {
  if (n == 0) return "n = 0: expected at least 1";
  if (lock_step_) return "~lock_step is set: the simulation advances with each command";
  switch (loop_.mode()) {
    case RealTimeLoop::Mode::kRunning: return "the simulation runs: call ~pause first";
    case RealTimeLoop::Mode::kFailed: return "the last step failed (" + failureText() + "): call ~reset or ~load_snapshot";
    case RealTimeLoop::Mode::kFinished: return kEnded;
    case RealTimeLoop::Mode::kPaused: break;
  }
  return "";
}

bool RotorServices::step(Step::Request& request, Step::Response& response) {
  response.message = whyNoStep(request.n);
  if (response.message.empty()) {
    response.success = loop_.step(request.n);
    if (!response.success) response.message = loop_.mode() == RealTimeLoop::Mode::kFailed ? failureText() : "interrupted by ~pause, ~unpause or the end of the simulation";
  }
  const bool alive = loop_.call([&] {
    task_.showPresent();
    response.step = simulation_.stepCount();
    response.sim_time = simulation_.time();
  });
  if (!alive && response.message.empty()) response.message = kEnded;
  return true;
}

bool RotorServices::save(SaveSnapshot::Request& request, SaveSnapshot::Response& response) {
  try {
    response.message = notAbsolute(request.path);
    if (!response.message.empty()) return true;
    Snapshot snapshot{configuration_, {}};
    if (!loop_.call([&] { snapshot.checkpoint = simulation_.checkpoint(); })) throw std::runtime_error(kEnded);
    saveSnapshot(request.path, snapshot);
    response.message = instantText(snapshot.checkpoint.step, static_cast<double>(snapshot.checkpoint.step) * snapshot.checkpoint.h);
    response.success = true;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

bool RotorServices::load(LoadSnapshot::Request& request, LoadSnapshot::Response& response) {
  try {
    response.message = notAbsolute(request.path);
    if (!response.message.empty()) return true;
    const Snapshot snapshot = loadSnapshot(request.path);
    const bool alive = loop_.recover([&] {
      simulation_.restore(snapshot.checkpoint, true);
      task_.resume(snapshot.checkpoint.w);
      task_.showPresent();
    });
    if (!alive) throw std::runtime_error(kEnded);
    response.success = true;
    if (snapshot.configuration != configuration_) {
      response.message = "the snapshot was made with another configuration: its state goes on with the present one";
      ROS_WARN_STREAM("load_snapshot " << request.path << ": " << response.message);
    }
  } catch (const std::exception& error) {
    response.message = error.what();
  }
  return true;
}

}  // namespace heerk_rotor
