#include <windows.h>

#include "core/call_scope.hpp"

namespace jam::inside {

double default_memory_limit() {
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  ::GlobalMemoryStatusEx(&memory);
  return 0.5 * static_cast<double>(memory.ullTotalPhys);
}

}  // namespace jam::inside
