// What the world tells of the surfaces of its objects.
#include <algorithm>
#include <cmath>

#include "geometry/world/embree_world.h"

namespace ifov::geometry {

using math::Point3;
using math::Transform;
using math::Vec3;

namespace {

/// The triangles that Embree has of a set.
class EmbreeTriangles {
 public:
  EmbreeTriangles(RTCScene scene, unsigned geometry) {
    RTCGeometry g = rtcGetGeometry(scene, geometry);
    vertices_ = static_cast<const float*>(rtcGetGeometryBufferData(g, RTC_BUFFER_TYPE_VERTEX, 0));
    triangles_ = static_cast<const Triangle*>(rtcGetGeometryBufferData(g, RTC_BUFFER_TYPE_INDEX, 0));
  }
  Point3 corner(std::size_t triangle, std::size_t k) const {
    const float* v = vertices_ + 3 * std::size_t{triangles_[triangle][k]};
    return {double(v[0]), double(v[1]), double(v[2])};
  }

 private:
  const float* vertices_;
  const Triangle* triangles_;
};

double triangle_area(Point3 a, Point3 b, Point3 c) { return 0.5 * length(cross(b - a, c - a)); }

/// The faces of an analytic shape that `map` brings from its unit frame; `piece` holds what they have in common.
void visit_faces(UnitKind shape, const Transform& map, SurfacePiece piece, const PieceVisitor& visitor) {
  const std::uint32_t patch = piece.patch;
  const auto face = [&](PieceKind kind, std::uint32_t number, const Transform& scene_from_face, bool solid) {
    piece.kind = kind;
    piece.patch = patch + number;
    piece.scene_from_unit = scene_from_face;
    piece.solid = solid;
    visitor(piece);
  };
  if (shape->visit_pieces != nullptr) shape->visit_pieces(map, face);
}

}  // namespace

/// Visits the pieces of a body, or of the bodies that lie in the scene itself.
class EmbreeWorld::SurfaceWalk {
 public:
  SurfaceWalk(const EmbreeWorld& world, const WantedMaterials& wanted, const PieceVisitor& visitor)
      : world_(world), wanted_(wanted), visitor_(visitor) {}

  /// `only`: whose the triangles are; null: their owners among the copies.
  void triangles(const TriangleSet& set, RTCScene scene, unsigned geometry, const Piece* only,
                 const Transform& scene_from_set) const {
    if (set.facets.empty()) return;
    const EmbreeTriangles triangles(scene, geometry);
    for (std::uint32_t t = 0; t < set.facets.size(); ++t) {
      const Piece& owner = only != nullptr ? *only : world_.copies_[set.owner(t)];
      if (is_wanted(owner, set.tags[t].slot))
        triangle(owner, triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2),
                 scene_from_set, set.number(t), set.tags[t]);
    }
  }

  void mesh(const ChunkedMesh& chunked, const Piece& owner, const Transform& scene_from_set) const {
    const MeshLists& mesh = chunked.mesh();
    const Transform map = scene_from_set * chunked.set_from_object();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const FacetTag tag{mesh.patches[t], mesh.slots.empty() ? 0 : mesh.slots[t]};
      const Triangle& v = mesh.triangles[t];
      if (is_wanted(owner, tag.slot))
        triangle(owner, mesh.vertices_m[v[0]], mesh.vertices_m[v[1]], mesh.vertices_m[v[2]], map, t, tag);
    }
  }

  void analytic(const AnalyticSet& set, const Piece* only, const Transform& scene_from_set) const {
    for (std::uint32_t s = 0; s < set.shapes.size(); ++s) {
      const UnitPrimitive& shape = set.shapes[s];
      const Piece& owner = only != nullptr ? *only : world_.copies_[set.owners[s]];
      if (!is_wanted(owner, shape.slot)) continue;
      SurfacePiece piece;
      piece.object = owner.object;
      piece.primitive = s + owner.first_analytic;
      piece.patch = owner.first_patch + shape.patch;
      piece.material = world_.materials_[owner.materials + shape.slot];
      visit_faces(shape.kind, scene_from_set * shape.unit_from_object.inverse(), piece, visitor_);
    }
  }

  bool is_wanted(const Piece& owner, std::uint32_t slot) const {
    return wanted_[world_.materials_[owner.materials + slot]];
  }

 private:
  void triangle(const Piece& owner, Point3 a, Point3 b, Point3 c, const Transform& scene_from_set,
                std::uint32_t number, FacetTag tag) const {
    SurfacePiece piece;
    const Vec3 x = scene_from_set(b - a), y = scene_from_set(c - a);
    piece.scene_from_unit = Transform::from_columns(x, y, math::cross(x, y), scene_from_set(a));
    piece.object = owner.object;
    piece.primitive = number + owner.first_triangle;
    piece.patch = owner.first_patch + tag.patch;
    piece.material = world_.materials_[owner.materials + tag.slot];
    visitor_(piece);
  }

  const EmbreeWorld& world_;
  const WantedMaterials& wanted_;
  const PieceVisitor& visitor_;
};

