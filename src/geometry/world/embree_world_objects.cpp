// Placed objects: what is kept of them, and what is worked out when it is asked for.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "geometry/growing_box.h"
#include "geometry/world/embree_world.h"

namespace ifov::geometry {

using math::Point3;
using math::Transform;
using math::Vec3;

namespace {

/// Seen from the side a cylinder is a rectangle.
bool turns_sharply(const Body& body) {
  return !body.mesh.triangles.empty() ||
         std::any_of(body.analytic.begin(), body.analytic.end(), [](const UnitPrimitive& p) {
           return p.kind != UnitKind::sphere && p.kind != UnitKind::hemisphere && p.kind != UnitKind::disk;
         });
}

}  // namespace

void EmbreeWorld::note_figures(const WorldContent& content, const PrototypePlan& plan) {
  figures_.resize(content.templates.size());
  for (std::size_t t = 0; t < figures_.size(); ++t) {
    const Template& one = content.templates[t];
    Figure& figure = figures_[t];
    if (one.plane) {
      figure.centre_m = figure.pilot_point_m = {0.0, 0.0, one.plane->z_m};
      figure.radius_m = std::numeric_limits<double>::infinity();
    } else if (one.field) {
      const World::Bounds b = one.field->bounds();
      const Point3 centre = b.low_m + (b.high_m - b.low_m) * 0.5;
      figure = {centre, one.field->middle(),    0.5 * length(b.high_m - b.low_m),
                b,      oriented_extent({}, b), centre};
    } else if (one.body.patch_count > 0) {
      const Body& body = one.body;
      figure = {body.centre_m,     body.pilot_point_m, body.radius_m,      body.bounds,
                body.half_sides_m, body.centre_m,      turns_sharply(body)};
    } else if (!plan.flat[t]) {
      // Its parts stand apart: boxes of boxes, and the pilot point of the largest part.
      GrowingBox box;
      double largest = -1.0;
      for (const TemplatePart& part : one.parts)
        for (std::size_t k = 0; k < part.copies(); ++k) {
          const Transform map = part.whole_from_copy(k);
          const Figure& inner = figures_[part.of];
          box.include(image_of(inner.bounds, map));
          figure.has_corners = figure.has_corners || inner.has_corners;
          const double size = inner.radius_m * largest_stretch(map);
          if (size > largest) largest = size, figure.pilot_point_m = map(inner.pilot_point_m);
        }
      figure.bounds = box.bounds;
      figure.centre_m = box.bounds.low_m + (box.bounds.high_m - box.bounds.low_m) * 0.5;
      figure.radius_m = 0.5 * length(box.bounds.high_m - box.bounds.low_m);
      figure.half_sides_m = oriented_extent({}, box.bounds);
    }
  }
}

void EmbreeWorld::note_objects(const WorldContent& content, const std::vector<bool>& instanced) {
  objects_.reserve(content.object_count);
  for (const Run& run : content.runs) {
    const bool is_instance = instanced[run.what.of];
    for (std::size_t k = 0; k < run.what.copies(); ++k) {
      Object object{run.what.of, kNoIndex, run.pilot_ray, is_instance};
      if (!is_instance) {
        object.where = static_cast<std::uint32_t>(transforms_.size());
        transforms_.push_back(run.what.whole_from_copy(k));
      }
      objects_.push_back(object);
    }
  }
}

void EmbreeWorld::note_presences(const WorldContent& content) {
  if (std::none_of(content.runs.begin(), content.runs.end(), [](const Run& r) { return r.presence; })) return;
  std::map<const Presence*, std::uint32_t> known;
  for (const Run& run : content.runs) {
    std::uint32_t index = PresenceTable::kAlways;
    if (run.presence) {
      const auto [entry, is_new] =
          known.try_emplace(run.presence.get(), static_cast<std::uint32_t>(visits_.presences.size()));
      if (is_new) visits_.presences.push_back(*run.presence);
      index = entry->second;
    }
    visits_.runs.push_back({run.first_object, index});
  }
}

World::PlacedObject EmbreeWorld::object(std::size_t number) const {
  const Object& object = objects_[number];
  const Figure& figure = figures_[object.of];
  const Transform map = object.is_instance ? Transform::translation(centre_m_ - Point3{}) *
                                                 set_from_scene_[object.where].inverse() *
                                                 Transform::translation(Point3{} - figure.set_origin_m)
                                           : transforms_[object.where];
  PlacedObject placed;
  placed.centre_m = map(figure.centre_m);
  placed.pilot_point_m = map(figure.pilot_point_m);
  placed.radius_m = figure.radius_m;
  if (std::isinf(figure.radius_m)) return placed;
  placed.radius_m *= largest_stretch(map);
  placed.compact = object.pilot_ray;
  HalfSides sides = figure.half_sides_m;
  for (Vec3& side : sides) side = map(side);
  std::sort(sides.begin(), sides.end(), [](Vec3 a, Vec3 b) { return dot(a, a) > dot(b, b); });
  placed.half_sides_m = sides;
  return placed;
}

}  // namespace ifov::geometry
