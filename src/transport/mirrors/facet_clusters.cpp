#include "transport/mirrors/facet_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::transport {

namespace {

using geometry::SurfaceSurvey;
using math::Point3;
using math::Vec3;

constexpr std::size_t kMostFacets = std::size_t{1} << 17;
/// Planes without end: all else would be nothing beside them, and they are clusters of their own.
constexpr double kEndless_m = 1e9;
/// Normals this far apart count as places as far apart as all: a highlight is found by normals, wherever it is.
constexpr double kUnlike = 0.1;
/// Variances below this are of facets that face alike in one place.
constexpr double kSame = 1e-9;

struct Facet {
  std::array<double, 6> at{};  // its middle, m, and its normal
  SurfaceSurvey::Ball ball;
  double area_m2 = 0.0;
  Vec3 normal() const { return {at[3], at[4], at[5]}; }
};

struct Part {
  std::size_t first = 0, last = 0;
  int axis = 0;       // by which it is split
  double cost = 0.0;  // 0: it is not
  double middle = 0.0;
};

std::vector<Facet> facets_of(const SurfaceSurvey& survey) {
  std::vector<Facet> facets;
  const auto add = [&](Vec3 n, const SurfaceSurvey::Ball& ball, double area) {
    const Point3 p = ball.centre_m;
    facets.push_back({{p.x, p.y, p.z, n.x, n.y, n.z}, ball, area});
  };
  for (const SurfaceSurvey::Face& face : survey.faces)
    if (face.ball.radius_m < kEndless_m) add(face.normal, face.ball, face.area_m2);
  std::size_t triangles = 0;
  for (const SurfaceSurvey::Smooth& smooth : survey.smooths) triangles += smooth.triangles.size();
  const std::size_t step = 1 + triangles / kMostFacets;
  std::size_t skip = 0;
  for (const SurfaceSurvey::Smooth& smooth : survey.smooths)
    for (const std::uint32_t t : smooth.triangles) {
      if (skip++ % step != 0) continue;
      const geometry::Triangle& v = smooth.mesh.triangles[t];
      const Point3 a = smooth.scene_from_mesh(smooth.mesh.vertices_m[v[0]]),
                   b = smooth.scene_from_mesh(smooth.mesh.vertices_m[v[1]]),
                   c = smooth.scene_from_mesh(smooth.mesh.vertices_m[v[2]]);
      const Vec3 across = math::cross(b - a, c - a);
      const double twice = math::length(across);
      if (!(twice > 0.0)) continue;
      const Point3 middle = a + ((b - a) + (c - a)) / 3.0;
      const double radius =
          std::max({math::length(a - middle), math::length(b - middle), math::length(c - middle)});
      add(across / twice, {middle, radius}, 0.5 * twice);
    }
  return facets;
}

Part part_of(const std::vector<Facet>& facets, std::size_t first, std::size_t last, double extent) {
  Part part{first, last};
  std::array<double, 6> sum{}, square{};
  double area = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    area += facets[k].area_m2;
    for (std::size_t d = 0; d < 6; ++d) {
      sum[d] += facets[k].area_m2 * facets[k].at[d];
      square[d] += facets[k].area_m2 * facets[k].at[d] * facets[k].at[d];
    }
  }
  for (int d = 0; d < 6; ++d) {
    const auto i = static_cast<std::size_t>(d);
    const double mean = sum[i] / area, scale = d < 3 ? extent : kUnlike;
    const double variance = (square[i] / area - mean * mean) / (scale * scale);
    if (variance > part.cost) part.axis = d, part.cost = variance, part.middle = mean;
  }
  // By size, not by area: a car on a wide floor is split as well.
  part.cost = part.cost < kSame ? 0.0 : part.cost * std::sqrt(area);
  return part;
}

FacetCluster cluster_of(const std::vector<Facet>& facets, const Part& part) {
  FacetCluster cluster;
  Vec3 normal{};
  Vec3 low = facets[part.first].ball.centre_m - Point3{}, high = low;
  for (std::size_t k = part.first; k < part.last; ++k) {
    normal = normal + facets[k].area_m2 * facets[k].normal();
    const Vec3 p = facets[k].ball.centre_m - Point3{};
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double length = math::length(normal);
  cluster.normal = length > 0.0 ? normal / length : facets[part.first].normal();
  cluster.ball.centre_m = Point3{} + 0.5 * (low + high);
  for (std::size_t k = part.first; k < part.last; ++k) {
    cluster.spread = std::max(cluster.spread, math::length(facets[k].normal() - cluster.normal));
    cluster.ball.radius_m =
        std::max(cluster.ball.radius_m,
                 math::length(facets[k].ball.centre_m - cluster.ball.centre_m) + facets[k].ball.radius_m);
  }
  return cluster;
}

}  // namespace

std::vector<FacetCluster> facet_clusters(const SurfaceSurvey& survey, std::size_t most) {
  std::vector<FacetCluster> clusters;
  for (const SurfaceSurvey::Face& face : survey.faces)
    if (face.ball.radius_m >= kEndless_m && clusters.size() < most / 4)
      clusters.push_back({face.ball, face.normal, 0.0});
  std::vector<Facet> facets = facets_of(survey);
  if (facets.empty() || most == 0) return clusters;
  double extent = 0.0;
  for (const Facet& facet : facets)
    extent = std::max(extent, math::length(facet.ball.centre_m - facets.front().ball.centre_m));
  std::vector<Part> parts{part_of(facets, 0, facets.size(), std::max(extent, 1e-9))};
  while (parts.size() + clusters.size() < most) {
    const auto widest = std::max_element(parts.begin(), parts.end(),
                                         [](const Part& a, const Part& b) { return a.cost < b.cost; });
    if (widest->cost <= 0.0) break;
    const Part whole = *widest;
    const auto axis = static_cast<std::size_t>(whole.axis);
    const auto begin = facets.begin() + static_cast<std::ptrdiff_t>(whole.first),
               end = facets.begin() + static_cast<std::ptrdiff_t>(whole.last);
    const auto middle =
        std::stable_partition(begin, end, [&](const Facet& facet) { return facet.at[axis] < whole.middle; });
    if (middle == begin || middle == end) {
      widest->cost = 0.0;
      continue;
    }
    const auto cut = static_cast<std::size_t>(middle - facets.begin());
    *widest = part_of(facets, whole.first, cut, std::max(extent, 1e-9));
    parts.push_back(part_of(facets, cut, whole.last, std::max(extent, 1e-9)));
  }
  for (const Part& part : parts) clusters.push_back(cluster_of(facets, part));
  return clusters;
}

}  // namespace ifov::transport
