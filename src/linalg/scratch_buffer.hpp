// Room for numbers whose old values are not needed.
#pragma once
#include <cstddef>
#include <memory>

namespace jam::inside {

// Doubles, or as many floats in half the room, that are written before they are read. Nothing is cleared, since
// gigabytes take seconds. The old block goes before the new one comes. A new one is an eighth larger than asked, so
// that a list with a few pairs more fits into it. Pages beyond what was requested stay untouched.
class ScratchBuffer {
 public:
  void need(size_t size) {
    if (size <= capacity_) return;
    release();
    memory_.reset(new unsigned char[(size + size / 8) * sizeof(double)]);
    capacity_ = size + size / 8;
  }
  void release() {
    memory_.reset();
    capacity_ = 0;
  }
  template <class Real>
  Real *as() {
    return reinterpret_cast<Real *>(memory_.get());
  }
  template <class Real>
  const Real *as() const {
    return reinterpret_cast<const Real *>(memory_.get());
  }
  size_t capacity() const { return capacity_; }  // in doubles

 private:
  std::unique_ptr<unsigned char[]> memory_;
  size_t capacity_ = 0;
};

}  // namespace jam::inside
