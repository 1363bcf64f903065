#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace ifov::math {

/// The discrete Fourier transform of a length that is a power of two (Cooley and Tukey 1965): x_n becomes the sum over k of
/// x_k exp(2 pi i k n / N), without a factor.
class Fft {
 public:
  explicit Fft(std::size_t length);
  std::size_t length() const { return length_; }
  void transform(std::span<std::complex<double>> values) const;

 private:
  std::size_t length_;
  std::vector<std::complex<double>> turns_;  // exp(2 pi i k / N), k < N / 2
};

}  // namespace ifov::math
