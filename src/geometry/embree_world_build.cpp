// Construction of the world: where everything stands, what becomes an instance, Embree's trees.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "geometry/embree_world.h"
#include "geometry/oriented_extent.h"

namespace ifov::geometry {
namespace {

using math::Point3;
using math::Transform;
using math::Vec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Up to this many primitives a copy in the scene costs less than an instance.
constexpr std::size_t kCopiedTriangles = 4, kCopiedShapes = 2;

bool better_copied(const Template& t) {
  return t.uses == 1 ||
         (t.body.mesh.triangles.size() <= kCopiedTriangles && t.body.analytic.size() <= kCopiedShapes);
}

Transform moved_by(Point3 centre_m, double sign) {
  return Transform::translation({sign * centre_m.x, sign * centre_m.y, sign * centre_m.z});
}

/// Bounds of a box's image.
World::Bounds image_of(const World::Bounds& b, const Transform& map) {
  const Point3 middle = map(b.low_m + (b.high_m - b.low_m) * 0.5);
  const Vec3 half = (b.high_m - b.low_m) * 0.5;
  const Vec3 x = map.column_x() * half.x, y = map.column_y() * half.y, z = map.column_z() * half.z;
  const Vec3 reach{std::abs(x.x) + std::abs(y.x) + std::abs(z.x),
                   std::abs(x.y) + std::abs(y.y) + std::abs(z.y),
                   std::abs(x.z) + std::abs(y.z) + std::abs(z.z)};
  return {middle - reach, middle + reach};
}

/// Bounds of a placed body, close where that is cheap: by its vertices and shapes, or by its box.
World::Bounds placed_bounds(const Body& body, const Transform& scene_from_object, bool copied) {
  if (!copied) return image_of(body.bounds, scene_from_object);
  World::Bounds b{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  const auto include = [&](Point3 low, Point3 high) {
    b.low_m = {std::min(b.low_m.x, low.x), std::min(b.low_m.y, low.y), std::min(b.low_m.z, low.z)};
    b.high_m = {std::max(b.high_m.x, high.x), std::max(b.high_m.y, high.y), std::max(b.high_m.z, high.z)};
  };
  for (const Triangle& t : body.mesh.triangles) {
    for (const std::uint32_t i : t) {
      const Point3 p = scene_from_object(body.mesh.vertices_m[i]);
      include(p, p);
    }
  }
  for (const UnitPrimitive& p : body.analytic) {
    const World::Bounds part = unit_bounds(p.kind, scene_from_object * p.unit_from_object.inverse());
    include(part.low_m, part.high_m);
  }
  return b;
}

}  // namespace

EmbreeWorld::EmbreeWorld(WorldContent content, int threads) : device_(make_device(threads)) {
  std::vector<bool> instanced(content.templates.size());
  for (std::size_t t = 0; t < instanced.size(); ++t)
    instanced[t] = !content.templates[t].plane && !better_copied(content.templates[t]);
  place_objects(content);
  materials_ = std::move(content.materials);
  build_scene(content, instanced);
  keep_attributes(content);
}

void EmbreeWorld::place_objects(const WorldContent& content) {
  const std::size_t count = content.placements.size();
  objects_.reserve(count);
  materials_of_.reserve(count);
  std::vector<HalfSides> sides_of;
  for (const Template& t : content.templates)
    sides_of.push_back(oriented_extent(
        t.body.analytic.empty() ? std::span<const Point3>(t.body.mesh.vertices_m) : std::span<const Point3>(),
        t.body.bounds));
  bool any = false;
  for (const Placement& place : content.placements) {
    const Template& t = content.templates[place.of];
    const Transform& map = place.scene_from_object;
    materials_of_.push_back(place.materials);
    PlacedObject object;
    if (t.plane) {
      object.centre_m = object.seed_m = map(Point3{0.0, 0.0, t.plane->z_m});
      object.radius_m = kInfinity;
    } else {
      object.centre_m = map(t.body.centre_m);
      object.radius_m = t.body.radius_m * largest_stretch(map);
      object.seed_m = map(t.body.seed_m);
      object.compact = place.seed;
      HalfSides sides = sides_of[place.of];
      for (Vec3& side : sides) side = map(side);
      std::sort(sides.begin(), sides.end(), [](Vec3 a, Vec3 b) { return dot(a, a) > dot(b, b); });
      object.half_length_m = sides[0];
      object.width_m = 2.0 * length(sides[1]);
      const Bounds b = placed_bounds(t.body, map, better_copied(t));
      if (!any) bounds_ = b;
      any = true;
      bounds_.low_m = {std::min(bounds_.low_m.x, b.low_m.x), std::min(bounds_.low_m.y, b.low_m.y),
                       std::min(bounds_.low_m.z, b.low_m.z)};
      bounds_.high_m = {std::max(bounds_.high_m.x, b.high_m.x), std::max(bounds_.high_m.y, b.high_m.y),
                        std::max(bounds_.high_m.z, b.high_m.z)};
    }
    objects_.push_back(object);
  }

  centre_m_ = bounds_.low_m + (bounds_.high_m - bounds_.low_m) * 0.5;
  const Vec3 half = (bounds_.high_m - bounds_.low_m) * 0.5;
  scale_m_ = std::max({half.x, half.y, half.z});
  // Embree's floats err by a few units of 2^-24 of the scene's size; at grazing incidence by many times that.
  window_m_ = std::ldexp(scale_m_, -17);
  triangle_offset_m_ = std::ldexp(scale_m_, -22);
  const double padding = std::ldexp(scale_m_, -20);
  padded_ = {{-half.x - padding, -half.y - padding, -half.z - padding},
             {half.x + padding, half.y + padding, half.z + padding}};
}

void EmbreeWorld::build_scene(WorldContent& content, const std::vector<bool>& instanced) {
  const std::size_t count = content.placements.size();
  first_triangle_.assign(count, 0);
  first_analytic_.assign(count, 0);
  analytic_count_.assign(count, 0);
  const double padding = std::ldexp(scale_m_, -20);

  // Rays reach an instance with the rounding of the scene, seen at the instance's scale.
  std::vector<double> shrink(content.templates.size(), 1.0);
  for (const Placement& place : content.placements)
    if (instanced[place.of])
      shrink[place.of] = std::max(shrink[place.of], largest_stretch(place.scene_from_object.inverse()));

  prototypes_.resize(content.templates.size());
  for (std::size_t t = 0; t < content.templates.size(); ++t) {
    if (!instanced[t] || content.templates[t].uses == 0) continue;
    const Body& body = content.templates[t].body;
    auto prototype = std::make_unique<Prototype>();
    const Transform set_from_object = moved_by(body.centre_m, -1.0);
    prototype->triangles.append(body, set_from_object);
    prototype->analytic.append(body, set_from_object);
    prototype->analytic.padding_m = padding * shrink[t];
    // In a heap of leaves there is nothing behind a shared vertex to leak into.
    prototype->scene = make_scene(device_.get(), 20 * body.surface_triangles > body.mesh.triangles.size());
    if (!prototype->triangles.facets.empty())
      attach_triangles(device_.get(), prototype->scene.get(), 0, prototype->triangles);
    if (!prototype->analytic.shapes.empty())
      attach_analytic(device_.get(), prototype->scene.get(), 1, prototype->analytic);
    commit(device_.get(), prototype->scene.get());
    prototypes_[t] = std::move(prototype);
  }

  const Transform centred_from_scene = moved_by(centre_m_, -1.0);
  std::vector<Transform> scene_from_set;
  bool any = false;
  for (std::uint32_t object = 0; object < count; ++object) {
    const Placement& place = content.placements[object];
    const Template& t = content.templates[place.of];
    if (t.plane) {
      planes_.push_back({objects_[object].seed_m.z - centre_m_.z, object, place.scene_from_object.inverse()});
      continue;
    }
    any = true;
    triangle_count_ += t.body.mesh.triangles.size();
    analytic_count_[object] = static_cast<std::uint32_t>(t.body.analytic.size());
    const Transform centred_from_object = centred_from_scene * place.scene_from_object;
    if (instanced[place.of]) {
      scene_from_set.push_back(centred_from_object * moved_by(t.body.centre_m, 1.0));
      instance_object_.push_back(object);
    } else {
      if (triangles_.facets.size() + t.body.mesh.triangles.size() >= kNoIndex)
        throw InputError("the scene has too many triangles");
      first_triangle_[object] = static_cast<std::uint32_t>(triangles_.facets.size());
      first_analytic_[object] = static_cast<std::uint32_t>(analytic_.shapes.size());
      triangles_.append(t.body, centred_from_object);
      triangles_.owners.resize(triangles_.facets.size(), object);
      analytic_.append(t.body, centred_from_object);
      analytic_.owners.resize(analytic_.shapes.size(), object);
    }
  }
  if (!any) return;

  analytic_.padding_m = padding;
  scene_ = make_scene(device_.get(), true);
  const auto instances = static_cast<unsigned>(scene_from_set.size());
  set_from_scene_.reserve(instances);
  for (unsigned i = 0; i < instances; ++i) {
    set_from_scene_.push_back(scene_from_set[i].inverse());
    const std::uint32_t of = content.placements[instance_object_[i]].of;
    attach_instance(device_.get(), scene_.get(), i, prototypes_[of]->scene.get(), scene_from_set[i]);
  }
  if (!triangles_.facets.empty()) attach_triangles(device_.get(), scene_.get(), instances, triangles_);
  if (!analytic_.shapes.empty()) attach_analytic(device_.get(), scene_.get(), instances + 1, analytic_);
  commit(device_.get(), scene_.get());
}

void EmbreeWorld::keep_attributes(WorldContent& content) {
  const std::size_t count = content.placements.size();
  std::vector<std::uint32_t> kept(content.templates.size(), kNoIndex);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    TriangleMesh& mesh = content.templates[t].body.mesh;
    if (content.templates[t].uses == 0 || (mesh.normals.empty() && mesh.uvs.empty())) continue;
    kept[t] = static_cast<std::uint32_t>(attributes_.size());
    attributes_.push_back({std::move(mesh)});
  }
  if (attributes_.empty()) return;
  attributes_of_.assign(count, kNoIndex);
  attribute_map_of_.assign(count, 0);
  for (std::size_t object = 0; object < count; ++object) {
    const Placement& place = content.placements[object];
    if (kept[place.of] == kNoIndex) continue;
    attributes_of_[object] = kept[place.of];
    attribute_map_of_[object] = static_cast<std::uint32_t>(object_from_scene_.size());
    object_from_scene_.push_back(place.scene_from_object.inverse());
  }
}

}  // namespace ifov::geometry
