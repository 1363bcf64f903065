#include "render/field/thin_shadow_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/surface_point.h"
#include "sensor/camera.h"

namespace ifov::render {

namespace {

/// Places of one part: as many as the shadow is wide in these, parts being no farther apart.
constexpr double kApart_px = 0.35, kMostPlaces = 24.0;
/// What is hidden less of the Sun than this matters to no accuracy.
constexpr double kLeastShare = 1e-4;
/// Of the Sun's radius: where the fixed points lie (transport::fixed_disc_points).
constexpr double kRim = 0.97;

}  // namespace

/// Rays from one place of what throws the shadow arrive, by the point of the Sun's disc that they come from, on an ellipse: that of the
/// rim's three is known, and places are spread over it by the golden angle.
void visit_thin_shadow(std::span<const math::Ray, kRimPoints> away,
                       std::span<const geometry::SurfacePoint, kRimPoints> arrived, double width_m,
                       std::size_t number, const sensor::Camera& camera,
                       const std::function<void(sampling::FocalPoint, float share)>& visit) {
  const math::Point3 first = arrived[0].position_m;
  math::Vec3 middle, direction;
  double far_m = 0.0;
  for (std::size_t k = 0; k < kRimPoints; ++k) {
    if (!arrived[k].hit()) return;
    middle = middle + (arrived[k].position_m - first) / double{kRimPoints};
    direction = direction + away[k].direction / double{kRimPoints};
    far_m += arrived[k].distance_m / double{kRimPoints};
  }
  const double radius = math::length(away[0].direction - direction) / kRim;
  const double share = 2.0 / std::numbers::pi * width_m / (radius * far_m);
  if (!(share > kLeastShare && share < kThinShare)) return;
  const math::Vec3 a = (arrived[0].position_m - first - middle) / kRim,
                   b = (arrived[1].position_m - arrived[2].position_m) / (std::numbers::sqrt3 * kRim);
  sampling::FocalPoint centre, end;
  if (!camera.project(first + middle, centre)) return;
  double radius_px = 0.0;
  for (const geometry::SurfacePoint& point : arrived)
    if (camera.project(point.position_m, end))
      radius_px = std::max(radius_px, std::hypot(end.x_px - centre.x_px, end.y_px - centre.y_px));
  const int places = static_cast<int>(std::clamp(std::ceil(2.0 * radius_px / kApart_px), 1.0, kMostPlaces));
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int k = 0; k < places; ++k) {
    const double out = std::sqrt((k + 0.5) / places), turn = golden * (k + 1.7 * static_cast<double>(number));
    if (camera.project(first + middle + out * std::cos(turn) * a + out * std::sin(turn) * b, end))
      visit(end, static_cast<float>(share));
  }
}

}  // namespace ifov::render
