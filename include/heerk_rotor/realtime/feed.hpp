#pragma once
#include <atomic>

#include "heerk_rotor/integrate/simulation.hpp"
#include "heerk_rotor/realtime/command_source.hpp"

namespace heerk_rotor {

/// Shows instants of the simulation to readers on other threads; what an instant holds is InstantFeed's business. As an
/// observer it runs on the step thread, and so does everything here except where it says so.
class Feed : public Observer {
 public:
  /// Whose command is in effect from the next instant on.
  void setSource(CommandSource source) noexcept { source_.store(source, std::memory_order_relaxed); }
  /// Any thread.
  CommandSource source() const noexcept { return source_.load(std::memory_order_relaxed); }

  /// While set, an instant goes to every reader, also to those that get every n-th step only, but to none twice.
  void setToEveryone(bool everyone) noexcept { to_everyone_ = everyone; }

  /// False: an instant held a number that is not finite; it and all later ones are kept back.
  bool outputsAreFinite() const noexcept { return finite_; }

  /// The state jumps (a reset, a loaded snapshot): no history, and numbers are finite again.
  virtual void startOver() noexcept { finite_ = true; }

 protected:
  bool to_everyone_ = false;
  bool finite_ = true;

 private:
  std::atomic<CommandSource> source_{CommandSource::kNone};
};

}  // namespace heerk_rotor
