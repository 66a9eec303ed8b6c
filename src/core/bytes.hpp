// Numbers of bytes in texts.
#pragma once
#include <string>

namespace jam::inside {

// Three digits in the unit that fits: "112 kB". Units are powers of 1000.
std::string bytes_text(double bytes);

}  // namespace jam::inside
