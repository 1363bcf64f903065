#include "geometry/terrain_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.h"
#include "core/parallel.h"

namespace ifov::geometry {

namespace {

struct Node {
  int column = 0, row = 0;
};

Node middle(Node a, Node b) { return {(a.column + b.column) / 2, (a.row + b.row) / 2}; }

/// A right triangle with its hypotenuse from `a` to `b`.
struct Half {
  Node a, b, apex;
};

/// Largest distance of the nodes in a triangle from its plane.
struct Deviation {
  double height_m = 0.0, shift_m = 0.0;
  void include(Deviation other) {
    height_m = std::max(height_m, other.height_m);
    shift_m = std::max(shift_m, other.shift_m);
  }
};

/// The hierarchy of halved triangles over the square of 2^n cells that holds the grid. A halving is known by the
/// middle of the hypotenuse, a node with a step s, the largest power of two that divides both coordinates: with one
/// coordinate an odd multiple of s the hypotenuse runs along an axis, with both it is the diagonal of a square.
class Hierarchy {
 public:
  Hierarchy(const TerrainGrid& grid, double detail_m)
      : grid_(grid), detail_m_(detail_m), halved_(grid.height_m.size(), 0) {
    while (size_ < std::max(grid.columns, grid.rows) - 1) size_ *= 2;
    for (int step = 1; step <= size_ / 2; step *= 2) {
      decide(step, false);
      decide(step, true);
    }
  }

  /// Calls use(half) for every triangle that is not halved further and has known corners in the grid.
  template <class Use>
  void visit(const Use& use) const {
    const Node nw{0, 0}, ne{size_, 0}, se{size_, size_}, sw{0, size_};
    descend({nw, se, ne}, use);
    descend({se, nw, sw}, use);
  }

  Deviation deviation(const Half& half) const;

 private:
  enum class Side { inside, outside, astride };

  Side side(const Half& h) const {
    const auto inside = [&](Node n) { return n.column < grid_.columns && n.row < grid_.rows; };
    if (inside(h.a) && inside(h.b) && inside(h.apex)) return Side::inside;
    const bool beyond = std::min({h.a.column, h.b.column, h.apex.column}) >= grid_.columns - 1 ||
                        std::min({h.a.row, h.b.row, h.apex.row}) >= grid_.rows - 1;
    return beyond ? Side::outside : Side::astride;
  }
  bool known(Node n) const { return std::isfinite(grid_.height_m[grid_.index(n.column, n.row)]); }

  /// The two triangles that share the hypotenuse with this middle.
  std::array<Half, 2> halves(Node m, int step, bool diagonal) const;
  bool must_halve(Node m, int step, bool diagonal) const;
  void decide(int step, bool diagonal);

  template <class Use>
  void descend(const Half& h, const Use& use) const {
    const Side where = side(h);
    if (where == Side::outside) return;
    const int legs = std::max(std::abs(h.a.column - h.b.column), std::abs(h.a.row - h.b.row));
    const bool smallest = legs == 1;
    const Node m = middle(h.a, h.b);
    if (!smallest && (where == Side::astride || halved_[grid_.index(m.column, m.row)] != 0)) {
      descend({h.apex, h.a, m}, use);
      descend({h.b, h.apex, m}, use);
    } else if (where == Side::inside && known(h.a) && known(h.b) && known(h.apex)) {
      use(h);
    }
  }

