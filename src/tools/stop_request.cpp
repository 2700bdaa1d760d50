#include "heerk_rotor/tools/stop_request.hpp"

#include <array>
#include <atomic>

#include <signal.h>

namespace heerk_rotor {
namespace {

std::atomic<int> received{0};  // read by every thread that steps
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may write it");
constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};
std::array<struct sigaction, 2> previous;

extern "C" void rememberSignal(int number) { received = number; }

}  // namespace

StopRequest::StopRequest() {
  received = 0;
  struct sigaction action = {};
  action.sa_handler = rememberSignal;
  action.sa_flags = SA_RESETHAND | SA_RESTART;  // restart: a write in progress must not fail
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &action, &previous[i]);
}

StopRequest::~StopRequest() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &previous[i], nullptr);
}

int StopRequest::signal() noexcept { return received.load(std::memory_order_relaxed); }

}  // namespace heerk_rotor
