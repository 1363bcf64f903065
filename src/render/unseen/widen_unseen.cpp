#include "render/unseen/widen_unseen.h"

#include <algorithm>

#include "sampling/pixel_limits.h"

namespace ifov::render {

double mean_about(std::span<const double> values, std::size_t per_pixel, std::size_t c, int x, int y,
                  int width, int height) {
  double sum = 0.0;
  int count = 0;
  for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i, ++count)
      sum += values[static_cast<std::size_t>(j * width + i) * per_pixel + c];
  return sum / count;
}

void UnseenWidening::widen(std::size_t pixel, std::span<const double> more, sampling::TileResult& tile) {
  constexpr float kRounding = 1e-5f;
  if (std::none_of(more.begin(), more.end(), [](double light) { return light > 0.0; })) return;
  const std::size_t first = pixel * static_cast<std::size_t>(tile.columns);
  for (std::size_t c = 0; c < mean_.size(); ++c) mean_[c] = static_cast<double>(tile.mean[first + c]);
  if (later_ != nullptr) later_->join(pixel, mean_);
  tolerance_.asked(mean_, limit_);
  for (std::size_t c = 0; c < mean_.size(); ++c) {
    if (!(more[c] > negligible_ * limit_[c])) continue;
    // That light may be polarized in any way: behind the radiance Q, U and V are as uncertain.
    for (std::size_t component = 0; component < components_; ++component) {
      const std::size_t at = first + component * mean_.size() + c;
      tile.add_bound(at, more[c]);
      const auto ratio = static_cast<float>(tile.joined(at, tolerance_.joint()) / limit_[c]);
      tile.worst_ratio[pixel] = std::max(tile.worst_ratio[pixel], ratio);
      if (ratio > 1.0f + kRounding) tile.set(pixel, sampling::Reason::unseen_light);
    }
  }
}

}  // namespace ifov::render
