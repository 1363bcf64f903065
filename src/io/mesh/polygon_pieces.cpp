#include "io/mesh/polygon_pieces.h"

#include <geos_c.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/late_library.h"
#include "geometry/polygon_triangulation.h"

namespace ifov::io {
namespace {

namespace late {

constinit LateLibrary geos{IFOV_LATE_GEOS_C};
// What the compiler is told of a function beside its type (printf's formats) is not a part of the type.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"
#define IFOV_GEOS(name) constinit LateFunction<decltype(&::name)> name{geos, #name};
IFOV_GEOS(GEOSConstrainedDelaunayTriangulation_r)
IFOV_GEOS(GEOSContext_setErrorMessageHandler_r)
IFOV_GEOS(GEOSContext_setNoticeMessageHandler_r)
IFOV_GEOS(GEOSCoordSeq_create_r)
IFOV_GEOS(GEOSCoordSeq_getSize_r)
IFOV_GEOS(GEOSCoordSeq_getXY_r)
IFOV_GEOS(GEOSCoordSeq_setXY_r)
IFOV_GEOS(GEOSGeom_createLinearRing_r)
IFOV_GEOS(GEOSGeom_createPolygon_r)
IFOV_GEOS(GEOSGeom_destroy_r)
IFOV_GEOS(GEOSGeom_getCoordSeq_r)
IFOV_GEOS(GEOSGeom_getDimensions_r)
IFOV_GEOS(GEOSGetExteriorRing_r)
IFOV_GEOS(GEOSGetGeometryN_r)
IFOV_GEOS(GEOSGetNumGeometries_r)
IFOV_GEOS(GEOSMakeValid_r)
IFOV_GEOS(GEOS_finish_r)
IFOV_GEOS(GEOS_init_r)
IFOV_GEOS(GEOSisValid_r)
#undef IFOV_GEOS
#pragma GCC diagnostic pop

}  // namespace late

using geometry::Triangle;
using math::Point3;
using math::Vec3;

/// Ear clipping takes the cube of the corners at worst, 1 s at this many.
constexpr std::size_t kMostEars = 1000;

/// Products of such coordinates stay finite, metres.
constexpr double kLargest = 1e12;

/// The two coordinates that are kept, in an order that keeps the winding, and the plane that gives the third
/// back.
class Plane {
 public:
  Plane(Point3 origin, Vec3 normal) : origin_(origin), normal_(normal) {
    const double ax = std::abs(normal.x), ay = std::abs(normal.y), az = std::abs(normal.z);
    dropped_ = az >= ax && az >= ay ? 2 : ax >= ay ? 0 : 1;
  }

  std::pair<double, double> flat(Point3 p) const {
    const Vec3 v = p - origin_;
    return dropped_ == 2 ? std::pair{v.x, v.y} : dropped_ == 0 ? std::pair{v.y, v.z} : std::pair{v.z, v.x};
  }
  bool mirrored() const { return (dropped_ == 2 ? normal_.z : dropped_ == 0 ? normal_.x : normal_.y) < 0.0; }
  Point3 lifted(double a, double b) const {
    const Vec3 n = normal_;
    if (dropped_ == 2) return origin_ + Vec3{a, b, -(n.x * a + n.y * b) / n.z};
    if (dropped_ == 0) return origin_ + Vec3{-(n.y * a + n.z * b) / n.x, a, b};
    return origin_ + Vec3{b, -(n.z * a + n.x * b) / n.y, a};
  }

 private:
  Point3 origin_;
  Vec3 normal_;
  int dropped_ = 2;
};

class Geos {
 public:
  Geos() : handle_(late::GEOS_init_r()) {
    // Failures are returned as null; without handlers GEOS keeps quiet about them.
    late::GEOSContext_setErrorMessageHandler_r(handle_, nullptr, nullptr);
    late::GEOSContext_setNoticeMessageHandler_r(handle_, nullptr, nullptr);
  }
  ~Geos() { late::GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  /// Null where the ring has fewer than three different points.
  GEOSGeometry* ring(const std::vector<std::pair<double, double>>& points) const {
    std::vector<std::pair<double, double>> kept;
    for (const auto& p : points)
      if (kept.empty() || kept.back() != p) kept.push_back(p);
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() < 3) return nullptr;
    kept.push_back(kept.front());
    GEOSCoordSequence* sequence = late::GEOSCoordSeq_create_r(handle_, static_cast<unsigned>(kept.size()), 2);
    for (std::size_t k = 0; k < kept.size(); ++k)
      late::GEOSCoordSeq_setXY_r(handle_, sequence, static_cast<unsigned>(k), kept[k].first, kept[k].second);
    return late::GEOSGeom_createLinearRing_r(handle_, sequence);
  }

  GEOSContextHandle_t handle() const { return handle_; }
  void destroy(GEOSGeometry* geometry) const {
    if (geometry != nullptr) late::GEOSGeom_destroy_r(handle_, geometry);
  }

