#include "sampling/image/spread_places.h"

#include <cmath>

#include "sampling/hash.h"
#include "sampling/random.h"

namespace ifov::sampling {

std::vector<Place> spread_places(const PixelRect& image, std::size_t count, std::uint64_t key) {
  constexpr double kX = 0.7548776662466927, kY = 0.5698402909980532;
  std::vector<Place> places;
  if (static_cast<std::size_t>(image.count()) <= count) {
    for (int j = image.y0; j < image.y1; ++j)
      for (int i = image.x0; i < image.x1; ++i) places.push_back({i, j});
    return places;
  }
  const double x0 = unit_double(hash(key, 0)), y0 = unit_double(hash(key, 1));
  for (std::size_t k = 0; k < count; ++k) {
    const double x = std::fmod(x0 + kX * static_cast<double>(k), 1.0),
                 y = std::fmod(y0 + kY * static_cast<double>(k), 1.0);
    places.push_back(
        {image.x0 + static_cast<int>(x * image.width()), image.y0 + static_cast<int>(y * image.height())});
  }
  return places;
}

}  // namespace ifov::sampling
