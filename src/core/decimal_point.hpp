// The decimal point that printf writes is the one of the host's locale, often a comma. Texts of libjam have a point:
// while a call runs, its thread is in the C locale where the host's writes another sign.
#pragma once
#include <locale.h>
#if defined(_WIN32)
#include <cstring>
#else
#include <langinfo.h>
#if defined(__APPLE__)
#include <xlocale.h>
#endif
#endif

namespace jam::inside {

// What the host's thread had. enter() notes it and sets a point, leave() brings it back.
#if defined(_WIN32)
class HostDecimalPoint {
 public:
  void enter() noexcept {
    const char *const name =
        std::strcmp(localeconv()->decimal_point, ".") == 0 ? nullptr : setlocale(LC_NUMERIC, nullptr);
    changed_ = name && std::strlen(name) < sizeof name_;
    if (!changed_) return;
    std::strcpy(name_, name);
    of_thread_ = _configthreadlocale(_ENABLE_PER_THREAD_LOCALE);
    setlocale(LC_NUMERIC, "C");
  }
  void leave() const noexcept {
    if (!changed_) return;
    setlocale(LC_NUMERIC, name_);
    _configthreadlocale(of_thread_);
  }

 private:
  bool changed_ = false;
  int of_thread_ = 0;
  char name_[128];
};
#else
class HostDecimalPoint {
 public:
  void enter() noexcept {
    const char *const point = nl_langinfo(RADIXCHAR);
    if (point[0] == '.' && point[1] == '\0') {
      before_ = nullptr;
      return;
    }
    static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
    before_ = ::uselocale(c_locale);
  }
  void leave() const noexcept {
    if (before_) ::uselocale(before_);
  }

 private:
  locale_t before_ = nullptr;
};
#endif

}  // namespace jam::inside
