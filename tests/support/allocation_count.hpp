// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Counts what operator new gives out, by replacing it in the whole program: include this in exactly
// one source of an executable.
namespace plekton::test {

inline std::atomic<std::size_t> allocation_count = 0;

/// How many allocations of any thread a piece of work makes.
template <class Work>
std::size_t allocations_of(const Work& work) {
  const std::size_t before = allocation_count;
  work();
  return allocation_count - before;
}

}  // namespace plekton::test

// Not inlined, lest the compiler see std::free and take it for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++plekton::test::allocation_count;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new[](std::size_t size) {
  return operator new(size);
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
