#include "geometry/height_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/growing_box.h"

namespace ifov::geometry {

using math::Normal3;
using math::Point3;
using math::Vec3;

HeightField::HeightField(TerrainGrid grid, bool smooth) : grid_(std::move(grid)), smooth_(smooth) {
  if (grid_.columns < 2 || grid_.rows < 2)
    throw InputError(
        format("a terrain needs at least 2 x 2 nodes: found {} x {}", grid_.columns, grid_.rows));
  if (!grid_.positions_m.empty())
    throw InputError("a terrain that is traced as a grid must be regular on the map");
  if (triangles() >= kNoIndex)
    throw InputError(format("a terrain of {} x {} heights has too many cells", grid_.columns, grid_.rows));
  const Vec3 x = grid_.along_column_m, y = grid_.along_row_m;
  object_from_field_ = math::Transform::from_columns(x, y, {0.0, 0.0, 1.0}, grid_.corner_m);
  if (!(std::abs(object_from_field_.determinant()) > 0.0))
    throw InputError("the steps of a terrain's grid are parallel");
  field_from_object_ = object_from_field_.inverse();

  blocks_across_ = (grid_.columns - 2) / kBlock + 1;
  blocks_down_ = (grid_.rows - 2) / kBlock + 1;
  ranges_.resize(static_cast<std::size_t>(blocks_across_) * blocks_down_);
  parallel_for(blocks_down_, 0, [&](std::int64_t down) {
    const int top = static_cast<int>(down) * kBlock, bottom = std::min(top + kBlock, grid_.rows - 1);
    for (int across = 0; across < blocks_across_; ++across) {
      const int left = across * kBlock, right = std::min(left + kBlock, grid_.columns - 1);
      Range range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
      for (int row = top; row <= bottom; ++row)
        for (int column = left; column <= right; ++column) {
          const float z = grid_.height_m[grid_.index(column, row)];
          if (!std::isfinite(z)) continue;
          range.low_m = std::min(range.low_m, z);
          range.high_m = std::max(range.high_m, z);
        }
      ranges_[static_cast<std::size_t>(down) * blocks_across_ + across] = range;
    }
  });
  GrowingBox box;
  bool any = false;
  for (std::uint32_t b = 0; b < blocks(); ++b) {
    const World::Bounds part = block_bounds(b);
    if (!(part.low_m.z <= part.high_m.z)) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Point3 p = object_from_field_(Point3{corner & 1 ? part.high_m.x : part.low_m.x,
                                                 corner & 2 ? part.high_m.y : part.low_m.y,
                                                 corner & 4 ? part.high_m.z : part.low_m.z});
      box.include(p, p);
    }
    any = any || std::isfinite(part.low_m.z);
  }
  if (!any) throw InputError("the terrain has no triangle with three known heights");
  bounds_ = box.bounds;
  const int column = grid_.columns / 2, row = grid_.rows / 2;
  const double z = height(column, row);
  middle_ = object_from_field_(Point3{double(column), double(row), 0.0});
  middle_.z = std::isfinite(z) ? z + grid_.corner_m.z : 0.5 * (bounds_.low_m.z + bounds_.high_m.z);
}

World::Bounds HeightField::block_bounds(std::uint32_t block) const {
  const int left = static_cast<int>(block) % blocks_across_ * kBlock,
            top = static_cast<int>(block) / blocks_across_ * kBlock;
  const Range range = ranges_[block];
  return {{double(left), double(top), double(range.low_m)},
          {double(std::min(left + kBlock, grid_.columns - 1)), double(std::min(top + kBlock, grid_.rows - 1)),
           double(range.high_m)}};
}

/// Half 0 lies towards smaller y where the diagonal falls (from the first corner to the opposite one), and at
/// the first corner where it rises.
HeightField::Plane HeightField::plane(int column, int row, int half) const {
  const double h00 = height(column, row), h10 = height(column + 1, row), h01 = height(column, row + 1),
               h11 = height(column + 1, row + 1);
  if (falling(column, row))
    return half == 0 ? Plane{h00, h10 - h00, h11 - h10} : Plane{h00, h11 - h01, h01 - h00};
  return half == 0 ? Plane{h00, h10 - h00, h01 - h00} : Plane{h01 + h10 - h11, h11 - h01, h11 - h10};
}

