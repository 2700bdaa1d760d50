#include "heerk_rotor/lcm/lcm_bridge.hpp"

#include <cerrno>
#include <chrono>
#include <cmath>

#include "heerk_rotor/lcm/conversions.hpp"

namespace heerk_rotor {

using std::chrono::milliseconds;

LcmBridge::LcmBridge(const std::string& url, RotorRing& ring, std::int64_t stamp_base, CommandHandler handler)
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

LcmBridge::~LcmBridge() { stop(); }

void LcmBridge::start() {
  sender_ = std::thread([this] { send(); });
  if (handler_) receiver_ = std::thread([this] { receive(); });
}

void LcmBridge::stop() {
  stop_ = true;
  if (sender_.joinable()) sender_.join();
  if (receiver_.joinable()) receiver_.join();
}

void LcmBridge::send() {
  RotorInstant instant;
  rotor_state_t message;
  for (;;) {
    const bool last_round = stop_;  // read first: what was pushed before stop() is still published
    while (ring_.popWaiting(instant, last_round ? milliseconds(0) : milliseconds(50))) {
      const std::int64_t stamp = stamp_base_ + std::llround(instant.reading.sim_time * 1e9);
      toLcmState(instant.reading, stamp, name(instant.source), overruns_(), ring_.dropped(), message);
      ++(lcm_.publish(kStateChannel, &message) == 0 ? published_ : failed_);
    }
    if (last_round) return;
  }
}

void LcmBridge::receive() {
  while (!stop_) {
    errno = 0;
    receive_failing_ = lcm_.handleTimeout(50) < 0 && errno != EINTR;
    if (!receive_failing_) continue;
    ++receive_errors_;
    std::this_thread::sleep_for(milliseconds(50));  // a provider that is broken fails at once: do not spin
  }
}

std::string LcmBridge::problem() const {
  if (!receive_failing_) return "";
  return "LCM cannot receive commands from " + url_ + " any more (" + std::to_string(receive_errors_) + " attempts failed)";
}

void LcmBridge::onCommand(const lcm::ReceiveBuffer*, const std::string&, const swashplate_command_t* command, LcmBridge* self) {
  ++self->received_;
  self->handler_(*command);
}

}  // namespace heerk_rotor
