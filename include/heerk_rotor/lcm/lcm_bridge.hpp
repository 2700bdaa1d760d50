#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/lcm/conversions.hpp"
#include "heerk_rotor/swashplate_command_t.hpp"

namespace heerk_rotor {

struct LcmError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Publishes every instant of a ring on its channel (ROTOR_STATE, SHAFT_STATE) and hands arriving SWASHPLATE_COMMAND messages on, each on a
/// thread of its own. UDP may lose messages on the way without anybody noticing; the ring's losses are counted.
template <class Instant>
class LcmBridge {
 public:
  static constexpr const char* kStateChannel = LcmState<Instant>::kChannel;
  static constexpr const char* kCommandChannel = "SWASHPLATE_COMMAND";
  using CommandHandler = std::function<void(const swashplate_command_t&)>;

  /// `stamp_base`: stamp of simulation time 0 [ns]. `handler` (may be empty: no subscription) runs on the receiving thread.
  /// The ring must outlive the bridge. Throws LcmError when the provider cannot be opened or the channel not subscribed to.
  LcmBridge(const std::string& url, SnapshotRing<Instant>& ring, std::int64_t stamp_base, CommandHandler handler);
  ~LcmBridge();

  /// Steps that missed their deadline so far: a field of every message.
  void setOverrunCounter(std::function<std::uint64_t()> overruns) { overruns_ = std::move(overruns); }

  void start();
  /// Publishes what the ring still holds and ends both threads.
  void stop();

  std::uint64_t published() const { return published_; }
  std::uint64_t failed() const { return failed_; }      // refused by the provider
  std::uint64_t received() const { return received_; }  // commands
  std::uint64_t receiveErrors() const { return receive_errors_; }
  /// What keeps commands from arriving now; empty: nothing. Receiving is tried again all the same.
  std::string problem() const;

 private:
  void send();
  void receive();
  static void onCommand(const lcm::ReceiveBuffer*, const std::string&, const swashplate_command_t* command, LcmBridge* self);

  const std::string url_;
  lcm::LCM lcm_;
  SnapshotRing<Instant>& ring_;
  std::int64_t stamp_base_;  // [ns]
  CommandHandler handler_;
  std::function<std::uint64_t()> overruns_ = [] { return std::uint64_t{0}; };
  std::thread sender_, receiver_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> receive_failing_{false};
  std::atomic<std::uint64_t> published_{0}, failed_{0}, received_{0}, receive_errors_{0};
};

extern template class LcmBridge<RotorInstant>;
extern template class LcmBridge<ShaftInstant>;

}  // namespace heerk_rotor
