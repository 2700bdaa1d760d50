#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace heerk_rotor {

/// Hands the newest value from one writing thread to one reading thread; older unread values are overwritten. Both sides
/// are wait-free and never see a half-written value (triple buffer: one slot is being written, one is being read, the
/// third changes hands). Several writers must be serialised among themselves, outside.
template <class T>
class LatestValue {
  static_assert(std::is_trivially_copyable<T>::value, "a value must be copied without running code");

 public:
  LatestValue() = default;
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer side.
  void write(const T& value) noexcept {
    slots_[writing_] = value;
    writing_ = middle_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kSlot;
  }

  /// Reader side: copies the newest value and returns true, or returns false and leaves `value` alone when nothing was
  /// written since the last call.
  bool read(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kSlot;
    value = slots_[reading_];
    return true;
  }

 private:
  static constexpr std::uint32_t kSlot = 3, kFresh = 4;
  std::array<T, 3> slots_{};
  alignas(64) std::atomic<std::uint32_t> middle_{1};
  alignas(64) std::uint32_t writing_ = 0;  // touched by the writer only
  alignas(64) std::uint32_t reading_ = 2;  // touched by the reader only
};

}  // namespace heerk_rotor
