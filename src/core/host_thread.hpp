// The host may cancel its thread (pthread_cancel) while a call runs. Unwinding from any system call would pass through
// code that must finish, and through catch (...), which ends the process. So a call defers cancellation, and takes it
// where it only waits for the other end of a pipe, which may have no end.
#pragma once

namespace jam::inside {

// One for each call from the host, on its stack.
class HostThread {
 public:
  HostThread() noexcept;
  ~HostThread();
  HostThread(const HostThread &) = delete;
  HostThread &operator=(const HostThread &) = delete;
  // Ends the thread here where its host has cancelled it: what unwinds must pass the guard of the call.
  static void take_cancellation();

 private:
  int state_ = 0;  // of the host
  const HostThread *before_ = nullptr;
};

}  // namespace jam::inside
