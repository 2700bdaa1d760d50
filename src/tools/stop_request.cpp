#include "heerk_rotor/tools/stop_request.hpp"

#include <array>

#include <signal.h>

namespace heerk_rotor {
namespace {

volatile sig_atomic_t received = 0;
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

int StopRequest::signal() noexcept { return received; }

}  // namespace heerk_rotor
