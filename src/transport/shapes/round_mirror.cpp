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

/// The angle at a circle's centre between the direction of a point outside, `apart` radii away, and that of the
/// normal at which light from a direction `turn` away from the point's is reflected to it. On that arc the angle of
/// incidence falls and the angle of exitance grows, so that there is one.
double reflecting_angle(double apart, double turn) {
  double low = 0.0, high = turn, angle = turn * (apart - 1.0) / (2.0 * apart - 1.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    const double along = apart * cosine - 1.0, across = apart * sine;
    const double excess = turn - angle - std::atan2(across, along);
    (excess > 0.0 ? low : high) = angle;
    const double slope = -1.0 - (apart * apart - apart * cosine) / (along * along + across * across);
    double next = angle - excess / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - angle) <= 1e-15 * turn) return next;
    angle = next;
  }
  return angle;
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

std::optional<RoundMirror::Image> RoundMirror::image(Point3 from, Vec3 towards_sun) const {
  // Of the cylinder all is seen along its axis first: there it is a circle, and angles are equal too.
  const auto across_axis = [this](Vec3 v) { return cylinder_ ? v - dot(v, axis_) * axis_ : v; };
  const Vec3 out = across_axis(from - centre_m_), sunward = across_axis(towards_sun);
  const double apart = length(out), sunlit = length(sunward);
  if (!(apart > radius_m_ * (1.0 + 1e-9)) || !(sunlit > 1e-9)) return {};
  const Vec3 e = out / apart, s = sunward / sunlit;
  const double along = dot(e, s);
  Vec3 side = s - along * e;
  const double across = length(side), turn = std::atan2(across, along);
  side = across > 0.0 ? side / across : Vec3{};
  const double angle = reflecting_angle(apart / radius_m_, turn);
  if (turn - angle >= 0.5 * std::numbers::pi) return {};
  const Vec3 normal = normalized(std::cos(angle) * e + std::sin(angle) * side);
  Vec3 back = radius_m_ * normal - out;  // from the point
  if (cylinder_) {
    // What light climbs along the axis is in step with what it goes across.
    const double height = dot(from - centre_m_, axis_) + length(back) * dot(towards_sun, axis_) / sunlit;
    if (!(height >= 0.0 && height <= length_m_)) return {};
    back = back + (height - dot(from - centre_m_, axis_)) * axis_;
  } else if (half_ && dot(normal, axis_) < 0.0) {
    return {};
  }
  Image image;
  image.at = from + back;
  image.distance_m = length(back);
  if (!(image.distance_m > 0.0)) return {};
  image.direction = back / image.distance_m;

  // How directions turn: dw at the point moves the place by dp, that tilts the normal by dn.
  const Vec3 w = image.direction, mirrored = w - 2.0 * dot(w, normal) * normal;
  const double facing = dot(w, normal);
  if (!(facing < -1e-9)) return {};
  const sampling::TangentFrame frame(w);
  const auto turned = [&](Vec3 dw) {
    const Vec3 dp = image.distance_m * (dw - w * (dot(normal, dw) / facing));
    const Vec3 dn = across_axis(dp) / radius_m_;
    return dw - 2.0 * (dot(dw, normal) + dot(w, dn)) * normal - 2.0 * facing * dn;
  };
  image.spread = std::abs(dot(mirrored, cross(turned(frame.first), turned(frame.second))));
  return image;
}

double RoundMirror::share_of_view(Point3 from) const {
  const double reach = cylinder_ ? std::hypot(radius_m_, 0.5 * length_m_) : radius_m_;
  const Point3 middle = cylinder_ ? centre_m_ + axis_ * (0.5 * length_m_) : centre_m_;
  const double apart = length(middle - from);
  return apart > reach ? reach * reach / (apart * apart) : 1.0;
}

}  // namespace ifov::transport
