// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/sanitized.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Counts what operator new and malloc give out, by replacing them in the whole program: include
// this in exactly one source of an executable. Eigen takes the room of its matrices from malloc. A
// sanitizer has both of its own, and tells what it gives out; without glibc only operator new is
// counted.
#if defined(PLEKTON_IS_SANITIZED)
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*given)(const volatile void*,
                                                                       std::size_t),
                                                         void (*taken)(const volatile void*));
#define PLEKTON_COUNTS_MALLOC 1
#elif defined(__GLIBC__)
#define PLEKTON_COUNTS_MALLOC 1
extern "C" void* __libc_malloc(std::size_t size);
#else
#define PLEKTON_COUNTS_MALLOC 0
#endif

namespace plekton::test {

inline std::atomic<std::size_t> allocation_count = 0;

/// How many allocations of any thread a piece of work makes.
template <class Work>
std::size_t allocations_of(const Work& work) {
  const std::size_t before = allocation_count;
  work();
  return allocation_count - before;
}

#if defined(PLEKTON_IS_SANITIZED)
/// False where the sanitizer has no room for another hook.
inline const bool hears_of_allocations =
    __sanitizer_install_malloc_and_free_hooks(
        [](const volatile void*, std::size_t) { ++allocation_count; },
        [](const volatile void*) {}) != 0;
#else
inline void* counted_memory(std::size_t size) noexcept {
  ++allocation_count;
#if PLEKTON_COUNTS_MALLOC
  return __libc_malloc(size);
#else
  return std::malloc(size);
#endif
}
#endif

}  // namespace plekton::test

#if !defined(PLEKTON_IS_SANITIZED)

#if PLEKTON_COUNTS_MALLOC
extern "C" [[gnu::noinline]] void* malloc(std::size_t size) noexcept {
  return plekton::test::counted_memory(size);
}
#endif

// Not inlined, lest the compiler see std::free and take it for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* const memory = plekton::test::counted_memory(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new[](std::size_t size) {
  return operator new(size);
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return plekton::test::counted_memory(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return operator new(size, tag);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
