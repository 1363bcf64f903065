#include "transport/shapes/emitter_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "sampling/projected_polygon.h"
#include "sampling/warp.h"

namespace ifov::transport {

using geometry::PieceKind;
using math::Point3;
using math::Vec3;
using sampling::Point2;
using std::numbers::pi;

namespace {

/// What a side counts that is hidden by its own body unless one is within it.
constexpr double kHiddenSide = 1e-3;

/// Flat pieces whose size is a smaller part of their distance, and of their height above the horizon, are sampled by
/// area: their parts are seen alike to that part, and projected solid angles would lose digits.
constexpr double kFar = 0.01;

struct Corners {
  std::array<Vec3, 4> at;
  std::size_t count = 0;
  operator std::span<const Vec3>() const { return {at.data(), count}; }
};

Corners corners_of(PieceKind kind, const math::Transform& map, Point3 from_m) {
  const Vec3 a = map.origin_m() - from_m, x = map.column_x(), y = map.column_y();
  if (kind == PieceKind::triangle) return {{a, a + x, a + y, {}}, 3};
  return {{a, a + x, a + x + y, a + y}, 4};
}

}  // namespace

double highest_cosine(Vec3 normal, Vec3 to, double radius_m) {
  if (Receiver{{}, normal}.any_side()) return 1.0;
  const double distance2 = math::dot(to, to);
  if (distance2 <= radius_m * radius_m) return 1.0;
  const double distance = std::sqrt(distance2);
  const double cosine = math::dot(normal, to) / distance,
               sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double sine_of = radius_m / distance, cosine_of = std::sqrt(1.0 - sine_of * sine_of);
  return cosine >= cosine_of ? 1.0 : std::max(0.0, cosine * cosine_of + sine * sine_of);
}

EmitterShape::EmitterShape(const geometry::SurfacePiece& piece, bool closed)
    : kind_(piece.kind),
      closed_(closed),
      solid_(piece.solid),
      scene_from_unit_(piece.scene_from_unit),
      unit_from_scene_(piece.scene_from_unit.inverse()) {
  const math::Transform& map = scene_from_unit_;
  const Vec3 x = map.column_x(), y = map.column_y(), z = map.column_z();
  const Vec3 across = math::cross(x, y);
  const double stretch = geometry::area_m2(piece);
  const double a = math::length(x), b = math::length(y), c = math::length(z);
  switch (kind_) {
    case Kind::triangle:
      centre_m_ = map(Point3{1.0 / 3.0, 1.0 / 3.0, 0.0});
      radius_m_ = std::max({math::length(map.origin_m() - centre_m_),
                            math::length(map(Point3{1.0, 0.0, 0.0}) - centre_m_),
                            math::length(map(Point3{0.0, 1.0, 0.0}) - centre_m_)});
      break;
    case Kind::parallelogram:
      centre_m_ = map(Point3{0.5, 0.5, 0.0});
      radius_m_ = 0.5 * std::max(math::length(x + y), math::length(x - y));
      break;
    case Kind::open_cylinder:
      centre_m_ = map(Point3{0.0, 0.0, 0.5});
      radius_m_ = 0.5 * c + std::hypot(a, b);
      break;
    case Kind::disk:
      centre_m_ = map.origin_m();
      radius_m_ = std::hypot(a, b);
      break;
    case Kind::ball:
    case Kind::hemisphere:
      centre_m_ = map.origin_m();
      radius_m_ = std::sqrt(a * a + b * b + c * c);
      break;
  }
  flat_ = straight() || kind_ == Kind::disk;
  area_m2_ = flat_ ? stretch : 0.25 * stretch;
  if (flat_) normal_ = math::length(across) > 0.0 ? math::normalized(across) : Vec3{0.0, 0.0, 1.0};
  const double skew =
      std::max({std::abs(math::dot(x, y)), std::abs(math::dot(y, z)), std::abs(math::dot(z, x))});
  scale_ = std::max({a, b, c});
  round_ = (kind_ == Kind::ball || kind_ == Kind::hemisphere) && skew < 1e-9 * scale_ * scale_ &&
           std::min({a, b, c}) > (1.0 - 1e-9) * scale_;
  if (round_) radius_m_ = scale_;
}

double EmitterShape::self_hiding(Point3 at_m) const {
  if (!solid_ && !closed_) return 1.0;
  if (math::dot(at_m - centre_m_, normal_) > 0.0) return 1.0;
  if (closed_) return kHiddenSide;
  // Within the solid, whose other end lies along -z of the face's own frame.
  const Point3 p = unit_from_scene_(at_m);
  const bool within = kind_ == Kind::disk
                          ? p.x * p.x + p.y * p.y <= 1.0 && p.z >= -1.0
                          : p.x >= 0.0 && p.x <= 1.0 && p.y >= 0.0 && p.y <= 1.0 && p.z >= -2.0;
  return within ? 1.0 : kHiddenSide;
}

bool EmitterShape::far(const Receiver& receiver) const {
  const Vec3 to = centre_m_ - receiver.at_m;
  return radius_m_ < kFar * math::dot(to, receiver.normal);
}

double EmitterShape::reach_sr(const Receiver& receiver) const {
  if (kind_ == Kind::ball || kind_ == Kind::hemisphere) return reach_of_ball(receiver);
  const double hiding = self_hiding(receiver.at_m);
  if (!straight() || receiver.any_side() || far(receiver)) return hiding * reach_by_area(receiver);
  return hiding *
         sampling::ProjectedPolygon(corners_of(kind_, scene_from_unit_, receiver.at_m), receiver.normal)
             .projected_solid_angle_sr();
}

double EmitterShape::reach_by_area(const Receiver& receiver) const {
  const Vec3 to = centre_m_ - receiver.at_m;
  const double distance2 = std::max(math::dot(to, to), 0.25 * radius_m_ * radius_m_);
  const double facing =
      flat_ ? highest_cosine(normal_, math::dot(normal_, to) < 0.0 ? -to : to, straight() ? 0.0 : radius_m_)
            : 1.0;
  return area_m2_ * facing * highest_cosine(receiver.normal, to, straight() ? 0.0 : radius_m_) / distance2;
}

double EmitterShape::by_area(const Receiver& receiver, Vec3 direction) const {
  const double across = math::dot(direction, normal_);
  const double distance = math::dot(centre_m_ - receiver.at_m, normal_) / across;
  return distance > 0.0 ? distance * distance / (area_m2_ * std::abs(across)) : 0.0;
}

AimedDirection EmitterShape::aim(const Receiver& receiver, Point2 u) const {
  if (kind_ == Kind::ball || kind_ == Kind::hemisphere) return aim_at_ball(receiver, u);
  if (kind_ == Kind::open_cylinder) return aim_at_cylinder(receiver, u);
  AimedDirection aimed;
  if (straight() && !far(receiver)) {
    const sampling::ProjectedPolygon seen(corners_of(kind_, scene_from_unit_, receiver.at_m),
                                          receiver.normal);
    if (seen.projected_solid_angle_sr() <= 0.0) return aimed;
    aimed.direction = seen.sample(u);
    aimed.density =
        std::max(0.0, math::dot(aimed.direction, receiver.normal)) / seen.projected_solid_angle_sr();
    return aimed;
  }
  Point2 p = u;
  if (kind_ == Kind::disk)
    p = sampling::uniform_disk(u);
  else if (kind_ == Kind::triangle && u.x + u.y > 1.0)
    p = {1.0 - u.x, 1.0 - u.y};
  aimed.direction = math::normalized(scene_from_unit_(Point3{p.x, p.y, 0.0}) - receiver.at_m);
  aimed.density = by_area(receiver, aimed.direction);
  return aimed;
}

double EmitterShape::density(const Receiver& receiver, Vec3 direction, double distance_m) const {
  if (kind_ == Kind::ball || kind_ == Kind::hemisphere) return density_of_ball(receiver, direction);
  if (kind_ == Kind::open_cylinder) return density_of_cylinder(receiver, direction, distance_m);
  if (!straight() || far(receiver)) return by_area(receiver, direction);
  const double area =
      sampling::ProjectedPolygon(corners_of(kind_, scene_from_unit_, receiver.at_m), receiver.normal)
          .projected_solid_angle_sr();
  return area > 0.0 ? std::max(0.0, math::dot(direction, receiver.normal)) / area : 0.0;
}

// A ball in the frame where it is a sphere of radius 1: the cone of directions that meet it has the sine 1 / distance. A
// linear map A takes directions w to A w / |A w| and solid angles to |det A| / |A w|^3 of themselves.

double EmitterShape::reach_of_ball(const Receiver& receiver) const {
  const Vec3 from = unit_from_scene_(receiver.at_m) - Point3{};
  const double distance2 = math::dot(from, from);
  if (distance2 <= 1.0) return 0.0;
  const Vec3 towards = math::normalized(centre_m_ - receiver.at_m);
  double sine2 = 1.0 / distance2;
  if (!round_) {
    const Vec3 mapped = unit_from_scene_(towards);
    sine2 =
        std::min(1.0, sine2 * std::abs(unit_from_scene_.determinant()) / std::pow(math::length(mapped), 3.0));
  }
  // A cap that the horizon cuts goes down to nothing as its last part sets.
  const double sine =
      round_ ? std::sqrt(sine2) : std::min(1.0, radius_m_ / math::length(centre_m_ - receiver.at_m));
  const double cosine = receiver.any_side() ? 1.0 : math::dot(towards, receiver.normal);
  if (cosine <= -sine) return 0.0;
  return pi * sine2 * (cosine >= sine ? cosine : (cosine + sine) * (cosine + sine) / (4.0 * sine));
}

AimedDirection EmitterShape::aim_at_ball(const Receiver& receiver, Point2 u) const {
  const Vec3 from = unit_from_scene_(receiver.at_m) - Point3{};
  const double distance = math::length(from);
  AimedDirection aimed;
  if (distance <= 1.0) return aimed;
  const double half_angle = std::asin(1.0 / distance);
  if (round_) {
    const Vec3 axis = math::normalized(centre_m_ - receiver.at_m);
    aimed.direction = sampling::SolarDisc(half_angle).sample(axis, receiver.normal, u).direction;
  } else {
    aimed.direction =
        math::normalized(scene_from_unit_(sampling::UniformCone(half_angle).sample(-from / distance, u)));
  }
  aimed.density = density_of_ball(receiver, aimed.direction);
  return aimed;
}

double EmitterShape::density_of_ball(const Receiver& receiver, Vec3 direction) const {
  const Vec3 from = unit_from_scene_(receiver.at_m) - Point3{};
  const double distance = math::length(from);
  if (distance <= 1.0) return 0.0;
  const double half_angle = std::asin(1.0 / distance);
  if (round_) {
    // That it is within the cone is known: it met the ball.
    const sampling::SolarDisc disc(half_angle);
    const Vec3 axis = math::normalized(centre_m_ - receiver.at_m);
    return disc.uncut(axis, receiver.normal) ? std::max(0.0, math::dot(receiver.normal, direction)) /
                                                   disc.projected_solid_angle_sr(axis, receiver.normal)
                                             : 1.0 / disc.solid_angle_sr();
  }
  const double stretch = math::length(unit_from_scene_(direction));
  return std::abs(unit_from_scene_.determinant()) / (stretch * stretch * stretch) /
         sampling::UniformCone(half_angle).solid_angle_sr();
}

namespace {

/// The azimuths of a tube of radius 1 that face a point: all of them from within.
struct FacingAzimuths {
  double middle = 0.0, half = pi;
  explicit FacingAzimuths(Point3 from) {
    const double away = std::hypot(from.x, from.y);
    if (away <= 1.0) return;
    middle = std::atan2(from.y, from.x);
    half = std::acos(1.0 / away);
  }
};

/// Heights of a tube from 0 to 1, seen from a point at the distance of its axis in equal angles: what is near is seen wide
/// (Kulla and Fajardo 2012, "Importance sampling techniques for path tracing in participating media", equiangular).
struct HeightsInAngles {
  double foot = 0.0, away = 1.0, first = 0.0, last = 1.0;
  HeightsInAngles(const math::Transform& map, Point3 unit_from) {
    const Vec3 axis = map.column_z();
    const double length = math::length(axis);
    const Vec3 to = map(unit_from) - map.origin_m();
    foot = math::dot(to, axis) / (length * length);
    const double radius = std::min(math::length(map.column_x()), math::length(map.column_y()));
    away = std::max(math::length(to - foot * axis), radius) / length;
    first = std::atan(-foot / away);
    last = std::atan((1.0 - foot) / away);
  }
  double height(double u) const {
    return std::clamp(foot + away * std::tan(first + u * (last - first)), 0.0, 1.0);
  }
  double density(double height) const {
    const double above = height - foot;
    return away / ((last - first) * (away * away + above * above));
  }
};

/// Area vector of a tube's surface per radian and unit of height.
Vec3 band_area(const math::Transform& map, double azimuth) {
  return math::cross(map.column_y() * std::cos(azimuth) - map.column_x() * std::sin(azimuth), map.column_z());
}

}  // namespace

AimedDirection EmitterShape::aim_at_cylinder(const Receiver& receiver, Point2 u) const {
  const Point3 from = unit_from_scene_(receiver.at_m);
  const FacingAzimuths facing(from);
  const HeightsInAngles heights(scene_from_unit_, from);
  const double azimuth = facing.middle + (2.0 * u.x - 1.0) * facing.half, height = heights.height(u.y);
  const Vec3 to = scene_from_unit_(Point3{std::cos(azimuth), std::sin(azimuth), height}) - receiver.at_m;
  AimedDirection aimed;
  const double distance = math::length(to);
  if (!(distance > 0.0)) return aimed;
  aimed.direction = to / distance;
  aimed.density =
      distance * distance * heights.density(height) /
      (2.0 * facing.half * std::abs(math::dot(band_area(scene_from_unit_, azimuth), aimed.direction)));
  if (!std::isfinite(aimed.density)) aimed.density = 0.0;
  return aimed;
}

double EmitterShape::density_of_cylinder(const Receiver& receiver, Vec3 direction, double distance_m) const {
  const Point3 from = unit_from_scene_(receiver.at_m);
  const FacingAzimuths facing(from);
  const Point3 met = unit_from_scene_(receiver.at_m + direction * distance_m);
  const double azimuth = std::atan2(met.y, met.x);
  if (facing.half < pi && std::abs(std::remainder(azimuth - facing.middle, 2.0 * pi)) > facing.half)
    return 0.0;
  const double density =
      distance_m * distance_m * HeightsInAngles(scene_from_unit_, from).density(met.z) /
      (2.0 * facing.half * std::abs(math::dot(band_area(scene_from_unit_, azimuth), direction)));
  return std::isfinite(density) ? density : 0.0;
}

SurfaceSample EmitterShape::ball_point(Point3 unit) const {
  // Area vectors go by the transposed inverse.
  const math::Transform& inverse = unit_from_scene_;
  const Vec3 p = unit - Point3{};
  const Vec3 normal{math::dot(inverse.column_x(), p), math::dot(inverse.column_y(), p),
                    math::dot(inverse.column_z(), p)};
  const double stretch = math::length(normal) / std::abs(inverse.determinant());
  return {scene_from_unit_(unit), math::normalized(normal),
          1.0 / ((kind_ == Kind::hemisphere ? 2.0 : 4.0) * pi * stretch)};
}

SurfaceSample EmitterShape::point(Point2 u) const {
  switch (kind_) {
    case Kind::ball:
    case Kind::hemisphere: {
      const double z = kind_ == Kind::ball ? 1.0 - 2.0 * u.y : 1.0 - u.y, turn = 2.0 * pi * u.x,
                   r = std::sqrt(std::max(0.0, 1.0 - z * z));
      return ball_point({r * std::cos(turn), r * std::sin(turn), z});
    }
    case Kind::open_cylinder: {
      const double azimuth = 2.0 * pi * u.x;
      const Vec3 area = band_area(scene_from_unit_, azimuth);
      return {scene_from_unit_(Point3{std::cos(azimuth), std::sin(azimuth), u.y}), math::normalized(area),
              1.0 / (2.0 * pi * math::length(area))};
    }
    case Kind::disk: return flat_point(sampling::uniform_disk(u));
    case Kind::triangle: return flat_point(u.x + u.y > 1.0 ? Point2{1.0 - u.x, 1.0 - u.y} : u);
    case Kind::parallelogram: return flat_point(u);
  }
  return {};
}

SurfaceSample EmitterShape::flat_point(Point2 unit) const {
  return {scene_from_unit_(Point3{unit.x, unit.y, 0.0}), normal_, 1.0 / area_m2_};
}

double EmitterShape::point_density(Point3 at_m) const {
  const Point3 unit = unit_from_scene_(at_m);
  switch (kind_) {
    case Kind::ball:
    case Kind::hemisphere: return ball_point(Point3{} + math::normalized(unit - Point3{})).density;
    case Kind::open_cylinder:
      return 1.0 / (2.0 * pi * math::length(band_area(scene_from_unit_, std::atan2(unit.y, unit.x))));
    case Kind::disk:
    case Kind::triangle:
    case Kind::parallelogram: return 1.0 / area_m2_;
  }
  return 0.0;
}

}  // namespace ifov::transport
