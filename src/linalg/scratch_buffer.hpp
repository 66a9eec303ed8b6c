// Room for numbers whose old values are not needed.
#pragma once
#include <cstddef>
#include <memory>

namespace jam {

// Numbers that are written before they are read. Nothing is cleared, since gigabytes take seconds. The old block goes
// before the new one comes. A new one is an eighth larger than asked, so that a list with a few pairs more fits into
// it. Pages beyond what was asked for stay untouched.
class ScratchBuffer {
 public:
  void need(size_t size) {
    if (size <= capacity_) return;
    memory_.reset();
    capacity_ = 0;
    memory_.reset(new double[size + size / 8]);
    capacity_ = size + size / 8;
  }
  double *data() { return memory_.get(); }
  const double *data() const { return memory_.get(); }
  double &operator[](size_t k) { return memory_[k]; }
  const double &operator[](size_t k) const { return memory_[k]; }
  size_t capacity() const { return capacity_; }

 private:
  std::unique_ptr<double[]> memory_;
  size_t capacity_ = 0;
};

}  // namespace jam
