#include "geometry/world/survey_of.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "geometry/growing_box.h"
#include "geometry/unit_primitive.h"
#include "geometry/world/instance_set.h"
#include "geometry/world/piece_walk.h"
#include "geometry/world/world_content.h"

namespace ifov::geometry {

namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

/// Coordinates from which planes have no end.
constexpr double kEndless_m = 1e12;

double offset_of(Vec3 normal, Point3 p) { return dot(normal, p - Point3{}); }

/// Faces by their normals, found again by cells of directions.
class NormalTable {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};
  explicit NormalTable(std::vector<SurfaceSurvey::Flat>& flats) : flats_(flats) {}

  std::size_t find(Vec3 normal) const {
    for (const Vec3 n : {normal, -normal}) {
      // The neighbourhood reaches into at most eight cells.
      for (int corner = 0; corner < 8; ++corner) {
        const double reach = SurfaceSurvey::kSameNormal_rad;
        const auto found = cells_.find(
            key({n.x + ((corner & 1) != 0 ? reach : -reach), n.y + ((corner & 2) != 0 ? reach : -reach),
                 n.z + ((corner & 4) != 0 ? reach : -reach)}));
        if (found == cells_.end()) continue;
        for (const std::size_t k : found->second)
          if (length(flats_[k].normal - n) <= reach) return k;
      }
    }
    return kNone;
  }
  /// kNone where there is no room for another.
  std::size_t find_or_add(Vec3 normal) {
    const std::size_t known = find(normal);
    if (known != kNone || flats_.size() >= SurfaceSurvey::kMostFlats) return known;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    flats_.push_back({normal, GrowingBox{}.bounds, 0.0, kInfinity, -kInfinity, {}, false});
    cells_[key(normal)].push_back(flats_.size() - 1);
    return flats_.size() - 1;
  }

 private:
  static std::uint64_t key(Vec3 n) {
    constexpr double kCells = 0.2 / SurfaceSurvey::kSameNormal_rad;
    const auto cell = [](double x) {
      return static_cast<std::uint64_t>(std::llround(x * kCells) + (1 << 20));
    };
    return cell(n.x) | cell(n.y) << 21 | cell(n.z) << 42;
  }
  std::vector<SurfaceSurvey::Flat>& flats_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// Faces of one normal and slot of a body, in its frame.
struct BodyFlat {
  std::uint32_t slot = 0;
  Vec3 normal;
  GrowingBox box;
  double area_m2 = 0.0;
  Point3 lowest_m, highest_m;       ///< along the normal
  std::vector<Point3> on_planes_m;  ///< a point of each plane, kMostPlanes + 1 at most
};

struct BodySurvey {
  std::vector<BodyFlat> flats;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> smooth;  ///< slot and triangle
};

/// The normal that all of a triangle is seen with; none where its vertex normals differ.
std::optional<Vec3> common_normal(const MeshLists& mesh, std::size_t triangle, Vec3 facet) {
  if (mesh.normals.empty()) return facet;
  const Triangle& i = mesh.normal_corners.empty() ? mesh.triangles[triangle] : mesh.normal_corners[triangle];
  for (const std::uint32_t corner : i)
    if (corner == kNoIndex) return facet;
  const Vec3 first = normalized(mesh.normals[i[0]].as_vector());
  for (const std::uint32_t corner : i)
    if (!(length(normalized(mesh.normals[corner].as_vector()) - first) <
          0.05 * SurfaceSurvey::kSameNormal_rad))
      return std::nullopt;
  return dot(first, facet) < 0.0 ? -first : first;
}

class BodySurveyor {
 public:
  BodySurveyor(const Body& body, bool facets) : body_(body), facets_(facets) {
    if (!facets)
      for (const UnitPrimitive& shape : body.analytic) add_faces(shape);
    for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t) add_triangle(static_cast<std::uint32_t>(t));
  }
  BodySurvey take() && { return std::move(survey_); }

 private:
  void add_faces(const UnitPrimitive& shape) {
    const Transform object_from_unit = shape.unit_from_object.inverse();
    const auto add_face = [&](Vec3 normal, Point3 centre, Vec3 first, Vec3 second) {
      const Vec3 n = object_from_unit(math::as_normal(normal)).as_vector();
      const Vec3 a = object_from_unit(first), b = object_from_unit(second);
      const Point3 c = object_from_unit(centre);
      add(shape.slot, n, {c - a - b, c - a + b, c + a - b, c + a + b}, 4.0 * length(cross(a, b)));
    };
    if (shape.kind->visit_flats != nullptr) shape.kind->visit_flats(add_face);
  }

