#include "sampling/accuracy/like_neighbours.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/contradictions.h"
#include "sampling/accuracy/edges/edge_tracer.h"
#include "sampling/accuracy/radiance/lattice_values.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kBetweenKey = 0x6265747765656e;

}  // namespace

/// The sides of the lattice whose ends have unlike labels that look alike, or `of_all` labels; those of two labels in a
/// pixel follow each other, by chance.
std::vector<LikeNeighbours::Meeting> LikeNeighbours::meetings(const std::vector<std::uint8_t>& worth,
                                                              bool of_all) const {
  const Lattice& lattice = tracer_.lattice();
  const std::vector<std::uint32_t>& own = values_.own.empty() ? values_.labels : values_.own;
  const int columns = lattice.columns(), rows = lattice.rows();
  const std::size_t row = static_cast<std::size_t>(columns) + 1;
  std::vector<Meeting> found;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      for (const bool vertical : {false, true}) {
        if (vertical ? j == rows : i == columns) continue;
        const std::size_t a = static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i),
                          b = a + (vertical ? row : 1);
        if (own[a] == own[b]) continue;
        const std::int32_t x = i * Lattice::side(0), y = j * Lattice::side(0);
        const FocalPoint from = lattice.point(x, y);
        const FocalPoint to =
            lattice.point(x + (vertical ? 0 : Lattice::side(0)), y + (vertical ? Lattice::side(0) : 0));
        const int pixel = lattice.pixel_at({0.5 * (from.x_px + to.x_px), 0.5 * (from.y_px + to.y_px)});
        if (!worth[pixel] || tracer_.pixels().abandoned(static_cast<std::uint32_t>(pixel))) continue;
        if (!of_all && tracer_.contradictions().matters(static_cast<std::uint32_t>(pixel), values_.labels[a],
                                                        values_.labels[b]))
          continue;
        found.push_back({pixel,
                         std::min(own[a], own[b]),
                         std::max(own[a], own[b]),
                         hash(seed_, kBetweenKey, lattice.image_x(x), lattice.image_y(y), vertical),
                         {from, to, table_.label(own[a]), table_.label(own[b]), values_.labels[a]}});
      }
  std::sort(found.begin(), found.end(), [](const Meeting& a, const Meeting& b) {
    return std::tie(a.pixel, a.low, a.high, a.key) < std::tie(b.pixel, b.low, b.high, b.key);
  });
  return found;
}

bool LikeNeighbours::same_labels(const Meeting& a, const Meeting& b) {
  return std::tie(a.pixel, a.low, a.high) == std::tie(b.pixel, b.low, b.high);
}

Prober::Finds LikeNeighbours::gaps_in(const std::vector<std::uint8_t>& pixels) {
  const std::vector<Meeting> all = meetings(pixels, true);
  std::vector<Prober::Between> sides;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i == 0 || !same_labels(all[i], all[i - 1])) sides.push_back(all[i].side);
  return prober_.look_between(std::move(sides));
}

void LikeNeighbours::probe_between(const std::vector<std::uint8_t>& worth) {
  std::vector<Meeting> left = meetings(worth, false);
  std::vector<std::uint8_t> due(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) due[i] = i == 0 || !same_labels(left[i], left[i - 1]);
  const Lattice& lattice = tracer_.lattice();
  const PixelRect& d = lattice.domain();
  std::vector<std::uint8_t> around(worth.size(), 0);
  for (;;) {
    std::vector<Prober::Between> sides;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (due[i])
        sides.push_back(left[i].side);
      else
        left[kept++] = left[i];
    }
    left.resize(kept);
    if (sides.empty()) return;
    for (const FocalPoint point : prober_.probe_between(std::move(sides))) {
      const int pixel = lattice.pixel_at(point), x = pixel % d.width(), y = pixel / d.width();
      for (int j = std::max(0, y - 1); j <= std::min(d.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(d.width() - 1, x + 1); ++i)
          around[j * d.width() + i] = 1;
    }
    due.resize(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) due[i] = around[left[i].pixel];
  }
}

}  // namespace ifov::sampling
