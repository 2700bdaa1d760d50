#pragma once
#include <string>

namespace heerk_rotor {

/// What the operating system granted to the step thread.
struct RealTimeRights {
  bool fifo = false;           // SCHED_FIFO
  bool memory_locked = false;  // no page of this process is swapped out
  bool fine_timers = false;    // sleeps end within microseconds instead of 50 us late
  std::string complaint;       // what was refused and how to get it; empty when nothing was

  /// "SCHED_FIFO 80, memory locked, fine timers", or what of it is missing.
  std::string text(int priority) const;
};

/// Prepares the calling thread for stepping in real time: SCHED_FIFO with this priority (1..99; 0 leaves the scheduling
/// alone), memory locked, timer slack 1 ns, stack touched. What is not permitted is left out and reported.
RealTimeRights prepareRealTimeThread(int priority);

}  // namespace heerk_rotor
