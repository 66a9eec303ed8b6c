// Errors inside libjam: one exception type that carries a status and a bounded text.
#pragma once
#include <cstdarg>
#include <cstdio>
#include <exception>
#include <string>

#include "jam/jam.h"

namespace jam::inside {

// Any layer throws it; src/capi turns it into a status. The text is stored inline, so that throwing needs no memory
// beyond the exception object.
class Error : public std::exception {
 public:
  Error(jam_status code, const char *text) noexcept : code_(code) { std::snprintf(text_, sizeof text_, "%s", text); }
  const char *what() const noexcept override { return text_; }
  jam_status code() const noexcept { return code_; }

 private:
  jam_status code_;
  char text_[400];
};

// Throws Error with a printf-style text that should name the value at fault.
[[noreturn]] __attribute__((format(printf, 2, 3))) inline void fail(jam_status code, const char *format, ...) {
  char text[400];
  va_list args;
  va_start(args, format);
  std::vsnprintf(text, sizeof text, format, args);
  va_end(args);
  throw Error(code, text);
}

// Text by printf's rules, of any length.

__attribute__((format(printf, 1, 2))) std::string sentence(const char *format, ...);

// Numbers of bytes in texts.

// Three digits in the unit that fits: "112 kB". Units are powers of 1000.
std::string bytes_text(double bytes);

}  // namespace jam::inside
