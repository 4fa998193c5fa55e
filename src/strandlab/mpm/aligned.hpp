#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>

namespace strandlab::mpm {

// Array of doubles on a cache-line boundary, so that a node record is one cache line.
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) { resize(size); }
  void resize(std::size_t size) {  // contents are lost; all zero afterwards
    if (size > capacity_) {
      capacity_ = (size + 7) / 8 * 8;
      data_.reset(static_cast<double*>(std::aligned_alloc(64, capacity_ * sizeof(double))));
      if (!data_) throw std::bad_alloc();
    }
    size_ = size;
    std::fill_n(data_.get(), size_, 0.0);
  }
  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return capacity_ * sizeof(double); }
  double& operator[](std::size_t i) { return data_.get()[i]; }
  double operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace strandlab::mpm
