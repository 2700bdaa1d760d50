#pragma once
#include <semaphore.h>

#include <atomic>
#include <chrono>

namespace heerk_rotor {

/// Lets one thread sleep until another one changed something. The notifying side never waits and makes a system call
/// only when the other side really sleeps, so the step thread may use it.
///   reader: wake_up.waitUntil([&] { return !ring.empty(); }, 100ms);     writer: ring.push(v); wake_up.notify();
class WakeUp {
 public:
  WakeUp() { sem_init(&semaphore_, 0, 0); }
  ~WakeUp() { sem_destroy(&semaphore_); }
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  /// Any thread, after the change it announces.
  void notify() noexcept {
    std::atomic_thread_fence(std::memory_order_seq_cst);  // the change is visible before sleeping_ is looked at
    if (sleeping_.load(std::memory_order_relaxed) && sleeping_.exchange(false, std::memory_order_relaxed)) sem_post(&semaphore_);
  }

  /// One thread at a time: sleeps until ready() holds or the time is over; returns the last ready().
  template <class Ready>
  bool waitUntil(Ready ready, std::chrono::nanoseconds timeout) noexcept(noexcept(ready())) {
    if (ready()) return true;
    const timespec end = monotonicIn(timeout);
    for (;;) {
      sleeping_.store(true, std::memory_order_relaxed);
      std::atomic_thread_fence(std::memory_order_seq_cst);  // sleeping_ is visible before the condition is looked at
      if (ready()) break;
      if (!sleep(end)) break;
    }
    sleeping_.store(false, std::memory_order_relaxed);
    return ready();
  }

 private:
  static timespec monotonicIn(std::chrono::nanoseconds timeout) noexcept;
  /// Until a post (true) or the end of time (false).
  bool sleep(const timespec& end) noexcept;

  sem_t semaphore_;
  std::atomic<bool> sleeping_{false};
};

}  // namespace heerk_rotor
