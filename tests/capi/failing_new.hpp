// Allocations that fail on purpose. The replacement reaches the shared library too: it takes its operator new from the
// program. Included by one file of a program.
#pragma once
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> until_failure{
    -1};  // allocations that still succeed; -1: all, -2: the one that `once` asks for is past
std::atomic<long> alive{0};
std::atomic<std::size_t> largest{0};  // bytes asked for at once
bool once = false;                    // a single allocation fails, else all from there on

bool fails() {
  if (until_failure < 0) return false;
  if (until_failure == 0) {
    if (once) until_failure = -2;
    return true;
  }
  --until_failure;
  return false;
}
[[maybe_unused]] bool has_failed() { return until_failure == 0 || until_failure == -2; }

}  // namespace

[[gnu::noinline]] void *operator new(std::size_t size) {
  if (size > largest) largest = size;
  void *p = fails() ? nullptr : std::malloc(size ? size : 1);
  if (!p) throw std::bad_alloc();
  ++alive;
  return p;
}
[[gnu::noinline]] void *operator new(std::size_t size,
                                     const std::nothrow_t &) noexcept {  // stable_sort asks so, and does without
  void *p = fails() ? nullptr : std::malloc(size ? size : 1);
  alive += p ? 1 : 0;
  return p;
}
[[gnu::noinline]] void operator delete(void *p) noexcept {
  if (p) --alive;
  std::free(p);
}
[[gnu::noinline]] void operator delete(void *p, const std::nothrow_t &) noexcept { operator delete(p); }
[[gnu::noinline]] void operator delete(void *p, std::size_t) noexcept { operator delete(p); }