  const TerrainGrid& grid_;
  double detail_m_;
  int size_ = 1;
  std::vector<std::uint8_t> halved_;
};

std::array<Half, 2> Hierarchy::halves(Node m, int step, bool diagonal) const {
  if (diagonal) {
    // The diagonal of a square runs through the centre of the square of twice its side, and so of the four squares in
    // that one, opposite ones have the same direction.
    const bool falling = ((m.column - step) / (2 * step)) % 2 == ((m.row - step) / (2 * step)) % 2;
    const Node nw{m.column - step, m.row - step}, ne{m.column + step, m.row - step};
    const Node sw{m.column - step, m.row + step}, se{m.column + step, m.row + step};
    if (falling) return {Half{nw, se, ne}, Half{se, nw, sw}};
    return {Half{sw, ne, nw}, Half{ne, sw, se}};
  }
  const Node w{m.column - step, m.row}, e{m.column + step, m.row};
  const Node n{m.column, m.row - step}, s{m.column, m.row + step};
  if ((m.column / step) % 2 == 1) return {Half{w, e, n}, Half{e, w, s}};
  return {Half{n, s, e}, Half{s, n, w}};
}

Deviation Hierarchy::deviation(const Half& h) const {
  const auto [west, east] = std::minmax({h.a.column, h.b.column, h.apex.column});
  const auto [north, south] = std::minmax({h.a.row, h.b.row, h.apex.row});
  const double ax = h.a.column - h.apex.column, ay = h.a.row - h.apex.row;
  const double bx = h.b.column - h.apex.column, by = h.b.row - h.apex.row;
  const double side = ax * by - bx * ay;
  const math::Point3 pa = grid_.node(h.a.column, h.a.row), pb = grid_.node(h.b.column, h.b.row),
                     pc = grid_.node(h.apex.column, h.apex.row);
  const bool regular = grid_.positions_m.empty();
  Deviation worst;
  for (int row = north; row <= south; ++row)
    for (int column = west; column <= east; ++column) {
      const double dx = column - h.apex.column, dy = row - h.apex.row;
      const double s = (dx * by - bx * dy) / side, t = (ax * dy - dx * ay) / side;
      if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
      const math::Point3 node = grid_.node(column, row);
      const double z = pc.z + s * (pa.z - pc.z) + t * (pb.z - pc.z);
      worst.height_m = std::max(worst.height_m, std::abs(node.z - z));
      if (regular) continue;
      const double x = pc.x + s * (pa.x - pc.x) + t * (pb.x - pc.x);
      const double y = pc.y + s * (pa.y - pc.y) + t * (pb.y - pc.y);
      worst.shift_m = std::max(worst.shift_m, std::hypot(node.x - x, node.y - y));
    }
  return worst;
}

bool Hierarchy::must_halve(Node m, int step, bool diagonal) const {
  // The middles of the triangles that this halving makes.
  const int reach = diagonal ? step : step / 2;
  if (reach > 0) {
    const std::array<Node, 4> children = diagonal ? std::array<Node, 4>{{{m.column - reach, m.row},
                                                                         {m.column + reach, m.row},
                                                                         {m.column, m.row - reach},
                                                                         {m.column, m.row + reach}}}
                                                  : std::array<Node, 4>{{{m.column - reach, m.row - reach},
                                                                         {m.column + reach, m.row - reach},
                                                                         {m.column - reach, m.row + reach},
                                                                         {m.column + reach, m.row + reach}}};
    for (const Node child : children)
      if (child.column >= 0 && child.row >= 0 && child.column < grid_.columns && child.row < grid_.rows &&
          halved_[grid_.index(child.column, child.row)] != 0)
        return true;
  }
  if (!known(m)) return true;
  for (const Half& half : halves(m, step, diagonal)) {
    if (half.a.column < 0 || half.a.row < 0 || half.apex.column < 0 || half.apex.row < 0) continue;
    const Side where = side(half);
    if (where == Side::astride) return true;
    if (where == Side::outside) continue;
    if (!known(half.a) || !known(half.b) || !known(half.apex)) return true;
    const Deviation found = deviation(half);
    if (found.height_m > detail_m_ || found.shift_m > detail_m_) return true;
  }
  return false;
}

void Hierarchy::decide(int step, bool diagonal) {
  const int lines = (grid_.rows - 1) / step + 1;
  parallel_for(lines, 0, [&](std::int64_t line) {
    const int row = static_cast<int>(line) * step;
    const bool odd_row = line % 2 == 1;
    if (diagonal && !odd_row) return;
    // Odd multiples of the step in odd rows are diagonal; axial ones have just one odd coordinate.
    for (int column = (diagonal || !odd_row) ? step : 0; column < grid_.columns; column += 2 * step)
      halved_[grid_.index(column, row)] = must_halve({column, row}, step, diagonal) ? 1 : 0;
  });
}

math::Normal3 normal_at(const TerrainGrid& grid, int column, int row) {
  // One-sided where a neighbour is missing.
  const auto neighbour = [&](int c, int r) -> math::Point3 {
    if (c >= 0 && r >= 0 && c < grid.columns && r < grid.rows &&
        std::isfinite(grid.height_m[grid.index(c, r)]))
      return grid.node(c, r);
    return grid.node(column, row);
  };
  math::Vec3 east = neighbour(column + 1, row) - neighbour(column - 1, row);
  math::Vec3 north = neighbour(column, row - 1) - neighbour(column, row + 1);
  // Level along an axis on which both are missing.
  if (grid.positions_m.empty() && length(east) == 0.0) east = grid.along_column_m;
  if (grid.positions_m.empty() && length(north) == 0.0) north = -grid.along_row_m;
  const math::Vec3 up = math::cross(east, north);
  if (!(math::length(up) > 0.0)) return {0.0, 0.0, 1.0};
  const math::Vec3 unit = math::normalized(up);
  return math::as_normal(unit.z >= 0.0 ? unit : -unit);
}

}  // namespace

math::Point3 TerrainGrid::node(int column, int row) const {
  const double z = corner_m.z + static_cast<double>(height_m[index(column, row)]);
  if (!positions_m.empty()) {
    const std::array<double, 2>& position = positions_m[index(column, row)];
    return {position[0], position[1], z};
  }
  return {corner_m.x + column * along_column_m.x + row * along_row_m.x,
          corner_m.y + column * along_column_m.y + row * along_row_m.y, z};
}

TerrainMesh mesh_terrain(const TerrainGrid& grid, double detail_m, bool smooth) {
  if (grid.columns < 2 || grid.rows < 2)
    throw InputError(format("a terrain needs at least 2 x 2 nodes: found {} x {}", grid.columns, grid.rows));
  const Hierarchy hierarchy(grid, detail_m);
  TerrainMesh result;
  for (const float height : grid.height_m) result.known_nodes += std::isfinite(height) ? 1 : 0;
  TriangleMesh& mesh = result.mesh;
  std::vector<std::uint32_t> vertex_of(grid.height_m.size(), kNoIndex);
  Deviation worst;
  hierarchy.visit([&](const Half& half) {
    worst.include(hierarchy.deviation(half));
    Triangle triangle{};
    const Node corners[3] = {half.a, half.b, half.apex};
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& vertex = vertex_of[grid.index(corners[k].column, corners[k].row)];
      if (vertex == kNoIndex) {
        vertex = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.push_back(grid.node(corners[k].column, corners[k].row));
        if (smooth) mesh.normals.push_back(normal_at(grid, corners[k].column, corners[k].row));
      }
      triangle[k] = vertex;
    }
    const math::Vec3 up = math::cross(mesh.vertices_m[triangle[1]] - mesh.vertices_m[triangle[0]],
                                      mesh.vertices_m[triangle[2]] - mesh.vertices_m[triangle[0]]);
    if (up.z < 0.0) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  });
  if (mesh.triangles.empty()) throw InputError("the terrain has no triangle with three known heights");
  result.largest_height_error_m = worst.height_m;
  result.largest_shift_m = worst.shift_m;
  return result;
}

}  // namespace ifov::geometry
