#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "heerk_rotor/realtime/wake_up.hpp"

namespace heerk_rotor {

/// What is known of a ring whatever it carries. Any thread may ask.
class RingGauge {
 public:
  /// Values that wait for the reader (a moment ago).
  std::size_t size() const noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_acquire);  // first: head never falls behind it
    return static_cast<std::size_t>(head_.load(std::memory_order_acquire) - tail);
  }

  /// Values lost because the ring was full.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 protected:
  ~RingGauge() = default;
  alignas(64) std::atomic<std::uint64_t> head_{0};  // written by the producer
  std::atomic<std::uint64_t> dropped_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};  // written by the reader
};

/// A queue from one producing thread (the step thread) to one reading thread, without locks. When it is full,
///  - push() drops the new value and counts it: the producer never waits for a slow reader;
///  - pushWaiting() waits for space: for recorders in runs that are as fast as possible.
/// The reader gets the values in the order they were pushed.
template <class T>
class SnapshotRing : public RingGauge {
  static_assert(std::is_trivially_copyable<T>::value, "a value must be copied without running code");

 public:
  /// `capacity` values at least (rounded up to a power of two); all memory is allocated and touched here.
  explicit SnapshotRing(std::size_t capacity) : mask_(roundUp(capacity) - 1), values_(new T[mask_ + 1]()) {}

  std::size_t capacity() const noexcept { return mask_ + 1; }

  /// Producer side. False: the ring was full, the value is lost and counted.
  bool push(const T& value) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (!hasSpace(head)) {
      dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return false;
    }
    values_[head & mask_] = value;
    head_.store(head + 1, std::memory_order_release);
    filled_.notify();
    return true;
  }

  /// Producer side: waits until the reader has made space. False (value dropped and counted): `stop` became true first.
  bool pushWaiting(const T& value, const std::atomic<bool>& stop) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    while (!hasSpace(head) && !stop.load(std::memory_order_relaxed)) {
      // `stop` may be raised by somebody who does not know this ring, hence the limit.
      emptied_.waitUntil([&] { return hasSpace(head); }, std::chrono::milliseconds(20));
    }
    return push(value);
  }

  /// Reader side. False: nothing there.
  bool pop(T& value) noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    value = values_[tail & mask_];
    tail_.store(tail + 1, std::memory_order_release);
    emptied_.notify();
    return true;
  }

  /// Reader side: like pop(), but waits up to `timeout` for a value.
  bool popWaiting(T& value, std::chrono::nanoseconds timeout) noexcept {
    filled_.waitUntil([this] { return size() > 0; }, timeout);
    return pop(value);
  }

 private:
  static std::size_t roundUp(std::size_t n) {
    std::size_t power = 2;
    while (power < n) power *= 2;
    return power;
  }
  bool hasSpace(std::uint64_t head) const noexcept { return head - tail_.load(std::memory_order_acquire) <= mask_; }

  const std::size_t mask_;
  const std::unique_ptr<T[]> values_;
  alignas(64) WakeUp filled_;
  WakeUp emptied_;
};

}  // namespace heerk_rotor
