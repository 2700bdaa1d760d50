#include "heerk_rotor/ros/rotor_node.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <sstream>

#include "heerk_rotor/analysis/step_warning.hpp"
#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"

namespace heerk_rotor {
namespace {

StampBase chooseStampBase(bool publish_clock) {
  if (publish_clock) {
    if (!ros::Time::isSimTime()) ROS_WARN("~publish_clock: stamps are simulation time, but /use_sim_time is not true; other nodes will not follow /clock");
    return StampBase{0};
  }
  if (ros::Time::isSimTime() && !ros::Time::waitForValid(ros::WallDuration(5.0)))
    ROS_WARN("/use_sim_time is true, but nobody publishes /clock: stamps are simulation time (set ~publish_clock to publish it here)");
  return StampBase{static_cast<std::int64_t>(ros::Time::now().toNSec())};
}

/// roscpp's log is silent once a signal has shut ROS down, but the end of a run is news all the same.
void sayAtTheEnd(const std::string& text, bool error) {
  if (!ros::ok()) std::fprintf(error ? stderr : stdout, "[rotor] %s\n", text.c_str());
  else if (error) ROS_ERROR_STREAM(text);
  else ROS_INFO_STREAM(text);
}

}  // namespace

RotorNode::RotorNode(const NodeParameters& parameters)
    : parameters_(parameters),
      configuration_(Configuration::load(parameters.config, parameters.set)),
      simulation_(buildSimulation(configuration_)),
      limits_(*simulation_, simulation_->options().revolution),
      commands_(simulation_->system()),
      rates_(chooseRates(parameters, simulation_->stepSize())),
      stamps_(chooseStampBase(parameters.publish_clock)),
      input_(readCommandLimits(configuration_, simulation_->system(), commands_), parameters.lock_step > 0, [this] { loop_.wake(); }),
      disturbances_(simulation_->system(), commands_),
      outlets_(openOutlets({node_, configuration_, *simulation_, parameters_, rates_, stamps_, commands_.hasSwashplate() ? &input_ : nullptr, [this] { return loop_.timing().overruns(); }})),
      task_(*simulation_, outlets_->feed(), commands_, input_, taskOptions()),
      loop_(task_, clock_, {simulation_->stepSize(), parameters.real_time_factor, rates_.steps_per_wake, parameters.priority}),
      services_(private_node_, *simulation_, task_, loop_, configuration_.resolvedText(), parameters.lock_step > 0),
      trim_service_(private_node_, configuration_, *simulation_, task_, loop_),
      diagnostics_(node_, *simulation_, task_, loop_, limits_, commands_.hasSwashplate() ? &input_ : nullptr) {
  for (HeldInput* input : {&disturbances_.speed(), &disturbances_.wind(), &disturbances_.externalWrench()}) task_.addInput(*input);
  outlets_->connect(diagnostics_, loop_.stopRequested());
  subscribeToCommands();
}

RotorNode::~RotorNode() { stop(); }

RotorTask::Options RotorNode::taskOptions() const {
  RotorTask::Options options;
  options.command_timeout = parameters_.command_timeout;
  options.timeout_policy = parameters_.timeout_policy;
  options.lock_step = static_cast<std::uint64_t>(parameters_.lock_step);
  options.last_step = static_cast<std::uint64_t>(std::llround(parameters_.duration / simulation_->stepSize()));
  return options;
}

void RotorNode::subscribeToCommands() {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  disturbances_.subscribe(node_);
  if (!commands_.hasSwashplate()) {
    ROS_INFO("the configuration has no swashplate: commands are not subscribed to");
    return;
  }
  const std::uint32_t queue = parameters_.lock_step > 0 ? 64 : 1;  // run freely, only the newest command matters
  const auto onCommand = [this](const SwashplateCommand::ConstPtr& c) {
    input_.accept(std::array<double, 3>{c->collective, c->lateral_cyclic, c->longitudinal_cyclic}, CommandSource::kRos);
  };
  const auto onArray = [this](const std_msgs::Float64MultiArray::ConstPtr& array) { input_.accept(array->data, CommandSource::kRosArray); };
  subscribers_.push_back(node_.subscribe<SwashplateCommand>("rotor/swashplate_command", queue, onCommand, ros::VoidConstPtr(), hints));
  subscribers_.push_back(node_.subscribe<std_msgs::Float64MultiArray>("rotor/swashplate_array", queue, onArray, ros::VoidConstPtr(), hints));
}

void RotorNode::start() {
  // Node runs have no length: the check may cost what it does, some hundred steps.
  const double revolution = simulation_->options().revolution;
  const std::string wrong = stepWarning(configuration_, *simulation_, simulation_->system().defaultCommand(), revolution, std::numeric_limits<std::uint64_t>::max());
  if (!wrong.empty()) ROS_WARN_STREAM(wrong);
  outlets_->start();
  const RealTimeRights rights = loop_.start();
  if (!rights.complaint.empty()) ROS_WARN_STREAM("step thread without full real-time rights: " << rights.complaint);
  const std::string scheduling = parameters_.real_time_factor > 0.0 ? rights.text(parameters_.priority) : "as fast as possible at normal priority";
  diagnostics_.start(scheduling);
  spinner_.start();
  trim_service_.start();
  ROS_INFO_STREAM("running " << configuration_.file() << ": " << simulation_->options().method << ", step " << simulation_->stepSize() << " s, real-time factor "
                             << parameters_.real_time_factor << ", " << rates_.steps_per_wake << " steps per wake-up, one in " << rates_.publish_every
                             << " to ROS, one in " << rates_.lcm_every << " to LCM; step thread: " << scheduling);
}

int RotorNode::run() {
  start();
  while (ros::ok() && !loop_.ended()) {
    supervise();
    if (failed_ && parameters_.duration > 0.0) break;  // nobody is there to mend it
    ros::WallDuration(0.02).sleep();
  }
  stop();
  return exitStatus();
}

void RotorNode::supervise() {
  failed_ = loop_.mode() == RealTimeLoop::Mode::kFailed;
  if (failed_) reportFailure();
  const std::string problem = outlets_->recordingProblem();
  if (problem.empty() || recording_problem_reported_) return;
  recording_problem_reported_ = true;
  ROS_ERROR_STREAM(problem);
}

void RotorNode::reportFailure() {
  std::string text;
  Outlets::History history;
  std::int64_t epoch = -1;
  loop_.call([&] {
    if (loop_.mode() != RealTimeLoop::Mode::kFailed) return;  // mended meanwhile
    text = task_.failureText();
    history = outlets_->history();
    epoch = simulation_->epoch();
  });
  if (epoch < 0 || epoch == reported_epoch_) return;
  reported_epoch_ = epoch;
  ROS_ERROR_STREAM("the simulation stopped at " << text << ". Call ~reset or ~load_snapshot to go on");
  try {
    history.write(parameters_.failure_file);
    ROS_ERROR_STREAM("the last " << history.instants << " instants before it are in " << parameters_.failure_file);
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("the instants before it could not be written: " << error.what());
  }
}

void RotorNode::stop() {
  trim_service_.stop();
  spinner_.stop();
  diagnostics_.stop();
  loop_.stop();
  // From here on nothing new enters the rings; the readers finish what is in them.
  outlets_->stop();
}

int RotorNode::exitStatus() {
  const TimingReport timing = loop_.timing().report();
  std::ostringstream summary;
  summary << "ended after " << timing.steps << " steps, simulation time " << simulation_->time() << " s: " << timing.overruns << " overruns (" << timing.late_wake_ups
          << " late wake-ups, " << timing.long_steps << " long steps), " << timing.slips << " slips";
  sayAtTheEnd(summary.str(), false);
  for (const std::string& warning : limits_.warnings()) sayAtTheEnd(warning, false);
  const std::string problem = outlets_->recordingProblem();
  if (!problem.empty() && !recording_problem_reported_) sayAtTheEnd(problem, true);
  if (loop_.mode() == RealTimeLoop::Mode::kFailed) return kSimulationFailed;
  return problem.empty() ? kDone : kRecordingIncomplete;
}

}  // namespace heerk_rotor
