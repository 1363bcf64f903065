#include "transport/shapes/round_mirror.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sampling/warp.h"

namespace ifov::transport {

namespace {

using math::Point3;
using math::Vec3;

/// Shapes that are stretched by less count as round.
constexpr double kRound = 1e-6;
constexpr double kSmallestTurn = 1e-15;  // rad
/// What was met this near to the surface, in radii, lies on it.
constexpr double kOnSurface = 1e-6;

/// A direction in the plane of reflection, as cosine and sine of its angle from the receiver's.
struct Turn {
  double c = 1.0, s = 0.0;
  Turn by(Turn other) const { return {c * other.c - s * other.s, s * other.c + c * other.s}; }
  double sine_to(Turn other) const { return c * other.s - s * other.c; }
  double cosine_to(Turn other) const { return c * other.c + s * other.s; }
};

Turn unit(double c, double s) {
  const double length = std::sqrt(c * c + s * s);
  return {c / length, s / length};
}

/// The normal of a circle of radius 1 at which light is reflected to a point 1 / `near` from its centre, from a place
/// 1 / `nearness` away in the direction `light`; from infinity where that is 0. On the arc between the two the angle of
/// incidence falls and the angle of exitance grows, so that there is one; none where the light is in the circle's shadow.
std::optional<Turn> reflecting_turn(double near, double nearness, Turn light) {
  // Either sees the circle up to a horizon: the one sees beyond that of the other.
  const Turn own_horizon{near, std::sqrt((1.0 - near) * (1.0 + near))},
      far_horizon{nearness, std::sqrt((1.0 - nearness) * (1.0 + nearness))};
  if (!(light.c > own_horizon.by(far_horizon).c)) return {};
  Turn low{}, high = light, at = unit(1.0 + light.c, light.s);
  for (int iteration = 0; iteration < 100; ++iteration) {
    // Of both sides, in units of their distances: along the normal and across it.
    const double along = at.c - near, across = at.s;
    const double far_along = at.cosine_to(light) - nearness, far_across = at.sine_to(light);
    const double sine = far_across * along - far_along * across,
                 cosine = far_along * along + far_across * across;
    (sine > 0.0 || (sine == 0.0 && cosine < 0.0) ? low : high) = at;
    Turn next = unit(low.c + high.c, low.s + high.s);
    if (cosine > 0.0) {
      const double slope =
          (1.0 - nearness * (far_along + nearness)) / (far_along * far_along + far_across * far_across) +
          (1.0 - near * at.c) / (along * along + across * across);
      const double step = sine / (cosine * slope);
      const Turn moved = unit(at.c - at.s * step, at.s + at.c * step);
      if (std::abs(step) <= kSmallestTurn) return moved;
      if (low.sine_to(moved) > 0.0 && moved.sine_to(high) > 0.0) next = moved;
    }
    at = next;
  }
  return at;
}

}  // namespace

std::optional<RoundMirror> RoundMirror::of(const geometry::SurfaceSurvey::Round& round) {
  const Vec3 x = round.scene_from_unit.column_x(), y = round.scene_from_unit.column_y(),
             z = round.scene_from_unit.column_z();
  const double radius = length(x);
  const auto equal = [&](double value, double other) { return std::abs(value - other) <= kRound * radius; };
  const auto square = [&](Vec3 a, Vec3 b) { return std::abs(dot(a, b)) <= kRound * length(a) * length(b); };
  if (!(radius > 0.0) || !equal(length(y), radius) || !square(x, y) || !square(x, z) || !square(y, z))
    return {};
  RoundMirror mirror;
  mirror.cylinder_ =
      round.kind == geometry::UnitKind::open_cylinder || round.kind == geometry::UnitKind::cylinder;
  if (!mirror.cylinder_ && !equal(length(z), radius)) return {};
  mirror.half_ = round.kind == geometry::UnitKind::hemisphere;
  mirror.hollow_ = mirror.half_ || round.kind == geometry::UnitKind::open_cylinder;
  mirror.centre_m_ = round.scene_from_unit.origin_m();
  mirror.radius_m_ = radius;
  mirror.length_m_ = length(z);
  mirror.axis_ = z / mirror.length_m_;
  mirror.object_ = round.object;
  return mirror;
}

Vec3 RoundMirror::across_axis(Vec3 v) const { return cylinder_ ? v - dot(v, axis_) * axis_ : v; }

std::optional<RoundMirror::Image> RoundMirror::image(Point3 from, Vec3 towards_sun) const {
  // Of the cylinder all is seen along its axis first: there it is a circle, and angles are equal too.
  const Vec3 sunward = across_axis(towards_sun);
  const double sunlit = length(sunward);
  if (!(sunlit > 1e-9)) return {};
  const std::optional<Vec3> normal = reflecting_normal(from, sunward / sunlit, 0.0);
  if (!normal) return {};
  const Vec3 back = radius_m_ * *normal - across_axis(from - centre_m_);
  // What light climbs along the axis is in step with what it goes across.
  const double climbs = cylinder_ ? length(back) * dot(towards_sun, axis_) / sunlit : 0.0;
  return seen_at(from, from + back + climbs * axis_, *normal);
}

std::optional<RoundMirror::Image> RoundMirror::image_of(Point3 from, Point3 light) const {
  const Vec3 outward = across_axis(light - centre_m_);
  const double away = length(outward);
  if (!(away > radius_m_ * (1.0 + 1e-9))) return {};
  const std::optional<Vec3> normal = reflecting_normal(from, outward / away, radius_m_ / away);
  if (!normal) return {};
  const Vec3 back = radius_m_ * *normal - across_axis(from - centre_m_);
  double climbs = 0.0;
  if (cylinder_) {
    const double to = length(back), on = length(outward - radius_m_ * *normal);
    climbs = dot(light - from, axis_) * to / (to + on);
  }
  return seen_at(from, from + back + climbs * axis_, *normal);
}

std::optional<Vec3> RoundMirror::reflecting_normal(Point3 from, Vec3 towards, double nearness) const {
  const Vec3 out = across_axis(from - centre_m_);
  const double apart = length(out);
  if (!(apart > radius_m_ * (1.0 + 1e-9))) return {};
  const Vec3 e = out / apart;
  const double along = dot(e, towards);
  Vec3 side = towards - along * e;
  const double across = length(side);
  side = across > 0.0 ? side / across : Vec3{};
  const std::optional<Turn> turn = reflecting_turn(radius_m_ / apart, nearness, unit(along, across));
  if (!turn) return {};
  return normalized(turn->c * e + turn->s * side);
}

std::optional<RoundMirror::Image> RoundMirror::seen_at(Point3 from, Point3 at, Vec3 normal) const {
  const double height = dot(at - centre_m_, axis_);
  if (cylinder_ ? !(height >= 0.0 && height <= length_m_) : half_ && height < 0.0) return {};
  return reflected(from, at, normal);
}

std::optional<RoundMirror::Image> RoundMirror::met(Point3 from, Point3 at) const {
  const Vec3 out = across_axis(at - centre_m_);
  if (!(std::abs(length(out) - radius_m_) <= kOnSurface * radius_m_)) return {};
  return reflected(from, at, normalized(out));
}

std::optional<RoundMirror::Image> RoundMirror::reflected(Point3 from, Point3 at, Vec3 normal) const {
  Image image;
  image.at = at;
  image.distance_m = length(at - from);
  if (!(image.distance_m > 0.0)) return {};
  image.direction = (at - from) / image.distance_m;

  // How light turns and moves: dw at the point moves the place by dp, that tilts the normal by dn.
  const Vec3 w = image.direction;
  const double facing = dot(w, normal);
  if (!(facing < -1e-9)) return {};
  image.onward = w - 2.0 * facing * normal;
  const sampling::TangentFrame frame(w);
  Vec3 moved[2], turned[2];
  for (int k = 0; k < 2; ++k) {
    const Vec3 dw = k == 0 ? frame.first : frame.second;
    moved[k] = image.distance_m * (dw - w * (dot(normal, dw) / facing));
    const Vec3 dn = across_axis(moved[k]) / radius_m_;
    turned[k] = dw - 2.0 * (dot(dw, normal) + dot(w, dn)) * normal - 2.0 * facing * dn;
  }
  image.widens[0] = dot(image.onward, cross(moved[0], moved[1]));
  image.widens[1] = dot(image.onward, cross(moved[0], turned[1]) + cross(turned[0], moved[1]));
  image.widens[2] = dot(image.onward, cross(turned[0], turned[1]));
  return image;
}

double RoundMirror::share_of_view(Point3 from) const {
  const double reach = cylinder_ ? std::hypot(radius_m_, 0.5 * length_m_) : radius_m_;
  const double apart = length(middle_m() - from);
  return apart > reach ? reach * reach / (apart * apart) : 1.0;
}

}  // namespace ifov::transport
