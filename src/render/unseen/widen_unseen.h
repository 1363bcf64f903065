#pragma once

#include <span>
#include <vector>

#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/tile.h"

namespace ifov::render {

/// Mean of the c-th of `per_pixel` values of each pixel over the 3 x 3 about pixel (x, y), as many as there are of a tile of this size.
double mean_about(std::span<const double> values, std::size_t per_pixel, std::size_t c, int x, int y,
                  int width, int height);

/// Widens half-widths of finished pixels by light that may reach them and was not found. An object serves one thread.
class UnseenWidening {
 public:
  /// Less than a share `negligible` of what was asked for is left alone. `later`: light that will join the pixels; null: none.
  /// Keeps references.
  UnseenWidening(const AccuracyTolerance& tolerance, std::size_t channels, double negligible,
                 const sampling::LaterLight* later = nullptr)
      : tolerance_(tolerance),
        negligible_(negligible),
        later_(later),
        components_(tolerance.with_stokes() ? 4 : 1),
        mean_(channels),
        limit_(channels) {}

  /// `more`: by channel, W m-2 sr-1 um-1. A pixel that becomes wider than was asked for gets Reason::unseen_light.
  void widen(std::size_t pixel, std::span<const double> more, sampling::TileResult& tile);

 private:
  const AccuracyTolerance& tolerance_;
  double negligible_;
  const sampling::LaterLight* later_;
  std::size_t components_;  // of light that a tile has of each channel
  std::vector<double> mean_, limit_;
};

}  // namespace ifov::render
