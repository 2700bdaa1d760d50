#include "models/allocation_counter.hpp"

#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define HEERK_COUNT_HEAP 0
#else
#define HEERK_COUNT_HEAP 1
#endif

namespace {
thread_local bool counting = false;
thread_local std::uint64_t calls = 0;
}  // namespace

namespace heerk_rotor::test {

bool heapIsCounted() { return HEERK_COUNT_HEAP != 0; }
HeapCalls::HeapCalls() {
  calls = 0;
  counting = true;
}
HeapCalls::~HeapCalls() { counting = false; }
std::uint64_t HeapCalls::count() const { return calls; }

}  // namespace heerk_rotor::test

#if HEERK_COUNT_HEAP
// glibc's own functions stay reachable under these names; a definition in the program replaces those of the library.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  if (counting) ++calls;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  if (counting) ++calls;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  if (counting) ++calls;
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  if (counting) ++calls;
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  if (counting) ++calls;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  if (counting) ++calls;
  *block = __libc_memalign(alignment, size);
  return *block != nullptr ? 0 : ENOMEM;
}
void free(void* block) {
  if (counting && block != nullptr) ++calls;
  __libc_free(block);
}
}
#endif
