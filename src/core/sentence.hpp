// Text by printf's rules, of any length.
#pragma once
#include <string>

namespace jam::inside {

__attribute__((format(printf, 1, 2))) std::string sentence(const char *format, ...);

}  // namespace jam::inside
