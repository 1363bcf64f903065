#include "session/told_tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "sampling/tile.h"

namespace ifov::session {

namespace {

/// The leading bits of a float from 0 to 1 order it as the float does.
constexpr int kDropped = 12;
std::size_t step_of(float fraction) {
  return std::bit_cast<std::uint32_t>(std::clamp(fraction, 0.0f, 1.0f)) >> kDropped;
}
double fraction_of(std::size_t step) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(step) << kDropped);
}

}  // namespace

DetectionTally::DetectionTally(render::TileSink& next) : next_(next), pixels_(step_of(1.0f) + 1, 0) {}

void DetectionTally::write(const sampling::TileResult& tile) {
  {
    const std::scoped_lock lock(mutex_);
    for (const float fraction : tile.missable_fraction) ++pixels_[step_of(fraction)];
    count_ += tile.missable_fraction.size();
  }
  next_.write(tile);
}

std::string DetectionTally::statement() const {
  if (count_ == 0) return {};
  std::size_t middle = 0, last = pixels_.size() - 1;
  for (std::uint64_t below = pixels_[0]; below <= count_ / 2; below += pixels_[middle]) ++middle;
  while (pixels_[last] == 0) --last;
  return format(
      "A compact feature that covers {:.2g} % of a pixel or more was found with a probability of at least 95 % in half "
      "of the pixels; in the least sampled pixel that holds from {:.2g} % on.",
      100.0 * fraction_of(middle), 100.0 * fraction_of(last));
}

void OneValue::write(const sampling::TileResult& tile) {
  {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::scoped_lock lock(mutex_);
    const auto columns = static_cast<std::size_t>(tile.columns);
    least_.resize(columns, kInfinity), most_.resize(columns, -kInfinity);
    for (std::size_t k = 0; k < tile.mean.size(); ++k) {
      const float value = tile.mean[k];
      if (!std::isfinite(value)) continue;
      least_[k % columns] = std::min(least_[k % columns], value);
      most_[k % columns] = std::max(most_[k % columns], value);
      pixels_ += k % columns == 0;
    }
  }
  next_.write(tile);
}

bool OneValue::holds() const {
  constexpr float kRounding = 1e-5f;
  if (pixels_ < 2) return false;
  for (std::size_t c = 0; c < least_.size(); ++c)
    if (most_[c] - least_[c] > kRounding * std::max(std::abs(least_[c]), std::abs(most_[c]))) return false;
  return true;
}

}  // namespace ifov::session
