#include "linalg/blas.hpp"

#include <mutex>

extern "C" {
void openblas_set_num_threads(int count);
int openblas_get_num_threads(void);
char *openblas_get_corename(void);
}

namespace jam {
namespace {
struct Host {
  std::mutex lock;
  int guards = 0, threads = 1;
};
Host &host() {
  static Host h;
  return h;
}
}  // namespace

const char *blas_kernel() { return openblas_get_corename(); }

BlasSingleThread::BlasSingleThread() {
  Host &h = host();
  const std::lock_guard<std::mutex> hold(h.lock);
  if (h.guards++ > 0) return;
  h.threads = openblas_get_num_threads();
  if (h.threads != 1) openblas_set_num_threads(1);
}

BlasSingleThread::~BlasSingleThread() {
  Host &h = host();
  const std::lock_guard<std::mutex> hold(h.lock);
  if (--h.guards == 0 && h.threads != 1) openblas_set_num_threads(h.threads);
}

}  // namespace jam
