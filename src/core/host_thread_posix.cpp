#include <pthread.h>

#include "core/host_thread.hpp"

namespace jam::inside {
namespace {
thread_local const HostThread *current = nullptr;
}

HostThread::HostThread() noexcept : before_(current) {
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &state_);
  current = this;
}

HostThread::~HostThread() {
  current = before_;
  pthread_setcancelstate(state_, nullptr);
}

void HostThread::take_cancellation() {
  const HostThread *call = current;
  while (call && call->before_) call = call->before_;  // inside a callback: what its host had
  if (!call || call->state_ != PTHREAD_CANCEL_ENABLE) return;
  pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, nullptr);
  pthread_testcancel();
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, nullptr);
}

}  // namespace jam::inside
