// A byte buffer for saved states. One function of an object both writes it and reads it:
//   void archive(Archive &a) { a(x); a(list); }
#pragma once
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace jam::inside {

class Archive {
 public:
  Archive() = default;  // to write
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reading_(true) {}
  bool reading() const { return reading_; }
  const std::string &bytes() const { return bytes_; }

  template <class T>
  void operator()(T &x) {
    static_assert(std::is_trivially_copyable<T>::value, "only plain data");
    raw(&x, sizeof x);
  }
  void operator()(bool &x) {
    uint8_t byte = x;
    raw(&byte, sizeof byte);
    check(byte <= 1);
    x = byte == 1;
  }
  template <class T>
  void operator()(std::vector<T> &v) {
    uint64_t count = v.size();
    raw(&count, sizeof count);
    if (reading_) {
      check(count <= (bytes_.size() - at_) / sizeof(T));
      v.resize(count);
    }
    if (count) raw(v.data(), count * sizeof(T));
  }
  // A struct that begins with its size, also a shorter one of an earlier version: what it lacks is not known.
  template <class T>
  void sized(T &x) {
    static_assert(std::is_trivially_copyable<T>::value, "only plain data");
    uint32_t size = sizeof x;
    raw(&size, sizeof size);
    check(size >= sizeof size && size <= sizeof x && size % alignof(T) == 0);
    if (reading_) std::memset(static_cast<void *>(&x), 0xff, sizeof x);
    x.struct_size = sizeof x;
    raw(reinterpret_cast<char *>(&x) + sizeof size, size - sizeof size);
  }
  // The bytes may come from a damaged file, so every length is checked before it is used.
  static void check(bool good) {
    if (!good) fail(JAM_E_FORMAT, "the stage kept in the checkpoint does not make sense");
  }
  bool more() const { return reading_ && at_ < bytes_.size(); }
  void end() const { check(!more()); }

 private:
  void raw(void *x, size_t size) {
    if (!reading_) {
      bytes_.append(static_cast<const char *>(x), size);
      return;
    }
    check(size <= bytes_.size() - at_);
    std::memcpy(x, bytes_.data() + at_, size);
    at_ += size;
  }
  std::string bytes_;
  size_t at_ = 0;
  bool reading_ = false;
};

}  // namespace jam::inside
