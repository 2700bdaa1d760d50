#pragma once
#include <cstdint>

/// Counts calls of the C heap in this test program (allocation_counter.cpp replaces malloc and its family; operator new
/// and delete arrive there as well).
namespace heerk_rotor::test {

/// False where the heap cannot be replaced (sanitizers bring their own).
bool heapIsCounted();

/// Counts heap calls of its own thread from construction on.
class HeapCalls {
 public:
  HeapCalls();
  ~HeapCalls();
  HeapCalls(const HeapCalls&) = delete;
  HeapCalls& operator=(const HeapCalls&) = delete;
  std::uint64_t count() const;
};

}  // namespace heerk_rotor::test
