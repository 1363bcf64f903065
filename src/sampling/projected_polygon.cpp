#include "sampling/projected_polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sampling/warp.h"

namespace ifov::sampling {

using math::Vec3;

namespace {

/// What an ellipse of half-axes 1 and `height` about the origin sweeps from its shorter half-axis on, for turns within a
/// quarter of a circle.
double sector(double height, double turn) {
  return 0.5 * height * std::atan2(height * std::sin(turn), std::cos(turn));
}

/// The part above the horizon (Sutherland and Hodgman 1974), in a surface's frame; returns its number of corners.
std::size_t clip(std::span<const Vec3> corners, const TangentFrame& frame,
                 std::array<Vec3, ProjectedPolygon::kMostCorners + 1>& part) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 a = frame.to_local(corners[k]), b = frame.to_local(corners[(k + 1) % corners.size()]);
    if (a.z > 0.0 && n < part.size()) part[n++] = a;
    if ((a.z > 0.0) == (b.z > 0.0) || n == part.size()) continue;
    part[n] = a + (b - a) * (a.z / (a.z - b.z));
    part[n++].z = 0.0;
  }
  return n;
}

Vec3 unit_or_zero(Vec3 v) {
  const double size = math::length(v);
  return size > 0.0 ? v / size : Vec3{};
}

double turned(Vec3 from, Vec3 to) {
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}

}  // namespace

ProjectedPolygon::ProjectedPolygon(std::span<const Vec3> corners, Vec3 normal) : normal_(normal) {
  const TangentFrame frame(normal);
  corners_ = clip(corners, frame, part_);
  if (corners_ < 3) return;
  double lambert = 0.0;
  for (std::size_t k = 0; k < corners_; ++k) {
    const Vec3 a = part_[k], b = part_[(k + 1) % corners_], m = math::cross(a, b);
    const double size = math::length(m);
    if (size > 0.0) lambert += std::atan2(size, math::dot(a, b)) * m.z / size;
  }
  if (lambert < 0.0) std::reverse(part_.begin(), part_.begin() + static_cast<std::ptrdiff_t>(corners_));
  area_ = 0.5 * std::abs(lambert);
}

struct ProjectedPolygon::Arcs {
  std::array<Edge, kMostCorners + 1> edges;
  std::size_t count = 0;
  double begin = 0.0, end = 0.0, area = 0.0;
  Vec3 first, second;  // azimuth 0 is along `first`

  Arcs(const Part& part, std::size_t n, Vec3 normal) {
    Part plane;  // unit normals of the edges' planes, inwards
    Vec3 middle{};
    bool about = true;  // the normal goes through it
    for (std::size_t k = 0; k < n; ++k) {
      plane[k] = unit_or_zero(math::cross(part[k], part[(k + 1) % n]));
      middle = middle + unit_or_zero(part[k]);
      about &= plane[k].z > 0.0;
    }
    // Azimuths are counted from a direction within the polygon, or from its first corner where it is all around.
    if (about) middle = part[0];
    middle = unit_or_zero({middle.x, middle.y, 0.0});
    if (middle == Vec3{}) middle = {1.0, 0.0, 0.0};
    const TangentFrame frame(normal);
    first = middle.x * frame.first + middle.y * frame.second;
    second = math::cross(normal, first);
    double gone = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 a = part[k], b = part[(k + 1) % n], m = plane[k];
      Edge edge;
      edge.height = std::abs(m.z);
      edge.level = m.x * m.x + m.y * m.y;
      edge.sign = m.z > 0.0 ? 1.0 : -1.0;
      // What bounds it from outside runs anticlockwise, what bounds it from inside clockwise.
      const Vec3 start = m.z > 0.0 ? a : b, stop = m.z > 0.0 ? b : a;
      edge.begin = about ? gone : turned(middle, start);
      edge.end = about ? gone += std::max(0.0, turned(start, stop)) : turned(middle, stop);
      if (edge.height == 0.0 || !(edge.end > edge.begin)) continue;
      edge.turn = edge.level > 0.0 ? turned(-edge.sign * m, start) : 0.0;
      edge.whole = swept(edge, edge.end);
      area += edge.sign * edge.whole;
      begin = count == 0 ? edge.begin : std::min(begin, edge.begin);
      end = count == 0 ? edge.end : std::max(end, edge.end);
      edges[count++] = edge;
    }
  }
};

double ProjectedPolygon::swept(const Edge& edge, double azimuth) {
  return sector(edge.height, edge.turn + (azimuth - edge.begin)) - sector(edge.height, edge.turn);
}

ProjectedPolygon::Height ProjectedPolygon::height(const Edge& edge, double azimuth) {
  const double turn = edge.turn + (azimuth - edge.begin), c = std::cos(turn), s = std::sin(turn);
  const double low = edge.height * edge.height, whole = c * c + low * s * s;
  return {low / whole, edge.level * c * c / whole};
}

Vec3 ProjectedPolygon::sample(Point2 u) const {
  const Arcs arcs(part_, corners_, normal_);
  const double wanted = u.x * arcs.area;
  double low = arcs.begin, high = arcs.end, azimuth = low + u.x * (high - low);
  Height outer{1.0, 0.0}, inner{0.0, 1.0};
  constexpr int kMostSteps = 60;
  for (int step = 0; step < kMostSteps; ++step) {
    double area = 0.0;
    outer = {1.0, 0.0}, inner = {0.0, 1.0};
    for (std::size_t k = 0; k < arcs.count; ++k) {
      const Edge& edge = arcs.edges[k];
      if (azimuth <= edge.begin) continue;
      if (azimuth >= edge.end) {
        area += edge.sign * edge.whole;
        continue;
      }
      area += edge.sign * swept(edge, azimuth);
      (edge.sign > 0.0 ? outer : inner) = height(edge, azimuth);
    }
    const double miss = area - wanted;
    (miss > 0.0 ? high : low) = azimuth;
    if (std::abs(miss) <= 1e-12 * arcs.area || high - low <= 1e-15 * (arcs.end - arcs.begin)) break;
    const double slope = 0.5 * (outer.sine2 - inner.sine2), newton = azimuth - miss / slope;
    azimuth = slope > 0.0 && newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  const double sine = std::sqrt(std::max(0.0, inner.sine2 + u.y * (outer.sine2 - inner.sine2)));
  const double cosine = std::sqrt(std::max(0.0, inner.cosine2 + u.y * (outer.cosine2 - inner.cosine2)));
  return math::normalized(sine * (std::cos(azimuth) * arcs.first + std::sin(azimuth) * arcs.second) +
                          cosine * normal_);
}

}  // namespace ifov::sampling
