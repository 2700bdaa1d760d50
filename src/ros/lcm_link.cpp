#include "heerk_rotor/ros/lcm_link.hpp"

#include <stdexcept>

#include <ros/console.h>

#ifdef HEERK_WITH_LCM

#include "heerk_rotor/lcm/lcm_bridge.hpp"
#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

namespace heerk_rotor {

struct LcmLink::Implementation {
  int every = 1;
  std::unique_ptr<RotorRing> live_ring, log_ring;
  std::unique_ptr<LcmBridge> bridge;
  std::unique_ptr<LcmLogRecorder> recorder;
};

LcmLink::LcmLink(const NodeParameters& parameters, const Sizes& sizes, const StampBase& stamps, CommandInput* commands,
                 std::function<std::uint64_t()> overruns)
    : impl_(std::make_unique<Implementation>()) {
  impl_->every = parameters.lcm_every;
  if (!parameters.lcm_url.empty()) {
    LcmBridge::CommandHandler handler;
    if (commands != nullptr)
      handler = [commands](const swashplate_command_t& c) {
        commands->accept(std::array<double, 3>{c.collective, c.lateral_cyclic, c.longitudinal_cyclic}, CommandSource::kLcm);
      };
    impl_->live_ring = std::make_unique<RotorRing>(sizes.live_ring);
    try {
      impl_->bridge = std::make_unique<LcmBridge>(parameters.lcm_url, *impl_->live_ring, stamps.start, handler);
      impl_->bridge->setOverrunCounter(overruns);
    } catch (const LcmError& error) {
      if (parameters.lcm_url_given) throw;
      ROS_WARN_STREAM(error.what() << "; going on without LCM");
    }
  }
  if (!parameters.lcm_log.empty()) {
    impl_->log_ring = std::make_unique<RotorRing>(sizes.log_ring);
    impl_->recorder = std::make_unique<LcmLogRecorder>(parameters.lcm_log, *impl_->log_ring, stamps.start, sizes.expected_steps);
    impl_->recorder->setOverrunCounter(overruns);
  }
}

void LcmLink::connect(RotorTask& task, RotorDiagnostics& diagnostics, bool lossless, const std::atomic<bool>& stop) {
  if (impl_->bridge) {
    task.addRing(*impl_->live_ring, static_cast<std::uint64_t>(impl_->every));
    LcmBridge* bridge = impl_->bridge.get();
    diagnostics.addReader({"LCM", [bridge] { return bridge->published(); }, impl_->live_ring.get(), [bridge] { return bridge->problem(); }});
  }
  if (impl_->recorder) {
    if (lossless) task.addLosslessRing(*impl_->log_ring, stop);
    else task.addRing(*impl_->log_ring, 1);
    LcmLogRecorder* recorder = impl_->recorder.get();
    diagnostics.addReader({"LCM log", [recorder] { return recorder->written(); }, impl_->log_ring.get(), [recorder] { return recorder->problem(); }});
  }
}

void LcmLink::start() {
  if (impl_->bridge) impl_->bridge->start();
  if (impl_->recorder) impl_->recorder->start();
}

void LcmLink::stop() {
  if (impl_->bridge) impl_->bridge->stop();
  if (impl_->recorder) impl_->recorder->stop();
}

std::string LcmLink::recordingProblem() const { return impl_->recorder ? impl_->recorder->problem() : ""; }

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

struct LcmLink::Implementation {};

LcmLink::LcmLink(const NodeParameters& parameters, const Sizes&, const StampBase&, CommandInput*, std::function<std::uint64_t()>) {
  if (parameters.lcm_url_given || !parameters.lcm_log.empty()) throw std::runtime_error("~lcm_url, ~lcm_log: this build has no LCM");
  if (!parameters.lcm_url.empty()) ROS_WARN("this build has no LCM");
}
void LcmLink::connect(RotorTask&, RotorDiagnostics&, bool, const std::atomic<bool>&) {}
void LcmLink::start() {}
void LcmLink::stop() {}
std::string LcmLink::recordingProblem() const { return ""; }

}  // namespace heerk_rotor

#endif

heerk_rotor::LcmLink::~LcmLink() = default;
