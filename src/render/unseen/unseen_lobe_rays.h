#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "math/ray.h"
#include "render/unseen/unseen_lobes.h"
#include "sampling/pixel_rect.h"
#include "scene/resolved_surface.h"

/// What UnseenLobes keeps of a tile while it works on it: for its own source alone.
namespace ifov::render {

struct UnseenLobes::Met {
  bool any = false, passes = false;
  double time_s = 0.0;
  math::Point3 at, surface_at;  ///< where rays leave from, and the surface's own
  math::Vec3 outgoing, outward, onward;
  math::Normal3 normal;
  scene::ResolvedSurface surface{};
  double mirrored = 0.0, narrow = 0.0,
         spread = 0.0;      ///< of light, at most: by mirrors, narrow lobes, and all else
  double slope = 0.0;       ///< the least of the narrow lobes
  double brightness = 1.0;  ///< what is left on the way to the sensor, at most
  std::uint64_t way = 0;    ///< equal for rays that met the same things in turn
};

struct UnseenLobes::Rays {
  std::vector<math::Ray> rays;
  std::vector<std::size_t> places;
};

struct UnseenLobes::Told {
  Told(std::size_t pixels, std::size_t channel_count)
      : channels(channel_count),
        highlights(pixels * channels, 0.0),
        thrown_wide(highlights),
        thrown_flat(highlights),
        moving_wide(highlights),
        moving_flat(highlights),
        paths(pixels, 0.0),
        first_moment(pixels, 0.0),
        second_moment(pixels, 0.0),
        unknown(pixels, 0) {}
  void add(std::vector<double>& what, std::size_t pixel, double share,
           std::span<const double> radiance) const {
    for (std::size_t c = 0; c < channels; ++c) what[pixel * channels + c] += share * radiance[c];
  }
  std::size_t channels;
  std::vector<double> highlights, thrown_wide,
      thrown_flat;  ///< the latter by lobes as wide as finds what bends, what is flat
  std::vector<double> moving_wide, moving_flat;  ///< the same of what moves, which no few paths tell of
  std::vector<double> paths;                     ///< of a pixel, so far
  /// By pixel: mean and mean square of what a scattered path of it finds of thrown light, over the usual radiance.
  std::vector<double> first_moment, second_moment;
  std::vector<char> unknown;  ///< by pixel: not all that shines is known
};

struct UnseenLobes::Grid {
  static constexpr int kAcross = 3;
  sampling::PixelRect tile;
  int width, height;
  double of_time;  ///< of the exposure that its rays stand for
  int columns() const { return kAcross * width + 1; }
  int rows() const { return kAcross * height + 1; }
  std::size_t place(int i, int j) const { return static_cast<std::size_t>(j * columns() + i); }
  std::size_t pixel(int i, int j) const {
    return static_cast<std::size_t>((j / kAcross) * width + i / kAcross);
  }
  /// The same in every division into tiles.
  std::uint64_t name(int i, int j) const {
    return (static_cast<std::uint64_t>(kAcross * tile.x0 + i) << 32) |
           static_cast<std::uint64_t>(kAcross * tile.y0 + j);
  }
  const Met* at(const std::vector<Met>& level, int i, int j) const {
    return i < 0 || j < 0 || i >= columns() || j >= rows() ? nullptr : &level[place(i, j)];
  }
};

}  // namespace ifov::render
