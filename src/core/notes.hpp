// What a call changed or assumed of what it was given, in sentences for its user: jam_notes and the log.
#pragma once
#include <cstdarg>
#include <cstdio>
#include <string>
#include <utility>

namespace jam::inside {

// Lines of text. Those of warnings begin with `warning`.
class Notes {
 public:
  static constexpr const char *warning = "warning: ";
  Notes() = default;
  explicit Notes(std::string text) : text_(std::move(text)) {}
  __attribute__((format(printf, 2, 3))) void say(const char *format, ...) {
    va_list args;
    va_start(args, format);
    add("", format, args);
    va_end(args);
  }
  __attribute__((format(printf, 2, 3))) void warn(const char *format, ...) {
    va_list args;
    va_start(args, format);
    add(warning, format, args);
    va_end(args);
  }
  void append(const Notes &more) {
    if (!text_.empty() && !more.text_.empty()) text_ += '\n';
    text_ += more.text_;
  }
  const std::string &text() const { return text_; }

 private:
  void add(const char *kind, const char *format, va_list args) {
    char line[600];
    std::vsnprintf(line, sizeof line, format, args);
    if (!text_.empty()) text_ += '\n';
    text_ += kind;
    text_ += line;
  }
  std::string text_;
};

}  // namespace jam::inside
