#include "core/sentence.hpp"

#include <cstdarg>
#include <cstdio>

namespace jam::inside {

std::string sentence(const char *format, ...) {
  va_list args, again;
  va_start(args, format);
  va_copy(again, args);
  std::string text(static_cast<size_t>(std::vsnprintf(nullptr, 0, format, args)), '\0');
  va_end(args);
  std::vsnprintf(&text[0], text.size() + 1, format, again);
  va_end(again);
  return text;
}

}  // namespace jam::inside
