#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

#include <sys/statvfs.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "heerk_rotor/lcm/conversions.hpp"
#include "heerk_rotor/lcm/lcm_bridge.hpp"

namespace heerk_rotor {
namespace {

using std::chrono::milliseconds;

/// Free bytes on the file system of a file; one that cannot tell is trusted, since write errors are reported anyway.
double freeBytes(const std::string& file) {
  struct statvfs status;
  const std::string folder = std::filesystem::absolute(file).parent_path().string();
  if (::statvfs(folder.c_str(), &status) != 0) return HUGE_VAL;
  return static_cast<double>(status.f_bavail) * static_cast<double>(status.f_frsize);
}

std::string megabytes(double bytes) { return std::to_string(static_cast<long long>(bytes / 1048576.0)) + " MiB"; }

}  // namespace

LcmLogRecorder::LcmLogRecorder(const std::string& file, RotorRing& ring, std::int64_t stamp_base, double expected_events)
    : file_(file), ring_(ring), stamp_base_(stamp_base) {
  const double needed = expected_events * kBytesPerEvent + static_cast<double>(kReserve), present = freeBytes(file);
  if (present < needed)
    throw std::runtime_error("LCM log " + file + ": " + megabytes(present) + " free on the disk, expected at least " + megabytes(needed));
  errno = 0;
  log_ = std::make_unique<lcm::LogFile>(file, "w");
  if (!log_->good()) throw std::runtime_error("LCM log " + file + ": cannot be written (" + std::strerror(errno) + ")");
}

LcmLogRecorder::~LcmLogRecorder() { stop(); }

void LcmLogRecorder::start() {
  thread_ = std::thread([this] { record(); });
}

void LcmLogRecorder::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  close();
}

std::string LcmLogRecorder::problem() const {
  const std::lock_guard<std::mutex> lock(problem_mutex_);
  if (!problem_.empty()) return "LCM log " + file_ + ": " + problem_;
  if (ring_.dropped() > 0) return "LCM log " + file_ + ": gap, " + std::to_string(ring_.dropped()) + " steps were lost because the disk was too slow";
  return "";
}

void LcmLogRecorder::setProblem(const std::string& text) {
  const std::lock_guard<std::mutex> lock(problem_mutex_);
  if (problem_.empty()) problem_ = text;
}

void LcmLogRecorder::record() {
  RotorInstant instant;
  bool complete = true;
  for (;;) {
    const bool last_round = stop_;  // read first: what was pushed before stop() is still written
    // After a failure the ring is emptied all the same: a run as fast as possible waits for that.
    while (ring_.popWaiting(instant, last_round ? milliseconds(0) : milliseconds(50))) complete = complete && write(instant);
    if (last_round) return;
    if (complete && std::fflush(log_->getFilePtr()) != 0) {  // idle: what is there is on its way to the disk
      setProblem(std::string("writing failed (") + std::strerror(errno) + ")");
      complete = false;
    }
  }
}

bool LcmLogRecorder::spaceLeft() const { return written_ % 256 != 0 || freeBytes(file_) >= static_cast<double>(kReserve); }

bool LcmLogRecorder::write(const RotorInstant& instant) {
  if (!spaceLeft()) {
    setProblem("less than " + megabytes(static_cast<double>(kReserve)) + " left on the disk; ended after step " + std::to_string(message_.step));
    return false;
  }
  const std::int64_t stamp = stamp_base_ + std::llround(instant.reading.sim_time * 1e9);
  toLcmState(instant.reading, stamp, name(instant.source), overruns_(), ring_.dropped(), message_);
  buffer_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
  message_.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
  lcm::LogEvent event;
  event.eventnum = static_cast<std::int64_t>(written_);
  event.timestamp = stamp / 1000;
  event.channel = LcmBridge::kStateChannel;
  event.datalen = static_cast<std::int32_t>(buffer_.size());
  event.data = buffer_.data();
  if (log_->writeEvent(&event) != 0) {
    setProblem(std::string("writing failed (") + std::strerror(errno) + "); ended before step " + std::to_string(message_.step));
    return false;
  }
  ++written_;
  return true;
}

void LcmLogRecorder::close() {
  if (!log_) return;
  // The library closes without looking at the result, so what is still buffered is written here.
  if (std::fflush(log_->getFilePtr()) != 0) setProblem(std::string("writing failed (") + std::strerror(errno) + ")");
  log_.reset();
}

}  // namespace heerk_rotor
