#pragma once

#include <cstddef>

/// Arithmetic over the n values of spectra, which never overlap: one pass over memory for each step of
/// a path.
namespace ifov::transport::spectra {

inline void add_scaled(float* __restrict sum, const float* __restrict a, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * s;
}
inline void add_product(float* __restrict sum, const float* __restrict a, const float* __restrict b,
                        std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * b[i];
}
inline void add_scaled_product(float* __restrict sum, const float* __restrict a, const float* __restrict b,
                               float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * (b[i] * s);
}
inline void add_scaled_product(float* __restrict sum, const float* __restrict a, const float* __restrict b,
                               const float* __restrict c, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] += a[i] * b[i] * (c[i] * s);
}
inline void scaled_product(float* __restrict out, const float* __restrict a, const float* __restrict b,
                           float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * (b[i] * s);
}
inline void sum_of_scaled_product(float* __restrict sum, const float* __restrict first,
                                  const float* __restrict a, const float* __restrict b, float s,
                                  std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) sum[i] = first[i] + a[i] * (b[i] * s);
}
/// Of four spectra.
inline void sum_of_scaled(float* __restrict out, const float* const* spectra, const float* weight,
                          std::size_t n) {
  const float* __restrict a = spectra[0], * __restrict b = spectra[1], * __restrict c = spectra[2], * __restrict d = spectra[3];
  const float p = weight[0], q = weight[1], r = weight[2], s = weight[3];
  for (std::size_t i = 0; i < n; ++i) out[i] = (a[i] * p + b[i] * q) + (c[i] * r + d[i] * s);
}
inline void add_product_of_scaled(float* __restrict sum, const float* __restrict factor,
                                  const float* const* spectra, const float* weight, std::size_t n) {
  const float* __restrict a = spectra[0], * __restrict b = spectra[1], * __restrict c = spectra[2], * __restrict d = spectra[3];
  const float p = weight[0], q = weight[1], r = weight[2], s = weight[3];
  for (std::size_t i = 0; i < n; ++i) sum[i] += factor[i] * ((a[i] * p + b[i] * q) + (c[i] * r + d[i] * s));
}
inline void scale(float* __restrict a, const float* __restrict b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= b[i];
}
inline void scale(float* __restrict a, const float* __restrict b, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] *= b[i] * s;
}
inline void set_product(float* __restrict out, const float* __restrict a, const float* __restrict b,
                        std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * b[i];
}
/// Both at one surface: what its sunlight adds, and the throughput beyond it.
inline void add_and_scale(float* __restrict sum, float* __restrict throughput, const float* __restrict factor,
                          const float* __restrict sun, float sun_weight, float weight, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float passed = throughput[i] * factor[i];
    sum[i] += passed * (sun[i] * sun_weight);
    throughput[i] = passed * weight;
  }
}
inline void set_scaled(float* __restrict out, const float* __restrict a, float s, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = a[i] * s;
}

}  // namespace ifov::transport::spectra
