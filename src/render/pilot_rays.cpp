#include "render/pilot_rays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

#include "geometry/motion/moving_world.h"
#include "geometry/world.h"
#include "render/field/seen_through.h"
#include "render/field/thin_shadow_places.h"
#include "render/image_renderer.h"
#include "render/small_pieces.h"
#include "sampling/pixel_sampler.h"
#include "sampling/tile.h"
#include "sensor/camera.h"
#include "sensor/orthographic_camera.h"
#include "transport/mirrors/sun_images.h"

namespace ifov::render {

namespace {

/// Parts of a long object get a pilot ray each, this far apart or as far as it is wide: well below a pixel, so that a
/// following trace of its edges meets the next.
constexpr double kSpacing_px = 0.35;

/// What is thin gets one at either tip as well, of half its length: that may lie in a pixel of its own.
constexpr double kTip = 0.999;

/// An object whose image is wider than this in every direction meets the detection lattice anyway.
constexpr double kSeeded_px = 1.0;

/// However long an object is, it has no more pilot rays than this.
constexpr double kMostRaysOfOne = 1e5;

/// Faces of meshes are looked through one by one, copies too, while there are no more of them than this.
constexpr std::size_t kMostFaces = 2000000;
/// Shadows of small things are looked for while there are no more rays to it than this; where there are more they are
/// everywhere, and values meet them.
constexpr std::size_t kMostShadowRays = 300000;

/// As far away as this all places of a scene and its sensor are one.
constexpr double kFar_m = 1e13;

/// A face narrower than this is followed by no sampler (AccuracyOptions::thinnest_px): a wall seen from above.
constexpr double kThinnest_px = 1.0 / 80.0;

/// The image of an object's box: how long it is, and how wide across that direction.
struct Outline {
  double length_px = 0.0, width_px = 0.0;
  std::size_t along = 0;  ///< number of the side that looks longest
};

/// A wall looks as thin from above as it is, however tall; so sides are measured as they are seen.
Outline outline_of(const geometry::World::PlacedObject& object, const sensor::Camera& camera) {
  Outline outline;
  sampling::FocalPoint centre, end;
  if (!camera.project(object.centre_m, centre)) return outline;
  struct Side {
    double x = 0.0, y = 0.0;
  };
  Side sides[3];
  for (std::size_t s = 0; s < 3; ++s) {
    // Half of a half side: a long one may reach behind the camera.
    if (!camera.project(object.centre_m + 0.5 * object.half_sides_m[s], end)) continue;
    sides[s] = {2.0 * (end.x_px - centre.x_px), 2.0 * (end.y_px - centre.y_px)};
    const double length = 2.0 * std::hypot(sides[s].x, sides[s].y);
    if (length > outline.length_px) outline.length_px = length, outline.along = s;
  }
  if (outline.length_px == 0.0) return outline;
  const Side& longest = sides[outline.along];
  for (const Side& side : sides)
    outline.width_px += 4.0 * std::abs(side.x * longest.y - side.y * longest.x) / outline.length_px;
  return outline;
}

/// The image of a long thin triangle of a mesh: from a to b along its longest side, c beside it.
struct ThinFace {
  sampling::FocalPoint a, b, c;
  math::Point3 a_m, b_m, c_m;
  double length_px = 0.0;
  std::uint32_t object = 0, patch = 0, material = 0;
};

/// Whether a triangle is longer than a pixel; `thin`: and so narrow that the lattice may miss it.
bool is_long(const geometry::SurfacePiece& piece, const sensor::Camera& camera, ThinFace& face, bool& thin) {
  const math::Point3 corner_m[3] = {piece.scene_from_unit(math::Point3{0.0, 0.0, 0.0}),
                                    piece.scene_from_unit(math::Point3{1.0, 0.0, 0.0}),
                                    piece.scene_from_unit(math::Point3{0.0, 1.0, 0.0})};
  sampling::FocalPoint corner[3];
  for (int k = 0; k < 3; ++k)
    if (!camera.project(corner_m[k], corner[k])) return false;
  int first = 0;
  for (int k = 0; k < 3; ++k) {
    const sampling::FocalPoint p = corner[k], q = corner[(k + 1) % 3];
    const double length = std::hypot(q.x_px - p.x_px, q.y_px - p.y_px);
    if (length > face.length_px) face.length_px = length, first = k;
  }
  if (face.length_px <= kSeeded_px) return false;
  face.a = corner[first];
  face.b = corner[(first + 1) % 3];
  face.c = corner[(first + 2) % 3];
  face.a_m = corner_m[first];
  face.b_m = corner_m[(first + 1) % 3];
  face.c_m = corner_m[(first + 2) % 3];
  face.object = piece.object;
  face.patch = piece.patch;
  face.material = piece.material;
  const double twice_area = (face.b.x_px - face.a.x_px) * (face.c.y_px - face.a.y_px) -
                            (face.b.y_px - face.a.y_px) * (face.c.x_px - face.a.x_px);
  const double width = std::abs(twice_area) / face.length_px;
  thin = width <= kSpacing_px && width >= kThinnest_px;
  return true;
}

/// A side of a triangle, by its middle, which both triangles beside it have.
using SideKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::int64_t, std::int64_t>;
SideKey side_of(const ThinFace& face, int side) {
  constexpr double kSame_px = 1e-3;
  const sampling::FocalPoint corner[3] = {face.a, face.b, face.c};
  const sampling::FocalPoint p = corner[side], q = corner[(side + 1) % 3];
  return {face.object, face.patch, face.material, std::llround(0.5 * (p.x_px + q.x_px) / kSame_px),
          std::llround(0.5 * (p.y_px + q.y_px) / kSame_px)};
}

/// A large polygon may have been cut into thin triangles: drops those that make more than a strip with those beside them.
/// `visit_wide` calls with every long triangle that is not thin.
template <class VisitWide>
void keep_strips(std::vector<ThinFace>& faces, const VisitWide& visit_wide) {
  std::vector<std::size_t> parent(faces.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::map<SideKey, std::size_t> sides;
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (int side = 0; side < 3; ++side) {
      const auto [known, fresh] = sides.try_emplace(side_of(faces[k], side), k);
      if (!fresh) parent[root(k)] = root(known->second);
    }
  std::vector<std::uint8_t> part_of_more(faces.size(), 0);
  visit_wide([&](const ThinFace& wide) {
    for (int side = 0; side < 3; ++side)
      if (const auto known = sides.find(side_of(wide, side)); known != sides.end())
        part_of_more[root(known->second)] = 1;
  });
  // How wide they are together, across the side of one of them.
  struct Width {
    double low = INFINITY, high = -INFINITY;
  };
  std::vector<Width> width(faces.size());
  for (const ThinFace& f : faces) {
    const std::size_t whole = root(static_cast<std::size_t>(&f - faces.data()));
    const ThinFace& one = faces[whole];
    for (const sampling::FocalPoint p : {f.a, f.b, f.c}) {
      const double across = ((p.y_px - one.a.y_px) * (one.b.x_px - one.a.x_px) -
                             (p.x_px - one.a.x_px) * (one.b.y_px - one.a.y_px)) /
                            one.length_px;
      width[whole] = {std::min(width[whole].low, across), std::max(width[whole].high, across)};
    }
  }
  std::vector<ThinFace> kept;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (!part_of_more[root(k)] && width[root(k)].high - width[root(k)].low <= kSpacing_px)
      kept.push_back(faces[k]);
  faces.swap(kept);
}

/// Points in the middle of a triangle's image, all along it, where they are in the scene, and how wide it is.
template <class Add>
void points_along(const ThinFace& face, const Add& add) {
  const double ux = (face.b.x_px - face.a.x_px) / face.length_px,
               uy = (face.b.y_px - face.a.y_px) / face.length_px;
  const double along = (face.c.x_px - face.a.x_px) * ux + (face.c.y_px - face.a.y_px) * uy;
  const double across = (face.c.y_px - face.a.y_px) * ux - (face.c.x_px - face.a.x_px) * uy;
  const int parts = static_cast<int>(std::min(std::ceil(face.length_px / kSpacing_px), kMostRaysOfOne));
  const auto at = [&](double t) {
    const bool before = t < along;
    const double share = before ? t / along : (face.length_px - t) / (face.length_px - along);
    const double height = across * share;
    const math::Point3 end_m = before ? face.a_m : face.b_m;
    add({face.a.x_px + t * ux - 0.5 * height * uy, face.a.y_px + t * uy + 0.5 * height * ux},
        face.a_m + (0.5 * t / face.length_px) * (face.b_m - face.a_m) +
            0.5 * ((end_m - face.a_m) + share * (face.c_m - end_m)),
        std::abs(across));
  };
  const auto on_side = [&](double t) {
    return sampling::FocalPoint{face.a.x_px + t * ux, face.a.y_px + t * uy};
  };
  const double step = face.length_px / parts;
  for (int k = 0; k < parts; ++k) {
    at((k + 0.5) * step);
    if (k + 1 < parts)
      visit_pixel_between(on_side((k + 0.5) * step), on_side((k + 1.5) * step),
                          [&](sampling::FocalPoint, double share) { at((k + 0.5 + share) * step); });
  }
}

/// Calls `at` with points of the compact objects whose image is small in some direction, the number of the object (kNoObject of
/// what is long and thin) and how far the object reaches about the point.
template <class At>
void visit_small_objects(const geometry::World& world, const sensor::Camera& camera, const At& at) {
  for (std::size_t number = 0; number < world.object_count(); ++number) {
    const geometry::World::PlacedObject object = world.object(number);
    if (!object.compact) continue;
    const Outline outline = outline_of(object, camera);
    if (outline.width_px > kSeeded_px) continue;
    const double parts =
        std::min(std::ceil(outline.length_px / std::max(kSpacing_px, outline.width_px)), kMostRaysOfOne);
    if (outline.length_px <= kSeeded_px || parts <= 1.0) {
      at(object.pilot_point_m, static_cast<std::uint32_t>(number), object.radius_m);
      continue;
    }
    double across_m = 0.0;
    for (std::size_t side = 0; side < 3; ++side)
      if (side != outline.along) across_m += math::length(object.half_sides_m[side]);
    // What is thin may be met at one end and missed at the other.
    const bool thin = outline.width_px < kSpacing_px;
    const math::Vec3 half_m = object.half_sides_m[outline.along];
    sampling::FocalPoint last, next;
    bool any = false;
    const auto along = [&](double t) {
      const math::Point3 at_m = object.centre_m + half_m * t;
      if (thin) {
        const math::Point3 last_m = at_m - half_m * (2.0 / parts);
        const bool seen = camera.project(at_m, next);
        if (seen && any)
          visit_pixel_between(last, next, [&](sampling::FocalPoint, double share) {
            at(last_m + share * (at_m - last_m), sampling::Field::kNoObject, across_m);
          });
        last = next;
        any = seen;
      }
      at(at_m, thin ? sampling::Field::kNoObject : static_cast<std::uint32_t>(number), across_m);
    };
    for (int k = 0; k < static_cast<int>(parts); ++k) along((2.0 * k + 1.0) / parts - 1.0);
    if (thin)
      for (const double end : {-kTip, kTip})
        at(object.centre_m + half_m * end, sampling::Field::kNoObject, across_m);
  }
}

/// Calls `at` with places of what moves and when it is there, where the camera may see it then.
template <class At>
void visit_moving(const geometry::MovingWorld& world, const sensor::Camera& camera, const At& at) {
  constexpr int kTimes = 64, kMostLooks = 12;
  constexpr std::uint32_t kMostObjects = 1000;  // of one mover: where there are more, lattices meet it
  const bool any_time = camera.exposure_s() > 0.0 || camera.row_period_s() > 0.0;
  const double from_s = world.from_s(), to_s = world.to_s();
  for (std::size_t m = 0; m < world.mover_count(); ++m)
    for (std::uint32_t own = 0; own < std::min(world.objects_of(m), kMostObjects); ++own)
      for (int k = 0; k < (to_s > from_s ? kTimes : 1); ++k) {
        double time_s = from_s + (to_s - from_s) * (k + 0.5) / kTimes;
        geometry::World::PlacedObject object = world.object_at(m, own, time_s);
        sampling::FocalPoint point;
        bool seen = camera.project(object.pilot_point_m, point);
        // Of a scanner: the time at which it is in the line that is seen then.
        for (int look = 0; seen && look < (any_time ? 1 : kMostLooks); ++look) {
          time_s = camera.ray(point).time_s;
          object = world.object_at(m, own, time_s);
          seen = camera.project(object.pilot_point_m, point);
        }
        if (seen) at(object, time_s);
      }
}

/// Calls `at` with points of the image of long thin faces that are strips, where they are in the scene, and their width in pixels.
template <class At>
void visit_strips(const geometry::World& world, std::size_t materials, const sensor::Camera& camera,
                  const At& at) {
  if (world.triangle_count() > kMostFaces) return;
  const auto visit_long = [&](const auto& visitor) {
    world.visit_surfaces(
        geometry::WantedMaterials(materials, true), [&](const geometry::SurfacePiece& piece) {
          ThinFace face;
          bool thin = false;
          if (piece.kind == geometry::PieceKind::triangle && is_long(piece, camera, face, thin))
            visitor(face, thin);
        });
  };
  std::vector<ThinFace> faces;
  visit_long([&](const ThinFace& face, bool thin) {
    if (thin) faces.push_back(face);
  });
  if (!faces.empty())
    keep_strips(faces, [&](const auto& visitor) {
      visit_long([&](const ThinFace& face, bool thin) {
        if (!thin) visitor(face);
      });
    });
  for (const ThinFace& face : faces) points_along(face, at);
}

/// The shadows on level ground, in pixels, as an image of the scene that is seen from the Sun; none where it does not shine
/// down, or where the scene has no size.
std::optional<sensor::OrthographicCamera> seen_from_sun(const geometry::World& world,
                                                        const sensor::Camera& camera,
                                                        math::Vec3 towards_sun) {
  // At lower Suns shadows are longer still; that they are sought so far apart is enough.
  constexpr double kLowest_rad = 1.4;
  if (towards_sun.z <= 0.0) return std::nullopt;
  const geometry::World::Bounds bounds = world.bounds();
  sensor::OrthographicCamera::Settings settings;
  settings.gsd_m = camera.gsd_m(bounds.low_m + 0.5 * (bounds.high_m - bounds.low_m));
  if (!(settings.gsd_m > 0.0) || !std::isfinite(settings.gsd_m)) return std::nullopt;
  settings.width_px = settings.height_px = 1;
  settings.start_height_m = bounds.high_m.z;
  settings.view_zenith_rad = std::min(std::acos(std::min(towards_sun.z, 1.0)), kLowest_rad);
  settings.view_azimuth_rad = std::atan2(towards_sun.x, towards_sun.y);
  return sensor::OrthographicCamera(settings);
}

}  // namespace

PilotRays::PilotRays(const geometry::World& world, std::size_t materials, const sensor::Camera& camera,
                     std::span<const math::Vec3> towards_sun, const geometry::WantedMaterials& shining,
                     double margin_px, std::span<const math::Vec3> glare) {
  auto add_point = [&](sampling::FocalPoint point, std::uint32_t object, double radius_px = kSpacing_px) {
    if (point.x_px < -margin_px || point.y_px < -margin_px || point.x_px > camera.width_px() + margin_px ||
        point.y_px > camera.height_px() + margin_px)
      return;
    points_.push_back({point, object, radius_px});
  };
  auto add = [&](math::Point3 position_m, std::uint32_t object, double across_m = 0.0) {
    sampling::FocalPoint point;
    if (!camera.project(position_m, point)) return;
    const bool whole = across_m > 0.0 && object != sampling::Field::kNoObject;
    add_point(point, object, whole ? across_m / camera.gsd_m(position_m) : kSpacing_px);
  };
  visit_small_objects(world, camera, add);
  visit_strips(world, materials, camera, [&](sampling::FocalPoint point, math::Point3, double) {
    add_point(point, sampling::Field::kNoObject);
  });
  if (world.moving() != nullptr)
    visit_moving(*world.moving(), camera, [&](const geometry::World::PlacedObject& object, double time_s) {
      add(object.pilot_point_m, sampling::Field::kNoObject);
      for (const math::Vec3 towards : towards_sun) {
        const math::Ray away{.origin_m = object.centre_m - (1.01 * object.radius_m) * towards,
                             .direction = -1.0 * towards,
                             .time_s = time_s};
        geometry::SurfacePoint shaded;
        world.intersect({&away, 1}, {&shaded, 1});
        if (shaded.hit()) add(shaded.position_m, sampling::Field::kNoObject);
      }
    });
  // Objects that are small as a whole have a ray of their own.
  std::uint32_t last = sampling::Field::kNoObject;
  bool larger = false;
  const auto is_larger = [&](std::uint32_t number) {
    if (number != last) {
      const geometry::World::PlacedObject object = world.object(number);
      larger = !object.compact || outline_of(object, camera).width_px > kSeeded_px;
      last = number;
    }
    return larger;
  };
  visit_small_patches(world, materials, is_larger, camera,
                      [&](sampling::FocalPoint point) { add_point(point, sampling::Field::kNoObject); });
  visit_small_pieces(world, shining, camera,
                     [&](sampling::FocalPoint point) { add_point(point, sampling::Field::kNoObject); });

  for (const math::Vec3 direction : glare)
    add(math::Point3{} + kFar_m * direction, sampling::Field::kNoObject);

  if (!towards_sun.empty())
    if (const auto sun = seen_from_sun(world, camera, towards_sun[0])) {
      std::vector<math::Ray> rays;
      std::vector<double> widths_m;
      const auto shade = [&](math::Point3 at_m, double beyond_m, double width_m) {
        if (rays.size() > kMostShadowRays) return;
        widths_m.push_back(width_m);
        for (const math::Vec3 towards : towards_sun)
          rays.push_back({at_m - (1.01 * beyond_m) * towards, -1.0 * towards});
      };
      visit_small_objects(world, *sun, [&](math::Point3 at_m, std::uint32_t, double across_m) {
        shade(at_m, across_m, 2.0 * across_m);
      });
      visit_strips(world, materials, *sun, [&](sampling::FocalPoint, math::Point3 at_m, double width_px) {
        shade(at_m, 1e-6 * (1.0 + math::length(at_m - math::Point3{})), width_px * sun->gsd_m(at_m));
      });
      if (rays.size() <= kMostShadowRays) {
        std::vector<geometry::SurfacePoint> shaded(rays.size());
        world.intersect(rays, shaded);
        for (const geometry::SurfacePoint& point : shaded)
          if (point.hit()) add(point.position_m, sampling::Field::kNoObject);
        for (std::size_t k = 0; k < widths_m.size() && towards_sun.size() == kRimPoints; ++k)
          visit_thin_shadow(std::span(rays).subspan(kRimPoints * k).first<kRimPoints>(),
                            std::span(shaded).subspan(kRimPoints * k).first<kRimPoints>(), widths_m[k], k,
                            camera, [&](sampling::FocalPoint point, float share) {
                              const std::size_t before = points_.size();
                              add_point(point, sampling::Field::kNoObject);
                              if (points_.size() > before) points_.back().thin_share = share;
                            });
      }
    }

  lowest_row_ = static_cast<int>(std::floor(-margin_px));
  std::stable_sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) {
    return std::floor(a.point.y_px) < std::floor(b.point.y_px);
  });
  const int rows = static_cast<int>(std::ceil(camera.height_px() + margin_px)) - lowest_row_ + 1;
  first_of_row_.assign(static_cast<std::size_t>(rows) + 1, points_.size());
  for (std::size_t k = points_.size(); k-- > 0;)
    first_of_row_[static_cast<std::size_t>(static_cast<int>(std::floor(points_[k].point.y_px)) -
                                           lowest_row_)] = k;
  for (std::size_t row = first_of_row_.size() - 1; row-- > 0;)
    first_of_row_[row] = std::min(first_of_row_[row], first_of_row_[row + 1]);
}

