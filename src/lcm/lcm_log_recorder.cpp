#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

#include <sys/statvfs.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace heerk_rotor {
namespace {

/// Between two looks at the ring, which holds a thousand times as much.
constexpr std::chrono::milliseconds kPolling(5);

/// Free bytes on the file system of a file; one that cannot tell is trusted, since write errors are reported anyway.
double freeBytes(const std::string& file) {
  struct statvfs status;
  const std::string folder = std::filesystem::absolute(file).parent_path().string();
  if (::statvfs(folder.c_str(), &status) != 0) return HUGE_VAL;
  return static_cast<double>(status.f_bavail) * static_cast<double>(status.f_frsize);
}

std::string megabytes(double bytes) { return std::to_string(static_cast<long long>(bytes / 1048576.0)) + " MiB"; }

}  // namespace

template <class Instant>
LcmLogRecorder<Instant>::LcmLogRecorder(const std::string& file, SnapshotRing<Instant>& ring, std::int64_t stamp_base, double expected_instants)
    : file_(file), ring_(ring), stamp_base_(stamp_base) {
  const double needed = expected_instants * LcmLogPacker<Instant>::kBytesPerInstant + static_cast<double>(kReserve), present = freeBytes(file);
  if (present < needed)
    throw std::runtime_error("LCM log " + file + ": " + megabytes(present) + " free on the disk, expected at least " + megabytes(needed));
  errno = 0;
  log_ = std::make_unique<lcm::LogFile>(file, "w");
  if (!log_->good()) throw std::runtime_error("LCM log " + file + ": cannot be written (" + std::strerror(errno) + ")");
}

template <class Instant>
LcmLogRecorder<Instant>::~LcmLogRecorder() { stop(); }

template <class Instant>
void LcmLogRecorder<Instant>::start() {
  thread_ = std::thread([this] { record(); });
}

template <class Instant>
void LcmLogRecorder<Instant>::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  close();
}

template <class Instant>
std::string LcmLogRecorder<Instant>::problem() const {
  const std::lock_guard<std::mutex> lock(problem_mutex_);
  if (!problem_.empty()) return "LCM log " + file_ + ": " + problem_;
  if (ring_.dropped() > 0) return "LCM log " + file_ + ": gap, " + std::to_string(ring_.dropped()) + " steps were lost because the disk was too slow";
  return "";
}

template <class Instant>
void LcmLogRecorder<Instant>::setProblem(const std::string& text) {
  const std::lock_guard<std::mutex> lock(problem_mutex_);
  if (problem_.empty()) problem_ = text;
}

template <class Instant>
void LcmLogRecorder<Instant>::record() {
  Instant instant;
  for (;;) {
    const bool last_round = stop_;  // read first: what was pushed before stop() is still written
    bool any = false;
    // After a failure the ring is emptied all the same: a run as fast as possible waits for that.
    for (; ring_.pop(instant); any = true) complete_ = complete_ && write(instant);
    if (!any || last_round) settle();
    if (last_round) return;
    std::this_thread::sleep_for(kPolling);
  }
}

template <class Instant>
bool LcmLogRecorder<Instant>::spaceLeft() const { return events_ % 256 != 0 || freeBytes(file_) >= static_cast<double>(kReserve); }

template <class Instant>
bool LcmLogRecorder<Instant>::write(const Instant& instant) {
  const LcmNote note{lcmStamp(stamp_base_, instant.reading.sim_time), overruns_(), ring_.dropped()};
  if (!packer_.add(instant, note, write_event_)) return false;
  last_step_ = instant.reading.step;
  ++written_;
  return true;
}

template <class Instant>
bool LcmLogRecorder<Instant>::writeEvent(const LcmPackedEvent& packed) {
  if (!spaceLeft()) {
    setProblem("less than " + megabytes(static_cast<double>(kReserve)) + " left on the disk; ended at step " + std::to_string(last_step_));
    return false;
  }
  lcm::LogEvent event;
  event.eventnum = static_cast<std::int64_t>(events_);
  event.timestamp = packed.stamp / 1000;
  event.channel = packed.channel;
  event.datalen = static_cast<std::int32_t>(packed.data.size());
  event.data = const_cast<std::uint8_t*>(packed.data.data());  // which the library only reads
  if (log_->writeEvent(&event) != 0) {
    setProblem(std::string("writing failed (") + std::strerror(errno) + "); ended at step " + std::to_string(last_step_));
    return false;
  }
  ++events_;
  return true;
}

/// Nothing comes any more, for now: what is there is on its way to the disk.
template <class Instant>
void LcmLogRecorder<Instant>::settle() {
  if (!complete_) return;
  complete_ = packer_.flush(write_event_);
  if (std::fflush(log_->getFilePtr()) == 0) return;
  setProblem(std::string("writing failed (") + std::strerror(errno) + ")");
  complete_ = false;
}

template <class Instant>
void LcmLogRecorder<Instant>::close() {
  if (!log_) return;
  // The library closes without looking at the result, so what is still buffered is written here.
  if (std::fflush(log_->getFilePtr()) != 0) setProblem(std::string("writing failed (") + std::strerror(errno) + ")");
  log_.reset();
}

template class LcmLogRecorder<RotorInstant>;
template class LcmLogRecorder<ShaftInstant>;

}  // namespace heerk_rotor