HeightField::Hit HeightField::meet(std::uint32_t block, Point3 p, Vec3 d, double t_min, double t_max) const {
  const World::Bounds box = block_bounds(block);
  double first = t_min, last = t_max;
  const auto clip = [&](double low, double high, double at, double step) {
    if (step == 0.0) {
      if (at < low || at > high) last = -std::numeric_limits<double>::infinity();
      return;
    }
    const double a = (low - at) / step, b = (high - at) / step;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  // Blocks overlap by more than roundings, so that nothing slips through between them.
  const double slack = 1e-9 * (1.0 + std::abs(box.low_m.z) + std::abs(box.high_m.z)), beside = 1e-9;
  clip(box.low_m.x - beside, box.high_m.x + beside, p.x, d.x);
  clip(box.low_m.y - beside, box.high_m.y + beside, p.y, d.y);
  clip(box.low_m.z - slack, box.high_m.z + slack, p.z, d.z);
  if (!(first < last)) return {};

  const int left = static_cast<int>(box.low_m.x), right = static_cast<int>(box.high_m.x);
  const int top = static_cast<int>(box.low_m.y), bottom = static_cast<int>(box.high_m.y);
  int column = std::clamp(static_cast<int>(std::floor(p.x + first * d.x)), left, right - 1);
  int row = std::clamp(static_cast<int>(std::floor(p.y + first * d.y)), top, bottom - 1);
  const int step_x = d.x > 0.0 ? 1 : -1, step_y = d.y > 0.0 ? 1 : -1;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();

  bool known = false, above = false;  // side of the surface on which the line is
  double from = first;
  while (true) {
    const bool last_column = d.x == 0.0 || column == (step_x > 0 ? right - 1 : left);
    const bool last_row = d.y == 0.0 || row == (step_y > 0 ? bottom - 1 : top);
    const double cross_x = last_column ? kInfinity : (column + (step_x > 0 ? 1 : 0) - p.x) / d.x;
    const double cross_y = last_row ? kInfinity : (row + (step_y > 0 ? 1 : 0) - p.y) / d.y;
    const double to = std::max(from, std::min({cross_x, cross_y, last}));

    // The diagonal splits the way through the cell; s tells the halves apart and changes linearly.
    const bool falls = falling(column, row);
    const double s0 = falls ? (p.y - row) - (p.x - column) : (p.x - column) + (p.y - row) - 1.0;
    const double ds = falls ? d.y - d.x : d.x + d.y;
    const double s_from = s0 + from * ds, s_to = s0 + to * ds;
    const bool splits = (s_from < 0.0) != (s_to < 0.0) && ds != 0.0;
    const double ends[3] = {from, splits ? std::clamp(-s0 / ds, from, to) : to, to};
    for (int part = 0; part < (splits ? 2 : 1); ++part) {
      const int half = (part == 0 ? (splits ? s_from : 0.5 * (s_from + s_to)) : s_to) < 0.0 ? 0 : 1;
      const Plane q = plane(column, row, half);
      // Height of the line above the plane: a + b t.
      const double a = p.z - q.height_m - q.along_x * (p.x - column) - q.along_y * (p.y - row);
      const double b = d.z - q.along_x * d.x - q.along_y * d.y;
      const double end = a + b * ends[part + 1];
      if (std::isnan(end)) {
        known = false;
        continue;
      }
      const bool side = known ? above : a + b * ends[part] > 0.0;
      if ((end > 0.0) != side) {
        const double t = std::clamp(-a / b, ends[part], ends[part + 1]);
        if (t > t_min && t < t_max) {
          const std::uint32_t cell =
              static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid_.columns - 1) +
              static_cast<std::uint32_t>(column);
          return {t, 2 * cell + static_cast<std::uint32_t>(half)};
        }
      }
      known = true;
      above = end > 0.0;
    }
    if (to >= last) return {};
    from = to;
    (cross_x <= cross_y ? column : row) += cross_x <= cross_y ? step_x : step_y;
  }
}

Normal3 HeightField::normal(std::uint32_t triangle) const {
  const int cell = static_cast<int>(triangle / 2), across = grid_.columns - 1;
  const Plane q = plane(cell % across, cell / across, static_cast<int>(triangle % 2));
  return {-q.along_x, -q.along_y, 1.0};
}

/// Of the surface at a node, one-sided where a neighbour is missing.
std::array<double, 2> HeightField::slope(int column, int row) const {
  const auto along = [&](int dc, int dr) {
    const auto known = [&](int c, int r) {
      return c >= 0 && r >= 0 && c < grid_.columns && r < grid_.rows && std::isfinite(height(c, r));
    };
    const bool before = known(column - dc, row - dr), after = known(column + dc, row + dr);
    const double a = before ? height(column - dc, row - dr) : height(column, row);
    const double b = after ? height(column + dc, row + dr) : height(column, row);
    return before || after ? (b - a) / (int(before) + int(after)) : 0.0;
  };
  return {along(1, 0), along(0, 1)};
}

Normal3 HeightField::shading_normal(std::uint32_t triangle, Point3 at) const {
  if (!smooth_) return normal(triangle);
  const int cell = static_cast<int>(triangle / 2), across = grid_.columns - 1;
  const int column = cell % across, row = cell / across, half = static_cast<int>(triangle % 2);
  const double u = at.x - column, v = at.y - row;
  struct Corner {
    int dx, dy;
    double weight;
  };
  std::array<Corner, 3> corners{};
  if (falling(column, row))
    corners = half == 0 ? std::array<Corner, 3>{{{0, 0, 1.0 - u}, {1, 0, u - v}, {1, 1, v}}}
                        : std::array<Corner, 3>{{{0, 0, 1.0 - v}, {0, 1, v - u}, {1, 1, u}}};
  else
    corners = half == 0 ? std::array<Corner, 3>{{{0, 0, 1.0 - u - v}, {1, 0, u}, {0, 1, v}}}
                        : std::array<Corner, 3>{{{1, 1, u + v - 1.0}, {0, 1, 1.0 - u}, {1, 0, 1.0 - v}}};
  // Normals that are units in the object's frame are weighed, as vertex normals of a mesh are.
  Vec3 sum{};
  for (const Corner& c : corners) {
    const auto [sx, sy] = slope(column + c.dx, row + c.dy);
    const Vec3 n{-sx, -sy, 1.0};
    const Vec3 outside{dot(field_from_object_.column_x(), n), dot(field_from_object_.column_y(), n),
                       dot(field_from_object_.column_z(), n)};
    sum = sum + n * (c.weight / length(outside));
  }
  return math::as_normal(sum);
}

}  // namespace ifov::geometry
