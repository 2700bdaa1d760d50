#include "heerk_rotor/realtime/real_time_loop.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <stdexcept>

namespace heerk_rotor {
namespace {

using std::chrono::milliseconds;

/// Longest sleep without looking at requests [ns]; matters for slow motion only.
constexpr std::int64_t kLongestSleep = 20000000;

double batchPeriod(const RealTimeLoopOptions& options) {
  if (!(options.step > 0.0)) throw std::invalid_argument("RealTimeLoop: step " + std::to_string(options.step) + " s, expected a positive number");
  if (!(options.real_time_factor >= 0.0)) throw std::invalid_argument("RealTimeLoop: real-time factor " + std::to_string(options.real_time_factor) + ", expected 0 or more");
  if (options.steps_per_wake < 1) throw std::invalid_argument("RealTimeLoop: " + std::to_string(options.steps_per_wake) + " steps per wake-up, expected 1 or more");
  if (options.real_time_factor == 0.0) return 1.0;  // not used
  return 1e9 * options.step * options.steps_per_wake / options.real_time_factor;
}

}  // namespace

struct RealTimeLoop::Request {
  const std::function<void()>& action;
  std::exception_ptr exception;
  std::atomic<bool> done{false};
};

RealTimeLoop::RealTimeLoop(StepTask& task, Clock& clock, const RealTimeLoopOptions& options)
    : task_(task), clock_(clock), options_(options), schedule_(batchPeriod(options)) {}

RealTimeLoop::~RealTimeLoop() { stop(); }

RealTimeRights RealTimeLoop::start(bool paused) {
  if (thread_.joinable()) throw std::logic_error("RealTimeLoop: started twice");
  if (paused) {
    mode_ = Mode::kPaused;
    budget_ = 0;
  }
  std::promise<RealTimeRights> prepared;
  std::future<RealTimeRights> rights = prepared.get_future();
  thread_ = std::thread([this, &prepared] {
    prepared.set_value(prepareRealTimeThread(paced() ? options_.priority : 0));
    run();
  });
  return rights.get();
}

void RealTimeLoop::stop() {
  stop_ = true;
  attention_.notify();
  if (thread_.joinable()) thread_.join();
}

void RealTimeLoop::run() noexcept {
  schedule_.restart(clock_.now());
  while (!stop_.load(std::memory_order_relaxed) && mode() != Mode::kFinished) {
    if (request_.load(std::memory_order_relaxed) != nullptr) serveRequest();
    if (!mayStep()) {
      rest();
    } else if (!paced() || waitForRelease()) {
      stepBatch();
    }
  }
  ended_.store(true, std::memory_order_release);
  stepped_.notify();
  answered_.notify();
}

void RealTimeLoop::rest() noexcept {
  // The limit covers a stop() that somebody else's flag stands for; every other event is announced.
  attention_.waitUntil([this] { return stop_ || request_.load() != nullptr || mayStep(); }, milliseconds(100));
  schedule_.restart(clock_.now());
  timing_.forgetBacklog();
}

/// Sleeps until the next batch is due; false: look at requests first, the sleep is not over.
bool RealTimeLoop::waitForRelease() noexcept {
  const std::int64_t now = clock_.now();
  if (const std::int64_t slipped = schedule_.slip(now); slipped > 0) {
    timing_.recordSlip(slipped);
    timing_.forgetBacklog();
  }
  const std::int64_t release = schedule_.release();
  if (release <= now) return true;  // catching up
  clock_.sleepUntil(std::min(release, now + kLongestSleep));
  return release <= now + kLongestSleep;
}

void RealTimeLoop::stepBatch() noexcept {
  const std::int64_t begin = clock_.now();
  std::uint64_t steps = 0;
  while (steps < static_cast<std::uint64_t>(options_.steps_per_wake) && budget_ > 0 && (steps == 0 || task_.ready())) {
    const StepTask::Result result = task_.step();
    if (result == StepTask::Result::kFailed) {
      endStep(result);
      break;
    }
    ++steps;
    if (budget_ != kUnlimited) --budget_;
    endStep(result);
    if (result == StepTask::Result::kFinished) break;
  }
  const std::int64_t finish = clock_.now();
  if (!paced()) {
    timing_.recordUnpaced(steps, begin, finish);
  } else {
    timing_.record(steps, schedule_.release(), begin, finish, schedule_.deadline());
    schedule_.advance();
  }
}

void RealTimeLoop::endStep(StepTask::Result result) noexcept {
  if (result == StepTask::Result::kFinished) {
    mode_.store(Mode::kFinished, std::memory_order_release);
  } else if (result == StepTask::Result::kFailed) {
    mode_before_failure_ = budget_ == kUnlimited ? Mode::kRunning : Mode::kPaused;
    mode_.store(Mode::kFailed, std::memory_order_release);
  } else if (budget_ == 0) {
    mode_.store(Mode::kPaused, std::memory_order_release);
  } else {
    return;
  }
  stepped_.notify();
}

void RealTimeLoop::serveRequest() noexcept {
  Request* request = request_.exchange(nullptr, std::memory_order_acquire);
  try {
    request->action();
  } catch (...) {
    request->exception = std::current_exception();
  }
  request->done.store(true, std::memory_order_release);
  answered_.notify();  // the request may be gone from here on
}

bool RealTimeLoop::call(const std::function<void()>& action) {
  const std::lock_guard<std::mutex> lock(callers_);
  Request request{action, nullptr, {}};
  request_.store(&request, std::memory_order_release);
  attention_.notify();
  const auto done = [&] { return request.done.load(std::memory_order_acquire); };
  while (!answered_.waitUntil([&] { return done() || ended(); }, milliseconds(100))) {
  }
  // The loop has ended: nobody will take the request any more, unless it was taken just before.
  if (!done()) request_.store(nullptr);
  if (request.exception) std::rethrow_exception(request.exception);
  return done();
}

bool RealTimeLoop::pause() {
  return call([this] {
    if (mode() == Mode::kFailed) {
      mode_before_failure_ = Mode::kPaused;
    } else if (mode() == Mode::kRunning) {
      mode_.store(Mode::kPaused, std::memory_order_release);
    }
    budget_ = 0;
    step_interrupted_ = true;
    stepped_.notify();
  });
}

bool RealTimeLoop::unpause() {
  return call([this] {
    budget_ = kUnlimited;
    if (mode() == Mode::kFailed) {
      mode_before_failure_ = Mode::kRunning;
    } else if (mode() == Mode::kPaused) {
      mode_.store(Mode::kRunning, std::memory_order_release);
    }
    step_interrupted_ = true;
    stepped_.notify();
  });
}

bool RealTimeLoop::recover(const std::function<void()>& mend) {
  return call([&] {
    mend();
    if (mode() != Mode::kFailed) return;
    if (mode_before_failure_ == Mode::kPaused) budget_ = 0;
    mode_.store(mode_before_failure_, std::memory_order_release);
  });
}

bool RealTimeLoop::step(std::uint64_t n) {
  const std::lock_guard<std::mutex> lock(steppers_);
  bool started = false;
  const bool alive = call([&] {
    if (mode() != Mode::kPaused || n == 0) return;
    budget_ = n;
    step_interrupted_ = false;
    mode_.store(Mode::kRunning, std::memory_order_release);
    started = true;
  });
  if (!alive || !started) return false;
  while (!stepped_.waitUntil([this] { return ended() || step_interrupted_ || mode() != Mode::kRunning; }, milliseconds(100))) {
  }
  return mode() == Mode::kPaused && !step_interrupted_;
}

}  // namespace heerk_rotor
