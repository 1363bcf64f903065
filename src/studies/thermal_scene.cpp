#include "studies/thermal_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/round_primitives.h"
#include "radiometry/planck.h"
#include "sampling/random.h"
#include "studies/common/study_document.h"

namespace ifov::studies {

using radiometry::planck_w_m2_sr_um;

double hot_radiance() { return planck_w_m2_sr_um(kThermalWavelength_um, kHot_k); }
double cold_radiance() { return planck_w_m2_sr_um(kThermalWavelength_um, kCold_k); }

namespace {

double mix_slope() {
  const double mix = 0.5 * (hot_radiance() + cold_radiance());
  return radiometry::planck_slope_w_m2_sr_um_k(
      kThermalWavelength_um, radiometry::brightness_temperature_k(kThermalWavelength_um, mix));
}

constexpr double kWest_m = -1.5, kNorth_m = 1.5;

ThermalScene scene_of(io::ObjectDocument hot_object, double hot_fraction) {
  ThermalScene scene;
  scene.scene.materials = {black("ground", {kCold_k, {}}), black("target", {kHot_k, {}})};
  scene.scene.objects = {object_of(io::PlanePrimitive(), "ground"), std::move(hot_object)};
  scene.hot_fraction = hot_fraction;
  scene.truth = cold_radiance() + hot_fraction * (hot_radiance() - cold_radiance());
  return scene;
}

io::ObjectDocument hemisphere(math::Point3 centre_m, double radius_m) {
  io::HemispherePrimitive dome;
  dome.centre_m = centre_m;
  dome.radius_m = radius_m;
  return object_of(dome, "target");
}

template <class Shape>
double centre_area(const Shape& shape) {
  return area_in_rectangle(shape, 1.0, 1.0, 2.0, 2.0);
}

}  // namespace

double error_c(double radiance_error) { return radiance_error / mix_slope(); }

io::ErrorSize radiance_of_error(double error) {
  return {std::stod(format("{:.9g}", error * mix_slope())), io::ErrorSize::Unit::radiance};
}

io::Document ThermalScene::document(io::SamplingDocument sampling, std::uint64_t seed) const {
  io::Document document = nadir_document(nadir_camera(3, 3, west_m, north_m), "thermal",
                                         kThermalWavelength_um, std::move(sampling), seed);
  document.scene = scene;
  return document;
}

ThermalScene dome_scene(const Disc& disc) {
  return scene_of(hemisphere({kWest_m + disc.x_px, kNorth_m - disc.y_px, 0.0}, disc.radius_px),
                  centre_area(disc));
}

ThermalScene disk_scene(const Disc& disc) {
  io::DiskPrimitive disk;
  disk.centre_m = {kWest_m + disc.x_px, kNorth_m - disc.y_px, 0.01};
  disk.normal = {0.0, 0.0, 1.0};
  disk.radius_m = disc.radius_px;
  return scene_of(object_of(disk, "target"), centre_area(disc));
}

ThermalScene box_scene(double x, double y, double length, double width, double angle) {
  io::BoxPrimitive box;
  box.low_m = {-0.5 * length, -0.5 * width, 0.0};
  box.high_m = {0.5 * length, 0.5 * width, 0.005};
  io::ObjectDocument object = object_of(box, "target");
  // The image's y axis points south, so that its angles turn the other way.
  object.transform.rotation_rad = -angle;
  object.transform.translate_m = {kWest_m + x, kNorth_m - y, 0.0};
  return scene_of(std::move(object), centre_area(oblong(x, y, length, width, angle)));
}

ThermalScene textured_dome_scene(const Disc& disc, const TextureMap& texture, double map_x_m,
                                 double map_y_m) {
  const auto mapped = [&](const char* file) {
    io::TemperatureMap map;
    map.raster.file.path = file;
    map.raster.placement = io::RasterDocument::Placement{0.0, 0.0, texture.side_m(), texture.side_m()};
    return io::TemperatureDocument{std::move(map), {}};
  };
  ThermalScene scene = scene_of(hemisphere({map_x_m + disc.x_px, map_y_m - disc.y_px, 0.0}, disc.radius_px),
                                centre_area(disc));
  scene.scene.materials = {black("ground", mapped("ground.img")), black("target", mapped("target.img"))};
  scene.west_m = map_x_m;
  scene.north_m = map_y_m;

  // Midpoint rule on rows, each split where it enters and leaves the dome.
  constexpr int kRows = 500, kSteps = 500;
  double sum = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double y = 1.0 + (row + 0.5) / kRows;
    const double half =
        std::sqrt(std::max(0.0, disc.radius_px * disc.radius_px - (y - disc.y_px) * (y - disc.y_px)));
    const double enter = std::clamp(disc.x_px - half, 1.0, 2.0),
                 leave = std::clamp(disc.x_px + half, 1.0, 2.0);
    const auto add = [&](double from, double to, double mean_k) {
      const int steps = static_cast<int>(std::ceil((to - from) * kSteps));
      for (int k = 0; k < steps; ++k) {
        const double x = from + (k + 0.5) * (to - from) / steps;
        sum += planck_w_m2_sr_um(kThermalWavelength_um, mean_k + texture.at(map_x_m + x, map_y_m - y)) *
               (to - from) / steps / kRows;
      }
    };
    add(1.0, enter, kCold_k);
    add(enter, leave, kHot_k);
    add(leave, 2.0, kCold_k);
  }
  scene.truth = sum;
  return scene;
}

Disc paper_dome() { return {1.5, 1.5, std::sqrt(0.5 / std::numbers::pi)}; }

ThermalScene random_scene(Family family, std::uint64_t seed, int trial, const TextureMap& texture) {
  const auto random = [&](int what) {
    return sampling::unit_double(sampling::hash(seed, family, trial, what));
  };
  const auto within_pixel = [&](double radius) {
    return Disc{1.0 + radius + random(0) * (1.0 - 2.0 * radius),
                1.0 + radius + random(1) * (1.0 - 2.0 * radius), radius};
  };
  const auto disc_of = [](double fraction) { return std::sqrt(fraction / std::numbers::pi); };
  constexpr double kPi = std::numbers::pi;
  switch (family) {
    case Family::dome: return dome_scene(within_pixel(disc_of(0.5)));
    case Family::square:
      return box_scene(1.5 + (random(0) - 0.5) * 0.3, 1.5 + (random(1) - 0.5) * 0.3, std::sqrt(0.5),
                       std::sqrt(0.5), kPi * random(2));
    case Family::rod:
      return box_scene(1.0 + random(0), 1.0 + random(1), 1.0 + random(2), 0.02 + 0.03 * random(3),
                       kPi * random(4));
    case Family::small_target: return disk_scene(within_pixel(disc_of(0.005)));
    case Family::large_target: return disk_scene({1.0 + random(0), 1.0 + random(1), disc_of(0.05)});
    case Family::textured_dome: break;
  }
  const double room = texture.side_m() - 4.0;
  return textured_dome_scene(within_pixel(disc_of(0.5)), texture, 0.5 + room * random(2),
                             3.5 + room * random(3));
}

}  // namespace ifov::studies
