#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "heerk_rotor/lcm/conversions.hpp"
#include "heerk_rotor/shaft_batch_t.hpp"

namespace heerk_rotor {

/// An event of a log, encoded.
struct LcmPackedEvent {
  const char* channel;
  std::int64_t stamp;  // of its first instant [ns]
  std::vector<std::uint8_t> data;
};

/// Takes an event; false: it could not be written.
using LcmEventWriter = std::function<bool(const LcmPackedEvent&)>;

/// Turns instants into log events, in order. A rotor's are events of their own; a shaft's, 100 000 per second, are packed.
///   packer.add(instant, note, write) ..; packer.flush(write);
template <class Instant>
class LcmLogPacker;

template <>
class LcmLogPacker<RotorInstant> {
 public:
  static constexpr double kBytesPerInstant = 720.0;  // with four blades; for the estimate of the space needed
  explicit LcmLogPacker(std::uint64_t /*stride*/) {}
  bool add(const RotorInstant& instant, const LcmNote& note, const LcmEventWriter& write);
  bool flush(const LcmEventWriter&) { return true; }

 private:
  rotor_state_t message_;
  LcmPackedEvent event_{LcmState<RotorInstant>::kChannel, 0, {}};
};

template <>
class LcmLogPacker<ShaftInstant> {
 public:
  static constexpr double kBytesPerInstant = 122.0;  // with two discs
  static constexpr const char* kChannel = "SHAFT_STATE_BATCH";
  static constexpr std::int32_t kMostSteps = 100;

  /// `stride`: step numbers between instants that follow each other.
  explicit LcmLogPacker(std::uint64_t stride) { batch_.stride = static_cast<std::int32_t>(stride); }
  bool add(const ShaftInstant& instant, const LcmNote& note, const LcmEventWriter& write);
  /// Writes the batch begun; the next instant begins another.
  bool flush(const LcmEventWriter& write);

 private:
  bool continues(const ShaftReading& reading) const;
  void begin(const ShaftReading& reading, const LcmNote& note);
  void append(const ShaftReading& reading, const LcmNote& note);

  shaft_batch_t batch_{};
  LcmPackedEvent event_{kChannel, 0, {}};
};

}  // namespace heerk_rotor
