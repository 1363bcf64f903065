#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>

namespace ifov::radiometry {

/// Rows of spectra as plain columns of floats: row r holds one value per column (a node or a channel), padded to
/// 64-byte multiples and aligned, so that loops over a row vectorise. Padding is zero.
class SpectrumBlock {
 public:
  SpectrumBlock() = default;
  SpectrumBlock(std::size_t rows, std::size_t columns) { resize(rows, columns); }

  void resize(std::size_t rows, std::size_t columns) {
    reshape(rows, columns);
    for (std::size_t i = 0; i < rows_ * stride_; ++i) data_.get()[i] = 0.0f;
  }

  /// The same with whatever the memory held, for rows that are about to be written whole.
  void reshape(std::size_t rows, std::size_t columns) {
    const std::size_t stride = (columns + 15) / 16 * 16;
    if (rows * stride > capacity_) {
      data_.reset(static_cast<float*>(std::aligned_alloc(64, rows * stride * sizeof(float))));
      if (!data_) throw std::bad_alloc();
      capacity_ = rows * stride;
    }
    rows_ = rows;
    columns_ = columns;
    stride_ = stride;
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t stride() const { return stride_; }
  float* row(std::size_t r) { return data_.get() + r * stride_; }
  const float* row(std::size_t r) const { return data_.get() + r * stride_; }
  std::span<float> values(std::size_t r) { return {row(r), columns_}; }
  std::span<const float> values(std::size_t r) const { return {row(r), columns_}; }

 private:
  struct Free {
    void operator()(float* p) const { std::free(p); }
  };
  std::unique_ptr<float, Free> data_;
  std::size_t capacity_ = 0, rows_ = 0, columns_ = 0, stride_ = 0;
};

}  // namespace ifov::radiometry
