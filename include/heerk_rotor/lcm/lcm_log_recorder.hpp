#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/realtime/rotor_instant.hpp"
#include "heerk_rotor/rotor_state_t.hpp"

namespace heerk_rotor {

/// Writes every instant of a ring into an LCM event log, channel ROTOR_STATE, on a thread of its own. Event time is the
/// message's stamp in microseconds. Whatever keeps the file from being complete - a gap because the ring was full, a full
/// disk, a write error - is a problem that the node reports and ends with.
class LcmLogRecorder {
 public:
  /// Bytes of one event with four blades; for the estimate of the space needed.
  static constexpr double kBytesPerEvent = 720.0;
  /// Recording ends while this much is left on the disk [bytes].
  static constexpr std::uint64_t kReserve = 16 * 1024 * 1024;

  /// `stamp_base`: stamp of simulation time 0 [ns]; `expected_events`: how many will come, for the check of the disk.
  /// Throws std::runtime_error when the file cannot be written or the disk has no room for that many.
  LcmLogRecorder(const std::string& file, RotorRing& ring, std::int64_t stamp_base, double expected_events);
  ~LcmLogRecorder();

  /// Steps that missed their deadline so far: a field of every message.
  void setOverrunCounter(std::function<std::uint64_t()> overruns) { overruns_ = std::move(overruns); }

  void start();
  /// Writes what the ring still holds, closes the file and ends the thread.
  void stop();

  const std::string& file() const { return file_; }
  std::uint64_t written() const { return written_; }
  /// What keeps the file from being complete; empty: nothing so far.
  std::string problem() const;

 private:
  void record();
  bool write(const RotorInstant& instant);
  bool spaceLeft() const;
  void close();
  void setProblem(const std::string& text);

  std::string file_;
  RotorRing& ring_;
  std::int64_t stamp_base_;  // [ns]
  std::function<std::uint64_t()> overruns_ = [] { return std::uint64_t{0}; };
  std::unique_ptr<lcm::LogFile> log_;
  rotor_state_t message_;
  std::vector<std::uint8_t> buffer_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> written_{0};
  mutable std::mutex problem_mutex_;
  std::string problem_;  // guarded by problem_mutex_
};

}  // namespace heerk_rotor