void EmbreeWorld::visit_surfaces(const WantedMaterials& wanted, const PieceVisitor& visitor) const {
  visit_copied(wanted, visitor);
  const std::vector<std::vector<double>> by_slot = slot_areas();
  const SurfaceWalk walk(*this, wanted, visitor);
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Piece& owner = instances_[i];
    bool any = false;
    for (std::uint32_t slot = 0; slot < by_slot[owner.of].size(); ++slot)
      any |= by_slot[owner.of][slot] > 0.0 && walk.is_wanted(owner, slot);
    if (!any) continue;
    const Prototype& prototype = *prototypes_[owner.of];
    const Transform scene_from_set =
        Transform::translation(centre_m_ - Point3{}) * set_from_scene_[i].inverse();
    walk.triangles(prototype.triangles, prototype.scene.get(), 0, &owner, scene_from_set);
    if (prototype.chunked) walk.mesh(*prototype.chunked, owner, scene_from_set);
    walk.analytic(prototype.analytic, &owner, scene_from_set);
  }
}

void EmbreeWorld::visit_copied(const WantedMaterials& wanted, const PieceVisitor& visitor) const {
  const SurfaceWalk walk(*this, wanted, visitor);
  const Transform scene_from_centred = Transform::translation(centre_m_ - Point3{});
  const bool one_table = storage_.instance_table && !instances_.empty();
  const auto geometry =
      static_cast<unsigned>(storage_.instance_table ? (one_table ? 1 : 0) : instances_.size());
  walk.triangles(triangles_, scene_.get(), geometry, nullptr, scene_from_centred);
  walk.analytic(analytic_, nullptr, scene_from_centred);
  for (const auto& mesh : chunked_) walk.mesh(*mesh, copies_[mesh->owner()], scene_from_centred);
}

std::vector<std::vector<double>> EmbreeWorld::slot_areas() const {
  std::vector<std::vector<double>> areas(prototypes_.size());
  for (std::size_t t = 0; t < prototypes_.size(); ++t) {
    if (!prototypes_[t]) continue;
    const Prototype& prototype = *prototypes_[t];
    const auto add = [&](std::uint32_t slot, double area) {
      if (areas[t].size() <= slot) areas[t].resize(slot + 1, 0.0);
      areas[t][slot] += area;
    };
    if (!prototype.triangles.facets.empty()) {
      const EmbreeTriangles triangles(prototype.scene.get(), 0);
      for (std::size_t k = 0; k < prototype.triangles.facets.size(); ++k)
        add(prototype.triangles.tags[k].slot,
            triangle_area(triangles.corner(k, 0), triangles.corner(k, 1), triangles.corner(k, 2)));
    }
    if (prototype.chunked) {
      const MeshLists& mesh = prototype.chunked->mesh();
      for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        const Triangle& v = mesh.triangles[k];
        add(mesh.slots.empty() ? 0 : mesh.slots[k],
            triangle_area(mesh.vertices_m[v[0]], mesh.vertices_m[v[1]], mesh.vertices_m[v[2]]));
      }
    }
    for (const UnitPrimitive& shape : prototype.analytic.shapes)
      visit_faces(shape.kind, shape.unit_from_object.inverse(), {},
                  [&](const SurfacePiece& piece) { add(shape.slot, area_m2(piece)); });
  }
  return areas;
}

std::vector<double> EmbreeWorld::surface_areas_m2(std::size_t materials) const {
  std::vector<double> areas(materials, 0.0);
  visit_copied(WantedMaterials(materials, true),
               [&](const SurfacePiece& piece) { areas[piece.material] += area_m2(piece); });
  const std::vector<std::vector<double>> by_slot = slot_areas();
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const Piece& owner = instances_[i];
    const double shrink = std::cbrt(std::abs(set_from_scene_[i].determinant()));
    for (std::size_t slot = 0; slot < by_slot[owner.of].size(); ++slot)
      areas[materials_[owner.materials + slot]] += by_slot[owner.of][slot] / (shrink * shrink);
  }
  for (const PlacedField& placed : fields_) {
    const Bounds bounds = placed.field->bounds();
    const double shrink = std::cbrt(std::abs(placed.field_from_centred.determinant()));
    areas[placed.material] +=
        (bounds.high_m.x - bounds.low_m.x) * (bounds.high_m.y - bounds.low_m.y) / (shrink * shrink);
  }
  double all = 1.0;
  for (const double area : areas) all += area;
  for (const PlaneObject& plane : planes_) areas[plane.material] += all;
  return areas;
}

}  // namespace ifov::geometry
