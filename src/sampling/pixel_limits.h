#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "sampling/tolerance.h"

namespace ifov::sampling {

/// Light that joins the pixels of a tile when its sampler is done, and is known before it begins: what an error in percent is asked of holds it. [pixel][column] of the first columns of a field.
struct LaterLight {
  std::size_t columns = 0;
  std::vector<float> mean, half_width;

  /// To a pixel's means.
  void join(std::size_t pixel, std::span<double> means) const {
    for (std::size_t c = 0; c < std::min(columns, means.size()); ++c)
      means[c] += static_cast<double>(mean[pixel * columns + c]);
  }
};

/// What a tolerance leaves to the part of pixels that a sampler finds: limits are those of the whole, and what later light is uncertain by is taken from them, down to half. An object serves one
/// thread.
class PixelLimits {
 public:
  /// Keeps references; `later` may be null.
  PixelLimits(const Tolerance& tolerance, const LaterLight* later) : tolerance_(tolerance), later_(later) {}

  bool alike() const { return later_ == nullptr; }  ///< pixels of one mean have one limit
  /// As Tolerance::limits(), of a tile's pixel whose own light has these means.
  void of(std::size_t pixel, std::span<const double> mean, std::span<double> limit) {
    of(pixel, nullptr, 0, mean, limit);
  }
  /// The same of one that holds `count` materials (Tolerance::limits_holding).
  void of(std::size_t pixel, const Abundance* held, std::size_t count, std::span<const double> mean,
          std::span<double> limit) {
    if (later_ == nullptr) return tolerance_.limits_holding(held, count, mean, limit);
    whole_.assign(mean.begin(), mean.end());
    later_->join(pixel, whole_);
    tolerance_.limits_holding(held, count, whole_, limit);
    for (std::size_t c = 0; c < std::min(later_->columns, limit.size()); ++c) {
      const auto taken = static_cast<double>(later_->half_width[pixel * later_->columns + c]);
      if (taken > 0.0 && std::isfinite(limit[c]))
        limit[c] = std::sqrt(std::max(limit[c] * limit[c] - taken * taken, 0.25 * limit[c] * limit[c]));
    }
  }

 private:
  const Tolerance& tolerance_;
  const LaterLight* later_;
  std::vector<double> whole_;
};

}  // namespace ifov::sampling
