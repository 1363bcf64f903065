#include "math/fft.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace ifov::math {

Fft::Fft(std::size_t length) : length_(length) {
  if (!std::has_single_bit(length))
    throw InputError(
        format("a Fourier transform of length {} was asked for: expected a power of two", length));
  for (std::size_t k = 0; k < length / 2; ++k)
    turns_.push_back(
        std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length)));
}

void Fft::transform(std::span<std::complex<double>> values) const {
  for (std::size_t k = 1, reversed = 0; k < length_; ++k) {
    std::size_t bit = length_ / 2;
    for (; (reversed & bit) != 0; bit /= 2) reversed ^= bit;
    reversed ^= bit;
    if (k < reversed) std::swap(values[k], values[reversed]);
  }
  for (std::size_t half = 1; half < length_; half *= 2)
    for (std::size_t block = 0; block < length_; block += 2 * half)
      for (std::size_t k = 0; k < half; ++k) {
        const std::complex<double> turn = turns_[k * (length_ / (2 * half))];
        std::complex<double>&low = values[block + k], &high = values[block + k + half];
        // Written out: a product of std::complex looks for infinities.
        const std::complex<double> turned(turn.real() * high.real() - turn.imag() * high.imag(),
                                          turn.real() * high.imag() + turn.imag() * high.real());
        high = low - turned;
        low += turned;
      }
}

}  // namespace ifov::math
