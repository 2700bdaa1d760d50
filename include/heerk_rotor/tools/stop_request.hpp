#pragma once

namespace heerk_rotor {

/// Turns SIGINT and SIGTERM into a request that the step loop reads between steps, so that files are closed properly.
/// A second signal of the same kind ends the process at once.
class StopRequest {
 public:
  StopRequest();   // installs the handlers
  ~StopRequest();  // puts the previous ones back
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// The signal that asked for the stop, or 0.
  static int signal() noexcept;
};

}  // namespace heerk_rotor
