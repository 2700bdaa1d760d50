#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/lcm/lcm_log_packer.hpp"

namespace heerk_rotor {

/// Writes every instant of a ring into an LCM event log (LcmLogPacker says as what), on a thread of its own. Event time is the
/// message's stamp in microseconds. The ring is looked at every few milliseconds, so that the step thread need not wake anybody. Whatever keeps the file from being complete - a gap because the ring was full, a full
/// disk, a write error - is a problem that the node reports and ends with.
template <class Instant>
class LcmLogRecorder {
 public:
  /// Recording ends while this much is left on the disk [bytes].
  static constexpr std::uint64_t kReserve = 16 * 1024 * 1024;

  /// `stamp_base`: stamp of simulation time 0 [ns]; `expected_instants`: how many will come, for the check of the disk.
  /// Throws std::runtime_error when the file cannot be written or the disk has no room for that many.
  LcmLogRecorder(const std::string& file, SnapshotRing<Instant>& ring, std::int64_t stamp_base, double expected_instants);
  ~LcmLogRecorder();

  /// Steps that missed their deadline so far: a field of every message.
  void setOverrunCounter(std::function<std::uint64_t()> overruns) { overruns_ = std::move(overruns); }

  void start();
  /// Writes what the ring still holds, closes the file and ends the thread.
  void stop();

  const std::string& file() const { return file_; }
  /// Instants given to the log; the last of them may be in a batch that is not full yet.
  std::uint64_t written() const { return written_; }
  /// What keeps the file from being complete; empty: nothing so far.
  std::string problem() const;

 private:
  void record();
  bool write(const Instant& instant);
  bool writeEvent(const LcmPackedEvent& event);
  void settle();
  bool spaceLeft() const;
  void close();
  void setProblem(const std::string& text);

  std::string file_;
  SnapshotRing<Instant>& ring_;
  std::int64_t stamp_base_;  // [ns]
  std::function<std::uint64_t()> overruns_ = [] { return std::uint64_t{0}; };
  std::unique_ptr<lcm::LogFile> log_;
  LcmLogPacker<Instant> packer_{1};
  const LcmEventWriter write_event_ = [this](const LcmPackedEvent& event) { return writeEvent(event); };
  std::uint64_t events_ = 0, last_step_ = 0;
  bool complete_ = true;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> written_{0};
  mutable std::mutex problem_mutex_;
  std::string problem_;  // guarded by problem_mutex_
};

extern template class LcmLogRecorder<RotorInstant>;
extern template class LcmLogRecorder<ShaftInstant>;

}  // namespace heerk_rotor
