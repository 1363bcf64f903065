#include "studies/thermal_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/format.h"
#include "radiometry/planck.h"
#include "sampling/random.h"

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

std::string black(std::string_view name, std::string_view temperature) {
  return format("\"{}\": {{\"emissivity\": 1, \"temperature\": {}}}", name, temperature);
}

ThermalScene scene_of(std::string hot_object, double hot_fraction) {
  ThermalScene scene;
  scene.materials = format("{{{}, {}}}", black("ground", "\"20 degC\""), black("target", "\"40 degC\""));
  scene.objects = format("[{{\"plane\": {{}}, \"material\": \"ground\"}},\n      {}]", hot_object);
  scene.hot_fraction = hot_fraction;
  scene.truth = cold_radiance() + hot_fraction * (hot_radiance() - cold_radiance());
  return scene;
}

template <class Shape>
double centre_area(const Shape& shape) {
  return area_in_rectangle(shape, 1.0, 1.0, 2.0, 2.0);
}

}  // namespace

double error_c(double radiance_error) { return radiance_error / mix_slope(); }

std::string radiance_of_error(double error) { return format("{:.9g} W m-2 sr-1 um-1", error * mix_slope()); }

StudyDocument ThermalScene::document(std::string sampling, std::uint64_t seed) const {
  StudyDocument document;
  document.materials = materials;
  document.objects = objects;
  document.camera = nadir_camera(3, 3, west_m, north_m);
  document.channels =
      format("[{{\"name\": \"thermal\", \"monochromatic\": {{\"at\": \"{} um\"}}}}]", kThermalWavelength_um);
  document.sampling = std::move(sampling);
  document.seed = seed;
  return document;
}

ThermalScene dome_scene(const Disc& disc) {
  return scene_of(format("{{\"hemisphere\": {{\"center\": {}, \"radius\": {}}}, \"material\": \"target\"}}",
                         point_text(kWest_m + disc.x_px, kNorth_m - disc.y_px, 0.0), metres(disc.radius_px)),
                  centre_area(disc));
}

ThermalScene disk_scene(const Disc& disc) {
  return scene_of(
      format(
          "{{\"disk\": {{\"center\": {}, \"normal\": [0, 0, 1], \"radius\": {}}}, \"material\": \"target\"}}",
          point_text(kWest_m + disc.x_px, kNorth_m - disc.y_px, 0.01), metres(disc.radius_px)),
      centre_area(disc));
}

ThermalScene box_scene(double x, double y, double length, double width, double angle) {
  // The image's y axis points south, so that its angles turn the other way.
  return scene_of(
      format("{{\"box\": {{\"low\": {}, \"high\": {}}}, \"material\": \"target\",\n       \"transform\": "
             "{{\"rotate\": "
             "{{\"angle\": \"{} rad\"}}, \"translate\": {}}}}}",
             point_text(-0.5 * length, -0.5 * width, 0.0), point_text(0.5 * length, 0.5 * width, 0.005),
             -angle, point_text(kWest_m + x, kNorth_m - y, 0.0)),
      centre_area(oblong(x, y, length, width, angle)));
}

ThermalScene textured_dome_scene(const Disc& disc, const TextureMap& texture, double map_x_m,
                                 double map_y_m) {
  const auto mapped = [&](std::string_view file) {
    return format(
        "{{\"map\": {{\"file\": \"{}\", \"unit\": \"K\", \"low_left\": [\"0 m\", \"0 m\"], \"size\": [{}, "
        "{}]}}}}",
        file, metres(texture.side_m()), metres(texture.side_m()));
  };
  ThermalScene scene =
      scene_of(format("{{\"hemisphere\": {{\"center\": {}, \"radius\": {}}}, \"material\": \"target\"}}",
                      point_text(map_x_m + disc.x_px, map_y_m - disc.y_px, 0.0), metres(disc.radius_px)),
               centre_area(disc));
  scene.materials = format("{{{},\n      {}}}", black("ground", mapped("ground.img")),
                           black("target", mapped("target.img")));
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