PilotRays::Near PilotRays::near(sampling::PixelRect tile, double margin_px) const {
  Near found;
  const int last = static_cast<int>(first_of_row_.size()) - 1;
  const int low = std::clamp(static_cast<int>(std::floor(tile.y0 - margin_px)) - lowest_row_, 0, last);
  const int high = std::clamp(static_cast<int>(std::ceil(tile.y1 + margin_px)) - lowest_row_, 0, last);
  for (std::size_t k = first_of_row_[static_cast<std::size_t>(low)];
       k < first_of_row_[static_cast<std::size_t>(high)]; ++k) {
    const sampling::FocalPoint& point = points_[k].point;
    if (point.x_px >= tile.x0 - margin_px && point.x_px < tile.x1 + margin_px &&
        point.y_px >= tile.y0 - margin_px && point.y_px < tile.y1 + margin_px) {
      if (points_[k].thin_share > 0.0f) {
        found.thin_shadows.push_back({point, points_[k].thin_share});
        continue;
      }
      found.points.push_back(point);
      found.objects.push_back(points_[k].object);
      found.radii_px.push_back(points_[k].radius_px);
    }
  }
  return found;
}

std::vector<math::Vec3> PilotRays::sun_and_its_images(math::Vec3 sun, const transport::SunMirrors* mirrors) {
  std::vector<math::Vec3> directions = {sun};
  if (mirrors == nullptr) return directions;
  const transport::SunImages images(*mirrors, sun, SeenThrough::kMostReflectionsOfSun,
                                    transport::SunImages::kMost);
  for (const transport::SunImages::Image& image : images.images()) directions.push_back(image.direction);
  return directions;
}

double PilotRays::margin_px(const RenderJob& job) { return job.sampler.halo_px() + job.reach_px(); }

}  // namespace ifov::render
