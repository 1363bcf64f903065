#include "materials/colour_image.h"

#include <algorithm>
#include <utility>

#include "radiometry/colour/colorimetry.h"

namespace ifov::materials {
namespace {

/// Shares too small for a weight above 0 in single precision are none.
constexpr double kLeastPart = 1e-7;

double level_value(std::size_t level) {
  return radiometry::srgb_decoded(static_cast<double>(level) / (ColourLattice::kLevels - 1));
}

}  // namespace

ColourImage::ColourImage(MapGrid grid, std::vector<std::uint32_t> cells)
    : NumberedMap(grid), cells_(std::move(cells)) {
  check(grid_, cells_.size(), "a picture");
  find_blocks();
}

float ColourImage::number(std::size_t cell) const {
  const std::uint32_t c = cells_[cell];
  return 0.299f * static_cast<float>(c & 0xffu) + 0.587f * static_cast<float>(c >> 8 & 0xffu) +
         0.114f * static_cast<float>(c >> 16 & 0xffu);
}

ColourLattice::ColourLattice(const std::array<double, 3>& factor) {
  std::array<double, kLevels> values{};
  for (std::size_t k = 0; k < kLevels; ++k) values[k] = level_value(k);
  for (std::size_t colour = 0; colour < 3; ++colour)
    for (std::size_t code = 0; code < 256; ++code) {
      const double linear =
          std::clamp(factor[colour] * radiometry::srgb_decoded(static_cast<double>(code) / 255.0), 0.0, 1.0);
      const auto next = std::upper_bound(values.begin() + 1, values.end() - 1, linear);
      const auto low = static_cast<std::size_t>(next - values.begin()) - 1;
      places_[colour][code] = {static_cast<std::uint32_t>(low),
                               (linear - values[low]) / (values[low + 1] - values[low])};
    }
}

std::array<double, 3> ColourLattice::colour(std::uint32_t corner) {
  return {level_value(corner / (kLevels * kLevels)), level_value(corner / kLevels % kLevels),
          level_value(corner % kLevels)};
}

ColourLattice::Mix ColourLattice::mix(std::uint32_t rgba) const {
  struct Step {
    double share;
    std::uint32_t stride;
  };
  const Place &red = places_[0][rgba & 255u], &green = places_[1][rgba >> 8 & 255u],
              &blue = places_[2][rgba >> 16 & 255u];
  std::array<Step, 3> steps{Step{red.above, kLevels * kLevels}, Step{green.above, kLevels},
                            Step{blue.above, 1}};
  if (steps[0].share < steps[1].share) std::swap(steps[0], steps[1]);
  if (steps[1].share < steps[2].share) std::swap(steps[1], steps[2]);
  if (steps[0].share < steps[1].share) std::swap(steps[0], steps[1]);
  auto corner = static_cast<std::uint32_t>((red.level * kLevels + green.level) * kLevels + blue.level);
  Mix mix;
  double above = 1.0;
  for (std::size_t k = 0; k <= 3; ++k) {
    const double next = k < 3 ? steps[k].share : 0.0;
    if (above - next > kLeastPart) mix.parts[mix.count++] = {corner, above - next};
    if (k < 3) corner += steps[k].stride;
    above = next;
  }
  return mix;
}

}  // namespace ifov::materials
