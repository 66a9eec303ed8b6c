// Threads of Windows are not cancelled.
#include "core/host_thread.hpp"

namespace jam::inside {

HostThread::HostThread() noexcept = default;
HostThread::~HostThread() = default;
void HostThread::take_cancellation() {}

}  // namespace jam::inside
