#include <unistd.h>

#include "core/call_scope.hpp"

namespace jam::inside {

double default_memory_limit() {
  return 0.5 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace jam::inside
