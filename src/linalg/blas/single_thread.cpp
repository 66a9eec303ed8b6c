// One thread for OpenBLAS, and memory for its buffers.
#include "linalg/blas.hpp"

#include <dlfcn.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "linalg/tuning.hpp"

extern "C" {
void dgemm_(const char *ta, const char *tb, const int *m, const int *n, const int *k, const double *alpha,
            const double *a, const int *lda, const double *b, const int *ldb, const double *beta, double *c,
            const int *ldc);
// Of OpenBLAS alone; CMake may find another library.
__attribute__((weak)) void openblas_set_num_threads(int count);
__attribute__((weak)) int openblas_get_num_threads(void);
__attribute__((weak)) char *openblas_get_corename(void);
// What each routine of OpenBLAS takes its buffer from. Not in its header, so another build may hide them.
__attribute__((weak)) void *blas_memory_alloc(int);
__attribute__((weak)) void blas_memory_free(void *);
}

namespace jam::inside {
namespace {

struct Host {
  std::mutex lock;
  int guards = 0, threads = 1;
  int computing = 0;  // threads that may be inside OpenBLAS at once
  int buffers = 0;    // that OpenBLAS has
};
Host &host() {
  static Host h;
  return h;
}

const void *library_of(const void *function) {
  Dl_info found;
  return dladdr(function, &found) ? found.dli_fbase : nullptr;
}
// False where another library has, or came first under, the names of BLAS.
bool openblas_answers() {
  static const bool same = openblas_get_corename && openblas_get_num_threads && openblas_set_num_threads &&
                           library_of(reinterpret_cast<const void *>(dgemm_)) ==
                               library_of(reinterpret_cast<const void *>(openblas_get_corename));
  return same;
}
std::string file_of_blas() {
  Dl_info found;
  if (!dladdr(reinterpret_cast<const void *>(dgemm_), &found) || !found.dli_fname) return "unknown";
  const std::unique_ptr<char, void (*)(void *)> path(realpath(found.dli_fname, nullptr), std::free);
  return path ? path.get() : found.dli_fname;
}

// OpenBLAS maps a buffer for each thread that is inside it at once, and keeps it. Where the system has no memory for
// one it asks again and again without end. So buffers are requested here first.
void reserve_buffers(Host &h, int wanted) {
  constexpr size_t size_of_buffer = size_t{128} << 20;  // BUFFER_SIZE of its builds for x86-64, the largest
  if (wanted <= h.buffers || !openblas_answers()) return;
  const size_t size = static_cast<size_t>(wanted - h.buffers) * size_of_buffer;
  void *const probe = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (probe == MAP_FAILED) throw std::bad_alloc();
  munmap(probe, size);
  if (blas_memory_alloc && blas_memory_free) {
    // Others may hold theirs at this moment: never more than BlasTuning::most in all.
    std::vector<void *> taken(static_cast<size_t>(std::min(wanted, BlasTuning::most - h.computing)), nullptr);
    for (void *&buffer : taken) buffer = blas_memory_alloc(0);
    for (void *buffer : taken) blas_memory_free(buffer);
  }
  h.buffers = wanted;
}

int &counted_on_this_thread() {
  static thread_local int threads = 0;
  return threads;
}

}  // namespace

const char *library_kernel() {
  if (openblas_answers()) return openblas_get_corename();
  static const std::string file = file_of_blas();
  return file.c_str();
}

// OpenBLAS ends the process where more threads are inside it than its build allows. So the calls of a process share
// BlasTuning::shared threads; where none is left each call has one, up to BlasTuning::most.
BlasSingleThread::BlasSingleThread(int threads) {
  Host &h = host();
  const std::lock_guard<std::mutex> hold(h.lock);
  const int counted = counted_on_this_thread(), left = std::max(counted > 0 ? 0 : 1, BlasTuning::shared - h.computing);
  const int wanted = std::max(0, threads - counted);
  more_ = openblas_answers() ? std::min(wanted, left) : wanted;
  threads_ = std::min(threads, counted + more_);
  if (openblas_answers() && h.computing + more_ > BlasTuning::most) throw std::bad_alloc();
  reserve_buffers(h, h.computing + more_);
  h.computing += more_;
  counted_on_this_thread() += more_;
  if (h.guards++ > 0 || !openblas_answers()) return;
  h.threads = openblas_get_num_threads();
  if (h.threads != 1) openblas_set_num_threads(1);
}

BlasSingleThread::~BlasSingleThread() {
  Host &h = host();
  const std::lock_guard<std::mutex> hold(h.lock);
  h.computing -= more_;
  counted_on_this_thread() -= more_;
  if (--h.guards == 0 && h.threads != 1) openblas_set_num_threads(h.threads);
}

}  // namespace jam::inside