  void add_triangle(std::uint32_t t) {
    const MeshLists& mesh = body_.mesh;
    const Triangle& v = mesh.triangles[t];
    const Point3 a = mesh.vertices_m[v[0]], b = mesh.vertices_m[v[1]], c = mesh.vertices_m[v[2]];
    const Vec3 across = cross(b - a, c - a);
    const double twice = length(across);
    if (!(twice > 0.0)) return;
    const std::uint32_t slot = mesh.slots.empty() ? 0 : mesh.slots[t];
    const auto normal = facets_ ? std::nullopt : common_normal(mesh, t, across / twice);
    if (normal)
      add(slot, *normal, {a, b, c, c}, 0.5 * twice);
    else
      survey_.smooth.push_back({slot, t});
  }

  void add(std::uint32_t slot, Vec3 normal, const std::array<Point3, 4>& points, double area_m2) {
    NormalTable& table = table_of(slot);
    const std::size_t known = lists_[slot].size();
    const std::size_t k = table.find_or_add(normal);
    // A body of more normals than there is room for: the rest stand each for itself.
    const bool is_new = k == NormalTable::kNone || lists_[slot].size() > known;
    if (is_new) {
      if (k != NormalTable::kNone) at_[slot].push_back(survey_.flats.size());
      BodyFlat flat;
      flat.slot = slot, flat.normal = normal, flat.lowest_m = flat.highest_m = points[0];
      survey_.flats.push_back(flat);
    }
    BodyFlat& flat = k == NormalTable::kNone ? survey_.flats.back() : survey_.flats[at_[slot][k]];
    const double offset = offset_of(flat.normal, points[0]);
    const bool known_plane = std::any_of(flat.on_planes_m.begin(), flat.on_planes_m.end(), [&](Point3 p) {
      return std::abs(offset_of(flat.normal, p) - offset) < SurfaceSurvey::kSamePlane_m;
    });
    if (!known_plane && flat.on_planes_m.size() <= SurfaceSurvey::kMostPlanes)
      flat.on_planes_m.push_back(points[0]);
    for (const Point3& p : points) {
      flat.box.include(p, p);
      if (offset_of(flat.normal, p) < offset_of(flat.normal, flat.lowest_m)) flat.lowest_m = p;
      if (offset_of(flat.normal, p) > offset_of(flat.normal, flat.highest_m)) flat.highest_m = p;
    }
    flat.area_m2 += area_m2;
  }

  NormalTable& table_of(std::uint32_t slot) {
    const auto found = tables_.find(slot);
    return found != tables_.end() ? found->second
                                  : tables_.emplace(slot, NormalTable(lists_[slot])).first->second;
  }

  const Body& body_;
  bool facets_;
  BodySurvey survey_;
  std::unordered_map<std::uint32_t, std::vector<SurfaceSurvey::Flat>> lists_;  // by slot, for the tables
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> at_;             // places in survey_.flats
  std::unordered_map<std::uint32_t, NormalTable> tables_;
};

class Surveyor {
 public:
  Surveyor(const WorldContent& content, const std::vector<bool>& surveyed, bool facets)
      : content_(content), surveyed_(surveyed), facets_(facets), table_(survey_.flats) {}

  bool wanted(std::uint32_t first_material, std::uint32_t slot) const {
    const std::uint32_t material = content_.materials[first_material + slot];
    return material < surveyed_.size() && surveyed_[material];
  }

  void add(const PlacedPiece& piece) {
    const Body& body = content_.templates[piece.of].body;
    bool any = false;
    for (std::uint32_t slot = 0; slot < body.slot_count; ++slot) any = any || wanted(piece.materials, slot);
    if (!any) return;
    auto known = bodies_.find(piece.of);
    if (known == bodies_.end()) known = bodies_.emplace(piece.of, BodySurveyor(body, facets_).take()).first;
    for (const BodyFlat& flat : known->second.flats)
      if (wanted(piece.materials, flat.slot)) add_flat(flat, piece.scene_from_body);
    for (const UnitPrimitive& shape : body.analytic) {
      const bool flat_too = facets_ && shape.kind->visit_flats != nullptr;
      if ((shape.kind->round_faces == 0 && !flat_too) || !wanted(piece.materials, shape.slot)) continue;
      const Transform scene_from_unit = piece.scene_from_body * shape.unit_from_object.inverse();
      const SurfaceSurvey::Ball ball = ball_about(unit_bounds(shape.kind, scene_from_unit));
      if (flat_too) add_faces(shape.kind, scene_from_unit);
      if (shape.kind->round_faces == 0) continue;
      if (shape.kind->known_as_mirror)
        survey_.rounds.push_back({shape.kind, scene_from_unit, piece.object, ball});
      else
        survey_.balls.push_back(ball);
    }
    if (facets_ && !room_for(known->second.smooth.size())) return;
    SurfaceSurvey::Smooth smooth{body.mesh, piece.scene_from_body, piece.object, {}, {}};
    GrowingBox box;
    for (const auto& [slot, triangle] : known->second.smooth) {
      if (!wanted(piece.materials, slot)) continue;
      smooth.triangles.push_back(triangle);
      for (const std::uint32_t corner : body.mesh.triangles[triangle]) {
        const Point3 p = piece.scene_from_body(body.mesh.vertices_m[corner]);
        box.include(p, p);
      }
    }
    if (smooth.triangles.empty()) return;
    smooth.ball = ball_about(box.bounds);
    survey_.balls.push_back(smooth.ball);
    survey_.smooths.push_back(std::move(smooth));
  }

