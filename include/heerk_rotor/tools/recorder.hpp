#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// The steps to record: the first one and every N-th after it.
struct RecordGrid {
  std::uint64_t first = 0;  // step number the run starts at
  std::uint64_t every = 1;
  bool contains(std::uint64_t step) const noexcept { return (step - first) % every == 0; }
};

/// A file that cannot be opened or was not written completely; what() names the file and the reason.
struct RecordError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that a simulation is recorded to. Recording is lossless: the simulation waits for the writing. After the first
/// write error nothing more is recorded, failed() becomes true (the step loop then stops) and close() throws the reason.
class Recorder : public Observer {
 public:
  Recorder(std::string file, RecordGrid grid) : file_(std::move(file)), grid_(grid) {}
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  const std::string& file() const { return file_; }
  bool wants(std::uint64_t step) const noexcept final { return !closed_ && error_.empty() && grid_.contains(step); }
  bool failed() const noexcept { return !error_.empty(); }

  /// Completes the file; afterwards nothing more is recorded. Throws RecordError when anything recorded did not get there.
  void close() {
    if (closed_) return;
    closed_ = true;
    try {
      finish();
    } catch (const std::exception& exception) {
      fail(exception.what());
    }
    if (failed()) throw RecordError(file_ + ": " + error_);
  }

 protected:
  /// Brings what is still buffered to the file and closes it. May throw or call fail(); runs once, also after fail().
  virtual void finish() = 0;

  /// Remembers the first reason for which recording ended.
  void fail(const std::string& reason) {
    if (error_.empty()) error_ = reason;
  }

 private:
  std::string file_;
  RecordGrid grid_;
  std::string error_;
  bool closed_ = false;
};

}  // namespace heerk_rotor
