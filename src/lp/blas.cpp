#include "lp/blas.hpp"

#include <mutex>

extern "C" {
int openblas_get_num_threads(void);
void openblas_set_num_threads(int n);
}

namespace jam {
namespace {
std::mutex lock;
int inside = 0, host_threads = 1;
}  // namespace

BlasSingleThread::BlasSingleThread() {
  const std::lock_guard<std::mutex> hold(lock);
  if (inside++ == 0) {
    host_threads = openblas_get_num_threads();
    if (host_threads != 1) openblas_set_num_threads(1);
  }
}

BlasSingleThread::~BlasSingleThread() {
  const std::lock_guard<std::mutex> hold(lock);
  if (--inside == 0 && host_threads != 1) openblas_set_num_threads(host_threads);
}

}  // namespace jam
