#include <cstdio>
#include <map>
#include <vector>

#include "figure_data.h"
#include "sampling/image/like_pixels.h"
#include "sampling/image/pixel_points.h"
#include "sampling/pixel_footprint.h"

namespace ifov::figures {

namespace {

/// Of one pixel with 64 cells, whose path is followed from 16 of them.
void print_points() {
  sampling::PixelPoints points;
  points.add(sampling::PixelFootprint::box(1.0), 0, 0, 3, {8, 8, 16});
  for (std::size_t k = 0; k < points.requests.size(); ++k)
    std::printf("point %d %.6f %.6f\n", static_cast<int>(points.whole[k]), points.requests[k].point.x_px,
                points.requests[k].point.y_px);
}

/// A block of which a slanting border parts two materials; what two of its pixels take from each of the others.
void print_pooling() {
  constexpr int kSide = sampling::LikePixels::kSide, kParts = 64;
  std::vector<sampling::Place> places;
  std::vector<std::map<std::uint32_t, double>> shares;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      int first = 0;
      for (int y = 0; y < kParts; ++y)
        for (int x = 0; x < kParts; ++x)
          first += i + (x + 0.5) / kParts + 0.45 * (j + (y + 0.5) / kParts) < 5.6 ? 1 : 0;
      const double share = static_cast<double>(first) / (kParts * kParts);
      places.push_back({i, j});
      shares.push_back({{0, share}, {1, 1.0 - share}});
    }
  const sampling::LikePixels pixels(places, shares);
  const std::vector<double> nothing(places.size(), 0.0);
  for (const int p : {2 * kSide + 2, 4 * kSide + 3})
    for (std::size_t q = 0; q < places.size(); ++q) {
      std::vector<double> one(places.size(), 0.0);
      one[q] = 1.0;
      std::printf("pooled %d %d %d %.4f %.6f\n", p, places[q].i, places[q].j, shares[q].at(0),
                  pixels.smoothed(one, nothing)[static_cast<std::size_t>(p)]);
    }
}

}  // namespace

void print_image() {
  print_points();
  print_pooling();
}

}  // namespace ifov::figures
