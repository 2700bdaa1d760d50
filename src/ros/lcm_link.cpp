#include "heerk_rotor/ros/lcm_link.hpp"

#include <stdexcept>

#include <ros/console.h>

#ifdef HEERK_WITH_LCM

#include "heerk_rotor/lcm/lcm_bridge.hpp"
#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

namespace heerk_rotor {

template <class Kind>
struct LcmLink<Kind>::Implementation {
  using Instant = typename Kind::Instant;
  int every = 1;
  std::unique_ptr<SnapshotRing<Instant>> live_ring, log_ring;
  std::unique_ptr<LcmBridge<Instant>> bridge;
  std::unique_ptr<LcmLogRecorder<Instant>> recorder;
};

template <class Kind>
LcmLink<Kind>::LcmLink(const NodeParameters& parameters, const Plan& plan, const StampBase& stamps, CommandInput* commands,
                 std::function<std::uint64_t()> overruns)
    : impl_(std::make_unique<Implementation>()) {
  using Instant = typename Kind::Instant;
  impl_->every = plan.every;
  if (!parameters.lcm_url.empty()) {
    typename LcmBridge<Instant>::CommandHandler handler;
    if (commands != nullptr)
      handler = [commands](const swashplate_command_t& c) {
        commands->accept(std::array<double, 3>{c.collective, c.lateral_cyclic, c.longitudinal_cyclic}, CommandSource::kLcm);
      };
    impl_->live_ring = std::make_unique<SnapshotRing<Instant>>(plan.live_ring);
    try {
      impl_->bridge = std::make_unique<LcmBridge<Instant>>(parameters.lcm_url, *impl_->live_ring, stamps.start, handler);
      impl_->bridge->setOverrunCounter(overruns);
    } catch (const LcmError& error) {
      if (parameters.lcm_url_given) throw;
      ROS_WARN_STREAM(error.what() << "; going on without LCM");
    }
  }
  if (!parameters.lcm_log.empty()) {
    impl_->log_ring = std::make_unique<SnapshotRing<Instant>>(plan.log_ring);
    impl_->recorder = std::make_unique<LcmLogRecorder<Instant>>(parameters.lcm_log, *impl_->log_ring, stamps.start, plan.expected_steps);
    impl_->recorder->setOverrunCounter(overruns);
  }
}

template <class Kind>
void LcmLink<Kind>::connect(InstantFeed<Kind>& feed, RotorDiagnostics& diagnostics, bool lossless, const std::atomic<bool>& stop) {
  if (impl_->bridge) {
    feed.addRing(*impl_->live_ring, static_cast<std::uint64_t>(impl_->every));
    const auto* bridge = impl_->bridge.get();
    diagnostics.addReader({"LCM", [bridge] { return bridge->published(); }, impl_->live_ring.get(), [bridge] { return bridge->problem(); }});
  }
  if (impl_->recorder) {
    if (lossless) feed.addLosslessRing(*impl_->log_ring, stop);
    else feed.addRing(*impl_->log_ring, 1);
    const auto* recorder = impl_->recorder.get();
    diagnostics.addReader({"LCM log", [recorder] { return recorder->written(); }, impl_->log_ring.get(), [recorder] { return recorder->problem(); }});
  }
}

template <class Kind>
void LcmLink<Kind>::start() {
  if (impl_->bridge) impl_->bridge->start();
  if (impl_->recorder) impl_->recorder->start();
}

template <class Kind>
void LcmLink<Kind>::stop() {
  if (impl_->bridge) impl_->bridge->stop();
  if (impl_->recorder) impl_->recorder->stop();
}

template <class Kind>
std::string LcmLink<Kind>::recordingProblem() const { return impl_->recorder ? impl_->recorder->problem() : ""; }

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

template <class Kind>
struct LcmLink<Kind>::Implementation {};

template <class Kind>
LcmLink<Kind>::LcmLink(const NodeParameters& parameters, const Plan&, const StampBase&, CommandInput*, std::function<std::uint64_t()>) {
  if (parameters.lcm_url_given || !parameters.lcm_log.empty()) throw std::runtime_error("~lcm_url, ~lcm_log: this build has no LCM");
  if (!parameters.lcm_url.empty()) ROS_WARN("this build has no LCM");
}
template <class Kind>
void LcmLink<Kind>::connect(InstantFeed<Kind>&, RotorDiagnostics&, bool, const std::atomic<bool>&) {}
template <class Kind>
void LcmLink<Kind>::start() {}
template <class Kind>
void LcmLink<Kind>::stop() {}
template <class Kind>
std::string LcmLink<Kind>::recordingProblem() const { return ""; }

}  // namespace heerk_rotor

#endif

namespace heerk_rotor {

template <class Kind>
LcmLink<Kind>::~LcmLink() = default;

template class LcmLink<RotorKind>;
template class LcmLink<ShaftKind>;

}  // namespace heerk_rotor
