#pragma once

#include "math/transform.h"
#include "math/vec3.h"

namespace ifov::geodesy {

// Frames: tags that say what coordinates mean, so that a point of one frame is no point of another.

/// Origin in the Earth's centre, axes fixed among the stars (GCRS).
struct Gcrs {};
/// Earth-centred, Earth-fixed (ITRS, which WGS 84 follows within centimetres): z to the north pole, x where the equator
/// meets the meridian of Greenwich.
struct Ecef {};
/// Local: x east, y north, z along the ellipsoid's outward normal. A scene is in such a frame about its origin.
struct Enu {};
/// Of an aircraft or satellite: x forward (the nose), y to the right (the right wing), z down (the belly).
struct Body {};

/// A displacement or direction in a frame; metres, unitless or what its name says.
template <class Frame>
struct VectorIn {
  math::Vec3 v;
  friend constexpr VectorIn operator+(VectorIn a, VectorIn b) { return {a.v + b.v}; }
  friend constexpr VectorIn operator-(VectorIn a, VectorIn b) { return {a.v - b.v}; }
  friend constexpr VectorIn operator-(VectorIn a) { return {-a.v}; }
  friend constexpr VectorIn operator*(double s, VectorIn a) { return {s * a.v}; }
  friend constexpr bool operator==(const VectorIn&, const VectorIn&) = default;
  friend constexpr double dot(VectorIn a, VectorIn b) { return math::dot(a.v, b.v); }
  friend constexpr VectorIn cross(VectorIn a, VectorIn b) { return {math::cross(a.v, b.v)}; }
  friend double length(VectorIn a) { return math::length(a.v); }
  friend VectorIn normalized(VectorIn a) { return {math::normalized(a.v)}; }
};

/// A position in a frame, metres.
template <class Frame>
struct PointIn {
  math::Point3 p;
  friend constexpr PointIn operator+(PointIn a, VectorIn<Frame> b) { return {a.p + b.v}; }
  friend constexpr VectorIn<Frame> operator-(PointIn a, PointIn b) { return {a.p - b.p}; }
  friend constexpr bool operator==(const PointIn&, const PointIn&) = default;
};

using GcrsVector = VectorIn<Gcrs>;
using EcefVector = VectorIn<Ecef>;
using EnuVector = VectorIn<Enu>;
using BodyVector = VectorIn<Body>;
using EcefPoint = PointIn<Ecef>;
using EnuPoint = PointIn<Enu>;
using BodyPoint = PointIn<Body>;

/// A rotation and a shift between two frames, named destination_from_source: `ecef_from_enu(point)`.
template <class To, class From>
class FrameTransform {
 public:
  /// The axes of `From`, orthonormal and right-handed, and its origin, all told in `To`.
  constexpr FrameTransform(VectorIn<To> x, VectorIn<To> y, VectorIn<To> z, PointIn<To> origin = {})
      : transform_(math::Transform::from_columns(x.v, y.v, z.v, origin.p)) {}

  constexpr PointIn<To> operator()(PointIn<From> point) const { return {transform_(point.p)}; }
  constexpr VectorIn<To> operator()(VectorIn<From> vector) const { return {transform_(vector.v)}; }

  constexpr FrameTransform<From, To> inverse() const {
    const math::Vec3 x = transform_.column_x(), y = transform_.column_y(), z = transform_.column_z();
    const math::Vec3 o = transform_.origin_m() - math::Point3{};
    return {{{x.x, y.x, z.x}},
            {{x.y, y.y, z.y}},
            {{x.z, y.z, z.z}},
            {{-math::dot(x, o), -math::dot(y, o), -math::dot(z, o)}}};
  }

  /// c_from_a = c_from_b * b_from_a.
  template <class Source>
  friend constexpr FrameTransform<To, Source> operator*(const FrameTransform& a,
                                                        const FrameTransform<From, Source>& b) {
    return {a(b.x()), a(b.y()), a(b.z()), a(b.origin())};
  }

  constexpr VectorIn<To> x() const { return {transform_.column_x()}; }
  constexpr VectorIn<To> y() const { return {transform_.column_y()}; }
  constexpr VectorIn<To> z() const { return {transform_.column_z()}; }
  constexpr PointIn<To> origin() const { return {transform_.origin_m()}; }

 private:
  math::Transform transform_;
};

}  // namespace ifov::geodesy
