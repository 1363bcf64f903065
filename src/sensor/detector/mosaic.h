#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ifov::sensor {

/// Which channel each element of a detector sees: a pattern of filters that repeats, its upper left corner on the first element of
/// the first line.
struct Mosaic {
  int columns = 0, rows = 0;
  std::vector<int> channels;  ///< by place in the pattern, row by row

  int channel_at(int x, int y) const {
    return channels[static_cast<std::size_t>(y % rows) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(x % columns)];
  }
};

/// Lines of elements about a line, for demosaicing: `line(y)` is the raw picture's, of `width` elements; y is within the picture.
/// Values of a channel where its own elements have none are means of those about them, bilinear: they weigh (1 - |dx| / columns)
/// (1 - |dy| / rows). Not a number where there are none.
template <class Line>
void demosaic(const Mosaic& mosaic, int channel, int y, int height, const Line& line, std::span<float> to) {
  const int width = static_cast<int>(to.size());
  for (int x = 0; x < width; ++x) {
    if (mosaic.channel_at(x, y) == channel) {
      to[static_cast<std::size_t>(x)] = line(y)[static_cast<std::size_t>(x)];
      continue;
    }
    double sum = 0.0, weights = 0.0;
    for (int dy = 1 - mosaic.rows; dy < mosaic.rows; ++dy)
      for (int dx = 1 - mosaic.columns; dx < mosaic.columns; ++dx) {
        const int i = x + dx, j = y + dy;
        if (i < 0 || i >= width || j < 0 || j >= height || mosaic.channel_at(i, j) != channel) continue;
        const double weight = (1.0 - static_cast<double>(dx < 0 ? -dx : dx) / mosaic.columns) *
                              (1.0 - static_cast<double>(dy < 0 ? -dy : dy) / mosaic.rows);
        sum += weight * static_cast<double>(line(j)[static_cast<std::size_t>(i)]);
        weights += weight;
      }
    to[static_cast<std::size_t>(x)] = static_cast<float>(sum / weights);
  }
}

}  // namespace ifov::sensor
