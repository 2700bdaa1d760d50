#include "heerk_rotor/lcm/lcm_bridge.hpp"

#include <cerrno>
#include <chrono>

namespace heerk_rotor {

using std::chrono::milliseconds;

template <class Instant>
LcmBridge<Instant>::LcmBridge(const std::string& url, SnapshotRing<Instant>& ring, std::int64_t stamp_base, CommandHandler handler)
    : url_(url), lcm_(url), ring_(ring), stamp_base_(stamp_base), handler_(std::move(handler)) {
  if (!lcm_.good())
    throw LcmError("LCM cannot open " + url + " (on a machine without default route: ip link set lo up; ip route add 224.0.0.0/4 dev lo)");
  if (!handler_) return;
  // The C++ subscription hides the result; the C interface tells whether the multicast group could be joined.
  lcm_subscription_t* probe = lcm_subscribe(lcm_.getUnderlyingLCM(), kCommandChannel, [](const lcm_recv_buf_t*, const char*, void*) {}, nullptr);
  if (probe == nullptr) throw LcmError("LCM cannot receive from " + url + " (on a machine without default route: ip route add 224.0.0.0/4 dev lo)");
  lcm_unsubscribe(lcm_.getUnderlyingLCM(), probe);
  lcm_.subscribeFunction(kCommandChannel, &LcmBridge::onCommand, this);
}

template <class Instant>
LcmBridge<Instant>::~LcmBridge() { stop(); }

template <class Instant>
void LcmBridge<Instant>::start() {
  sender_ = std::thread([this] { send(); });
  if (handler_) receiver_ = std::thread([this] { receive(); });
}

template <class Instant>
void LcmBridge<Instant>::stop() {
  stop_ = true;
  if (sender_.joinable()) sender_.join();
  if (receiver_.joinable()) receiver_.join();
}

template <class Instant>
void LcmBridge<Instant>::send() {
  Instant instant;
  typename LcmState<Instant>::Message message;
  for (;;) {
    const bool last_round = stop_;  // read first: what was pushed before stop() is still published
    while (ring_.popWaiting(instant, last_round ? milliseconds(0) : milliseconds(50))) {
      toLcmState(instant, {lcmStamp(stamp_base_, instant.reading.sim_time), overruns_(), ring_.dropped()}, message);
      ++(lcm_.publish(kStateChannel, &message) == 0 ? published_ : failed_);
    }
    if (last_round) return;
  }
}

template <class Instant>
void LcmBridge<Instant>::receive() {
  while (!stop_) {
    errno = 0;
    receive_failing_ = lcm_.handleTimeout(50) < 0 && errno != EINTR;
    if (!receive_failing_) continue;
    ++receive_errors_;
    std::this_thread::sleep_for(milliseconds(50));  // a provider that is broken fails at once: do not spin
  }
}

template <class Instant>
std::string LcmBridge<Instant>::problem() const {
  if (!receive_failing_) return "";
  return "LCM cannot receive commands from " + url_ + " any more (" + std::to_string(receive_errors_) + " attempts failed)";
}

template <class Instant>
void LcmBridge<Instant>::onCommand(const lcm::ReceiveBuffer*, const std::string&, const swashplate_command_t* command, LcmBridge* self) {
  ++self->received_;
  self->handler_(*command);
}

template class LcmBridge<RotorInstant>;
template class LcmBridge<ShaftInstant>;

}  // namespace heerk_rotor