 private:
  GEOSContextHandle_t handle_;
};

/// A geometry and the context that it lives in.
class Owned {
 public:
  Owned(const Geos& geos, GEOSGeometry* geometry) : geos_(geos), geometry_(geometry) {}
  ~Owned() { geos_.destroy(geometry_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  void replace(GEOSGeometry* geometry) {
    geos_.destroy(geometry_);
    geometry_ = geometry;
  }
  GEOSGeometry* get() const { return geometry_; }

 private:
  const Geos& geos_;
  GEOSGeometry* geometry_;
};

/// Collects the triangles of a GEOS result as indices into the pieces' vertices.
class PieceCollector {
 public:
  PieceCollector(const Geos& geos, const Plane& plane, PolygonPieces& pieces)
      : geos_(geos), plane_(plane), pieces_(pieces) {
    for (std::size_t k = 0; k < pieces.vertices.size(); ++k)
      known_.try_emplace(plane.flat(pieces.vertices[k]), static_cast<std::uint32_t>(k));
  }

  void add_all(const GEOSGeometry* geometry) {
    const int count = late::GEOSGetNumGeometries_r(geos_.handle(), geometry);
    for (int k = 0; k < count; ++k) add(late::GEOSGetGeometryN_r(geos_.handle(), geometry, k));
  }

 private:
  void add(const GEOSGeometry* triangle) {
    const GEOSGeometry* ring = late::GEOSGetExteriorRing_r(geos_.handle(), triangle);
    if (ring == nullptr) return;
    const GEOSCoordSequence* sequence = late::GEOSGeom_getCoordSeq_r(geos_.handle(), ring);
    unsigned size = 0;
    if (sequence == nullptr || late::GEOSCoordSeq_getSize_r(geos_.handle(), sequence, &size) == 0 ||
        size != 4)
      return;
    Triangle t{};
    std::pair<double, double> p[3];
    for (unsigned k = 0; k < 3; ++k) {
      late::GEOSCoordSeq_getXY_r(geos_.handle(), sequence, k, &p[k].first, &p[k].second);
      t[k] = index(p[k]);
    }
    const double area = (p[1].first - p[0].first) * (p[2].second - p[0].second) -
                        (p[1].second - p[0].second) * (p[2].first - p[0].first);
    if (area == 0.0) return;
    if ((area < 0.0) != plane_.mirrored()) std::swap(t[1], t[2]);
    pieces_.triangles.push_back(t);
  }

  std::uint32_t index(const std::pair<double, double>& p) {
    const auto [entry, is_new] = known_.try_emplace(p, static_cast<std::uint32_t>(pieces_.vertices.size()));
    if (is_new) pieces_.vertices.push_back(plane_.lifted(p.first, p.second));
    return entry->second;
  }

  const Geos& geos_;
  const Plane& plane_;
  PolygonPieces& pieces_;
  std::map<std::pair<double, double>, std::uint32_t> known_;
};

}  // namespace

std::optional<PolygonPieces> cut_polygon(std::span<const std::vector<Point3>> rings) {
  PolygonPieces pieces;
  for (const auto& ring : rings) pieces.vertices.insert(pieces.vertices.end(), ring.begin(), ring.end());
  if (rings.empty() || rings[0].size() < 3) return pieces;
  const Vec3 normal = geometry::polygon_area_vector(rings[0]);
  if (!(length(normal) > 0.0)) return pieces;
  const Plane plane(rings[0][0], normal);
  const Geos geos;
  std::vector<GEOSGeometry*> flat_rings;
  for (const auto& ring : rings) {
    std::vector<std::pair<double, double>> points;
    for (const Point3& p : ring) points.push_back(plane.flat(p));
    for (const auto& [a, b] : points)
      if (!(std::abs(a) < kLargest && std::abs(b) < kLargest)) {
        for (GEOSGeometry* made : flat_rings) geos.destroy(made);
        return std::nullopt;
      }
    GEOSGeometry* made = geos.ring(points);
    if (made == nullptr && flat_rings.empty()) return pieces;
    if (made != nullptr) flat_rings.push_back(made);
  }
  Owned polygon(geos, late::GEOSGeom_createPolygon_r(geos.handle(), flat_rings[0], flat_rings.data() + 1,
                                                     static_cast<unsigned>(flat_rings.size() - 1)));
  if (polygon.get() == nullptr) return std::nullopt;
  if (late::GEOSisValid_r(geos.handle(), polygon.get()) != 1) {
    polygon.replace(late::GEOSMakeValid_r(geos.handle(), polygon.get()));
    pieces.repaired = true;
    if (polygon.get() == nullptr) return std::nullopt;
  }
  PieceCollector collector(geos, plane, pieces);
  const int parts = late::GEOSGetNumGeometries_r(geos.handle(), polygon.get());
  for (int k = 0; k < parts; ++k) {
    const GEOSGeometry* part = late::GEOSGetGeometryN_r(geos.handle(), polygon.get(), k);
    if (late::GEOSGeom_getDimensions_r(geos.handle(), part) != 2) continue;
    const Owned triangles(geos, late::GEOSConstrainedDelaunayTriangulation_r(geos.handle(), part));
    if (triangles.get() == nullptr) return std::nullopt;
    collector.add_all(triangles.get());
  }
  return pieces;
}

std::optional<std::vector<Triangle>> cut_face(std::span<const Point3> corners) {
  if (corners.size() <= kMostEars) return geometry::triangulate_polygon(corners);
  const std::vector<Point3> ring(corners.begin(), corners.end());
  auto pieces = cut_polygon(std::span(&ring, 1));
  if (!pieces || pieces->repaired) return std::nullopt;
  return std::move(pieces->triangles);
}

}  // namespace ifov::io
