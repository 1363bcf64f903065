#include "io/product_parts/turned_bands.h"

#include <immintrin.h>

#include <cstring>

namespace ifov::io {
namespace {

constexpr std::size_t kBlock = 8;

#ifdef __AVX__
/// 8 pixels x 8 bands; strides in values.
void turn_block(const float* from, std::size_t from_stride, float* to, std::size_t to_stride) {
  __m256 row[8], pair[8];
  for (std::size_t k = 0; k < 8; ++k) row[k] = _mm256_loadu_ps(from + k * from_stride);
  for (std::size_t k = 0; k < 8; k += 2) {
    pair[k] = _mm256_unpacklo_ps(row[k], row[k + 1]);
    pair[k + 1] = _mm256_unpackhi_ps(row[k], row[k + 1]);
  }
  for (std::size_t k = 0; k < 8; k += 4) {
    row[k] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0x44);
    row[k + 1] = _mm256_shuffle_ps(pair[k], pair[k + 2], 0xee);
    row[k + 2] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0x44);
    row[k + 3] = _mm256_shuffle_ps(pair[k + 1], pair[k + 3], 0xee);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    _mm256_storeu_ps(to + k * to_stride, _mm256_permute2f128_ps(row[k], row[k + 4], 0x20));
    _mm256_storeu_ps(to + (k + 4) * to_stride, _mm256_permute2f128_ps(row[k], row[k + 4], 0x31));
  }
}

#else
void turn_block(const float* from, std::size_t from_stride, float* to, std::size_t to_stride) {
  for (std::size_t band = 0; band < kBlock; ++band)
    for (std::size_t x = 0; x < kBlock; ++x)
      std::memcpy(to + band * to_stride + x, from + x * from_stride + band, sizeof(float));
}
#endif

void turn_one_by_one(const std::byte* from, std::size_t bands, std::byte* to, std::size_t to_stride,
                     std::size_t first_pixel, std::size_t last_pixel, std::size_t first_band,
                     std::size_t last_band) {
  for (std::size_t band = first_band; band < last_band; ++band)
    for (std::size_t x = first_pixel; x < last_pixel; ++x)
      std::memcpy(to + 4 * (band * to_stride + x), from + 4 * (x * bands + band), 4);
}

}  // namespace

void turn_bands(const void* from, std::size_t pixels, std::size_t bands, void* to, std::size_t to_stride,
                std::size_t value_bytes) {
  if (value_bytes != 4) {
    for (std::size_t band = 0; band < bands; ++band)
      for (std::size_t x = 0; x < pixels; ++x)
        std::memcpy(static_cast<std::byte*>(to) + value_bytes * (band * to_stride + x),
                    static_cast<const std::byte*>(from) + value_bytes * (x * bands + band), value_bytes);
    return;
  }
  const std::size_t whole_pixels = pixels / kBlock * kBlock, whole_bands = bands / kBlock * kBlock;
  // The registers' loads and stores may alias any type: the bits pass unchanged, integers or floats.
  const auto* source = static_cast<const float*>(from);
  auto* target = static_cast<float*>(to);
  for (std::size_t band = 0; band < whole_bands; band += kBlock)
    for (std::size_t x = 0; x < whole_pixels; x += kBlock)
      turn_block(source + x * bands + band, bands, target + band * to_stride + x, to_stride);
  const auto* bytes_from = static_cast<const std::byte*>(from);
  auto* bytes_to = static_cast<std::byte*>(to);
  turn_one_by_one(bytes_from, bands, bytes_to, to_stride, 0, whole_pixels, whole_bands, bands);
  turn_one_by_one(bytes_from, bands, bytes_to, to_stride, whole_pixels, pixels, 0, bands);
}

}  // namespace ifov::io