  void add(const Run& run) {
    const Template& one = content_.templates[run.what.of];
    if (one.has_body() || !wanted(run.materials, 0)) return;
    if (one.field) {
      add_ball(image_of(one.field->bounds(), run.what.whole_from_list));
      return;
    }
    const double z = run.what.whole_from_list(Point3{0.0, 0.0, one.plane->z_m}).z;
    if (facets_) {
      survey_.faces.push_back({{0.0, 0.0, 1.0}, {{0.0, 0.0, z}, kEndless_m}, kEndless_m * kEndless_m});
      return;
    }
    BodyFlat endless;
    endless.normal = {0.0, 0.0, 1.0};
    endless.box.include({-kEndless_m, -kEndless_m, z}, {kEndless_m, kEndless_m, z});
    endless.area_m2 = kEndless_m;
    endless.lowest_m = endless.highest_m = {0.0, 0.0, z};
    endless.on_planes_m = {{0.0, 0.0, z}};
    add_flat(endless, Transform{});
  }

  SurfaceSurvey take() && { return std::move(survey_); }

 private:
  void add_faces(UnitKind kind, const Transform& scene_from_unit) {
    kind->visit_flats([&](Vec3 normal, Point3 centre, Vec3 first, Vec3 second) {
      const Vec3 a = scene_from_unit(first), b = scene_from_unit(second);
      survey_.faces.push_back({scene_from_unit(math::as_normal(normal)).as_vector(),
                               {scene_from_unit(centre), std::max(length(a + b), length(a - b))},
                               4.0 * length(cross(a, b))});
    });
  }

  bool room_for(std::size_t facets) {
    listed_ += facets;
    if (listed_ > SurfaceSurvey::kMostFacets && survey_.all_facets) {
      survey_.all_facets = false;
      survey_.smooths = {};
    }
    return survey_.all_facets;
  }

  void add_flat(const BodyFlat& part, const Transform& scene_from_body) {
    const World::Bounds bounds = image_of(part.box.bounds, scene_from_body);
    const std::size_t k = table_.find_or_add(scene_from_body(math::as_normal(part.normal)).as_vector());
    if (k == NormalTable::kNone) {
      survey_.all_flats = false;
      return add_ball(bounds);
    }
    SurfaceSurvey::Flat& flat = survey_.flats[k];
    GrowingBox box{flat.bounds};
    box.include(bounds);
    flat.bounds = box.bounds;
    for (const Point3& p : part.on_planes_m) {
      const double offset = offset_of(flat.normal, scene_from_body(p));
      const auto same = [&](double other) { return std::abs(other - offset) < SurfaceSurvey::kSamePlane_m; };
      if (flat.many_planes || std::any_of(flat.planes_m.begin(), flat.planes_m.end(), same)) continue;
      flat.planes_m.push_back(offset);
      flat.many_planes = flat.planes_m.size() > SurfaceSurvey::kMostPlanes;
      if (flat.many_planes) flat.planes_m.clear();
    }
    const double stretch = largest_stretch(scene_from_body);
    flat.area_m2 += part.area_m2 * stretch * stretch;
    for (const Point3& p : {scene_from_body(part.lowest_m), scene_from_body(part.highest_m)}) {
      flat.low_m = std::min(flat.low_m, offset_of(flat.normal, p));
      flat.high_m = std::max(flat.high_m, offset_of(flat.normal, p));
    }
  }

  static SurfaceSurvey::Ball ball_about(const World::Bounds& box) {
    return {box.low_m + (box.high_m - box.low_m) * 0.5, 0.5 * length(box.high_m - box.low_m)};
  }
  void add_ball(const World::Bounds& box) { survey_.balls.push_back(ball_about(box)); }

  const WorldContent& content_;
  const std::vector<bool>& surveyed_;
  bool facets_;
  std::size_t listed_ = 0;
  SurfaceSurvey survey_;
  NormalTable table_;
  std::unordered_map<std::uint32_t, BodySurvey> bodies_;  // by template
};

}  // namespace

SurfaceSurvey survey_of(const WorldContent& content, const PieceWalk& walk, const std::vector<bool>& surveyed,
                        bool facets) {
  Surveyor surveyor(content, surveyed, facets);
  walk.visit([&](const PlacedPiece& piece) { surveyor.add(piece); });
  for (const Run& run : content.runs) surveyor.add(run);
  return std::move(surveyor).take();
}

}  // namespace ifov::geometry
