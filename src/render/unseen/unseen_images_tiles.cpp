// What UnseenImages finds in the pixels of a tile.
#include <algorithm>

#include "render/mirrors/sought_instants.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/unseen/widen_unseen.h"
#include "sampling/tile.h"

namespace ifov::render {

void UnseenImages::find_neighbours(std::vector<Leaving>& level, int columns) {
  const int rows = static_cast<int>(level.size()) / columns;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      Leaving& own = level[static_cast<std::size_t>(j * columns + i)];
      if (!own.any) continue;
      const auto take = [&](int axis, int column, int row) {
        if (column < 0 || row < 0 || column >= columns || row >= rows) return;
        const Leaving& other = level[static_cast<std::size_t>(row * columns + column)];
        if (other.any && other.way == own.way) own.beside[axis] = &other;
      };
      take(0, i - 1, j), take(0, i + 1, j);
      take(1, i, j - 1), take(1, i, j + 1);
    }
}

void UnseenImages::settle(const AccuracyTolerance* tolerance, sampling::TileResult& tile) const {
  if (tolerance == nullptr || !tile.has_errors()) return;
  const int width = tile.tile.width(), height = tile.tile.height();
  const int columns = kAcross * width + 1, rows = kAcross * height + 1;
  std::vector<sampling::FocalPoint> points;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      points.push_back(
          {tile.tile.x0 + shift_x_ + (i - 0.5) / kAcross, tile.tile.y0 + shift_y_ + (j - 0.5) / kAcross});
  const std::size_t channels = channels_;
  std::vector<double> unseen(static_cast<std::size_t>(tile.tile.count()) * channels, 0.0);
  ShiningTargets moving(moving_);
  const std::vector<double> times_s = lattice_times_s(camera_);
  const double of_time = 1.0 / static_cast<double>(times_s.size());
  for (const double time_s : times_s) {
    for (sampling::FocalPoint& point : points) point.time_s = time_s;
    std::vector<Lit> lit;
    std::vector<std::vector<Leaving>> levels = follow(points, lit, tile.rays);
    for (std::vector<Leaving>& level : levels) find_neighbours(level, columns);
    // Rays beyond the last column and row belong to other tiles.
    for (const Lit& one : lit) {
      const int i = static_cast<int>(one.ray) % columns / kAcross,
                j = static_cast<int>(one.ray) / columns / kAcross;
      if (i < width && j < height)
        // A bound needs no caution.
        add_thrown(one, of_time / (kAcross * kAcross * kCaution), moving,
                   &unseen[static_cast<std::size_t>(j * width + i) * channels], tile.rays);
    }
    const double cell_px2 = of_time * 0.5 / (kAcross * kAcross);
    for (const std::vector<Leaving>& level : levels)
      for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {
          const auto at = static_cast<std::size_t>(j * columns + i);
          const Leaving *a = &level[at], *b = &level[at + 1],
                        *c = &level[at + static_cast<std::size_t>(columns)], *d = c + 1;
          if (!a->any && !b->any && !c->any && !d->any) continue;
          double* here = &unseen[static_cast<std::size_t>((j / kAcross) * width + i / kAcross) * channels];
          search({a, b, d}, cell_px2, moving, here, tile.rays);
          search({a, d, c}, cell_px2, moving, here, tile.rays);
          if (!complete_)
            tile.set(static_cast<std::size_t>((j / kAcross) * width + i / kAcross),
                     sampling::Reason::unseen_light);
        }
  }
  std::vector<double> more(channels);
  UnseenWidening widening(*tolerance, channels, kNegligible);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto pixel = static_cast<std::size_t>(y * width + x);
      for (std::size_t c = 0; c < channels; ++c) {
        double around = 0.0;
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
          for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i, ++count)
            around += unseen[static_cast<std::size_t>(j * width + i) * channels + c];
        more[c] = kCaution * std::max(unseen[pixel * channels + c], around / count);
      }
      widening.widen(pixel, more, tile);
    }
}

}  // namespace ifov::render
