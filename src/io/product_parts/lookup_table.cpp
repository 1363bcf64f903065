#include "io/product_parts/lookup_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace ifov::io {
namespace {

struct Place {
  double x = 0.0, y = 0.0;
};

std::optional<Place> place_of(const PixelPlaces& places, int column, int line) {
  const std::size_t k = places.at(column, line);
  if (!std::isfinite(places.x_m[k]) || !std::isfinite(places.y_m[k])) return std::nullopt;
  return Place{places.x_m[k], places.y_m[k]};
}

/// Of neighbours that lie so many columns and lines apart; nothing where there are none.
std::optional<double> median_distance(const PixelPlaces& places, int columns, int lines) {
  std::vector<double> distances;
  for (int line = 0; line + lines < places.height; ++line)
    for (int column = 0; column + columns < places.width; ++column) {
      const auto a = place_of(places, column, line), b = place_of(places, column + columns, line + lines);
      if (a && b) distances.push_back(std::hypot(a->x - b->x, a->y - b->y));
    }
  if (distances.empty()) return std::nullopt;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle > 0.0 ? std::optional(*middle) : std::nullopt;
}

double to_two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

double cell_of(const PixelPlaces& places) {
  const std::optional<double> across = median_distance(places, 1, 0), along = median_distance(places, 0, 1);
  if (across && along) return to_two_digits(std::sqrt(*across * *along));
  return across ? to_two_digits(*across) : along ? to_two_digits(*along) : 1.0;
}

/// Fills a table whose grid is there.
class Filling {
 public:
  Filling(const PixelPlaces& places, LookupTable& table)
      : places_(places),
        table_(table),
        distance_(table.sample.size(), std::numeric_limits<double>::infinity()) {}

  void fill() {
    for (int line = 0; line < places_.height; ++line)
      for (int column = 0; column < places_.width; ++column) put_pixel(column, line);
    for (int line = 0; line + 1 < places_.height; ++line)
      for (int column = 0; column + 1 < places_.width; ++column) fill_between(column, line);
  }

 private:
  struct Corner {
    Place cell;  ///< in cells from the table's corner
    int column = 0, line = 0;
  };

  std::optional<Corner> corner(int column, int line) const {
    const auto place = place_of(places_, column, line);
    if (!place) return std::nullopt;
    return Corner{{(place->x - table_.left_m) / table_.cell_m, (table_.top_m - place->y) / table_.cell_m},
                  column,
                  line};
  }

  std::size_t cell_at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(table_.width) + static_cast<std::size_t>(x);
  }

  static double from_middle(const Corner& of, int x, int y) {
    return std::hypot(of.cell.x - (x + 0.5), of.cell.y - (y + 0.5));
  }

  /// Of pixels of one cell the one nearest to its middle.
  void put_pixel(int column, int line) {
    const auto pixel = corner(column, line);
    if (!pixel) {
      ++table_.pixels_without_place;
      return;
    }
    const int x = std::clamp(static_cast<int>(pixel->cell.x), 0, table_.width - 1),
              y = std::clamp(static_cast<int>(pixel->cell.y), 0, table_.height - 1);
    const std::size_t k = cell_at(x, y);
    const double distance = from_middle(*pixel, x, y);
    if (distance >= distance_[k]) return;
    distance_[k] = distance;
    table_.sample[k] = column + 1, table_.line[k] = line + 1;
  }

  void fill_between(int column, int line) {
    std::array<Corner, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const auto found = corner(column + (k & 1), line + (k >> 1));
      if (!found) return;
      corners[static_cast<std::size_t>(k)] = *found;
    }
    fill_triangle(corners, corners[0], corners[1], corners[2]);
    fill_triangle(corners, corners[1], corners[2], corners[3]);
  }

  /// Cells whose middles lie in a triangle of a square's corners.
  void fill_triangle(const std::array<Corner, 4>& square, const Corner& a, const Corner& b, const Corner& c) {
    const double low = std::min({a.cell.y, b.cell.y, c.cell.y}),
                 high = std::max({a.cell.y, b.cell.y, c.cell.y});
    const int first = std::max(0, static_cast<int>(std::ceil(low - 0.5))),
              last = std::min(table_.height - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int y = first; y <= last; ++y) {
      const double at = y + 0.5;
      double from = std::numeric_limits<double>::infinity(), to = -from;
      for (const auto& [p, q] :
           {std::pair{a.cell, b.cell}, std::pair{b.cell, c.cell}, std::pair{c.cell, a.cell}}) {
        if ((p.y < at && q.y < at) || (p.y > at && q.y > at)) continue;
        const double share = p.y == q.y ? 0.0 : (at - p.y) / (q.y - p.y), x = p.x + share * (q.x - p.x);
        from = std::min(from, x), to = std::max(to, x);
        if (p.y == q.y) from = std::min(from, q.x), to = std::max(to, q.x);
      }
      const int left = std::max(0, static_cast<int>(std::ceil(from - 0.5))),
                right = std::min(table_.width - 1, static_cast<int>(std::floor(to - 0.5)));
      for (int x = left; x <= right; ++x) fill_cell(square, x, y);
    }
  }

  void fill_cell(const std::array<Corner, 4>& square, int x, int y) {
    const std::size_t k = cell_at(x, y);
    if (table_.sample[k] > 0) return;
    for (const Corner& one : square) {
      const double distance = from_middle(one, x, y);
      if (distance >= distance_[k]) continue;
      distance_[k] = distance;
      table_.sample[k] = -(one.column + 1), table_.line[k] = -(one.line + 1);
    }
  }

  const PixelPlaces& places_;
  LookupTable& table_;
  std::vector<double> distance_;  ///< of who has the cell, from its middle, in cells
};

}  // namespace

LookupTable make_lookup_table(const PixelPlaces& places) {
  LookupTable table;
  double left = std::numeric_limits<double>::infinity(), low = left, right = -left, top = -left;
  std::size_t count = 0;
  for (std::size_t k = 0; k < places.x_m.size(); ++k) {
    if (!std::isfinite(places.x_m[k]) || !std::isfinite(places.y_m[k])) continue;
    ++count;
    left = std::min(left, places.x_m[k]), right = std::max(right, places.x_m[k]);
    low = std::min(low, places.y_m[k]), top = std::max(top, places.y_m[k]);
  }
  if (count == 0) {
    table.pixels_without_place = places.x_m.size();
    return table;
  }
  const auto cells = [](double from, double to, double cell) {
    return std::floor(to / cell) - std::floor(from / cell) + 1.0;
  };
  const double most = static_cast<double>(kMostCellsPerPixel) * static_cast<double>(places.x_m.size());
  table.cell_m = cell_of(places);
  while (cells(left, right, table.cell_m) * cells(low, top, table.cell_m) > most) table.cell_m *= 2.0;
  table.width = static_cast<int>(cells(left, right, table.cell_m));
  table.height = static_cast<int>(cells(low, top, table.cell_m));
  table.left_m = table.cell_m * std::floor(left / table.cell_m);
  table.top_m = table.cell_m * (std::floor(top / table.cell_m) + 1.0);
  const auto size = static_cast<std::size_t>(table.width) * static_cast<std::size_t>(table.height);
  table.sample.assign(size, 0), table.line.assign(size, 0);
  Filling(places, table).fill();
  return table;
}

}  // namespace ifov::io
