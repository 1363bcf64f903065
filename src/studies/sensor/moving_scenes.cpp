#include "studies/sensor/moving_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/document/document.h"
#include "io/document/samplers/error_size.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_rendering.h"

namespace ifov::studies {
namespace {

constexpr int kAcross = 24;
constexpr double kCarPixel_m = 0.3, kCarHeight_m = 300.0;
constexpr std::array<double, 2> kCar_m = {1.7, 2.3}, kCarAt_m = {0.13, -0.21};
constexpr double kRight = std::numbers::pi / 180.0;

io::CameraDocument exposed_frame(int pixels, double height_m, double gsd_m, double exposure_s,
                                 double row_period_s) {
  constexpr double kMovingFocal_m = 0.05;
  return frame_above(pixels, pixels, height_m, kMovingFocal_m, kMovingFocal_m * gsd_m / height_m, exposure_s,
                     row_period_s);
}

double overlap(double low, double high, double from, double to) {
  return std::max(0.0, std::min(high, to) - std::max(low, from)) / (to - from);
}

/// What the plate covers of each pixel, as a mean over instants.
std::vector<double> covered(const MovingCar& car) {
  constexpr int kInstants = 801;
  std::vector<double> parts(kAcross * kAcross, 0.0);
  const auto rim = [](int k) { return (k - 0.5 * kAcross) * kCarPixel_m; };
  for (int y = 0; y < kAcross; ++y)
    for (int k = 0; k < kInstants; ++k) {
      const double time_s =
          (y + 0.5 - 0.5 * kAcross) * car.row_period_s + ((k + 0.5) / kInstants - 0.5) * car.exposure_s;
      const double east = kCarAt_m[0] + car.east_m_s * time_s,
                   south = -(kCarAt_m[1] + car.north_m_s * time_s);
      const double down =
          overlap(south - 0.5 * kCar_m[1], south + 0.5 * kCar_m[1], rim(y), rim(y + 1)) / kInstants;
      for (int x = 0; x < kAcross; ++x)
        parts[static_cast<std::size_t>(y * kAcross + x)] +=
            down * overlap(east - 0.5 * kCar_m[0], east + 0.5 * kCar_m[0], rim(x), rim(x + 1));
    }
  return parts;
}

}  // namespace

double moving_car_off_px(const MovingCar& car, const StudyOptions& options, bool stands) {
  io::Document document = nadir_document(
      exposed_frame(kAcross, kCarHeight_m, kCarPixel_m, car.exposure_s, car.row_period_s), "thermal", 10.0,
      accuracy_sampling({0.005, io::ErrorSize::Unit::fraction}), options.seed);
  document.scene.materials = {black("road", {290.0, {}}), black("paint", {450.0, {}})};
  io::BoxPrimitive plate;
  plate.low_m = {-0.5 * kCar_m[0], -0.5 * kCar_m[1], 0.0};
  plate.high_m = {0.5 * kCar_m[0], 0.5 * kCar_m[1], 1e-4};
  io::ObjectDocument moving = object_of(plate, "paint");
  const double speed = stands ? 0.0 : 1.0;
  carry(moving, {kCarAt_m[0], kCarAt_m[1], 0.0}, {speed * car.east_m_s, speed * car.north_m_s, 0.0});
  document.scene.objects = {level_ground("road"), std::move(moving)};
  const SensorImage image = render_sensor(document, options);
  const auto [low, high] = std::minmax_element(image.radiance.begin(), image.radiance.end());
  const std::vector<double> expected = covered(car);
  std::vector<double> rows(kAcross, 0.0), columns(kAcross, 0.0);
  double most = 0.0;
  for (std::size_t p = 0; p < expected.size(); ++p) {
    const double off = (image.radiance[p] - *low) / (*high - *low) - expected[p];
    rows[p / kAcross] += off, columns[p % kAcross] += off;
    most = std::max(most, std::abs(off));
  }
  for (const std::vector<double>* sums : {&rows, &columns})
    for (const double sum : *sums) most = std::max(most, std::abs(sum));
  return most;
}

namespace {

constexpr double kYardExposure_s = 0.01, kYardHeight_m = 200.0, kYardPixel_m = 0.5;
constexpr int kYardAcross = 16;
constexpr math::Point3 kBoxAt_m{-0.6, -1.7, 0.9};
constexpr math::Vec3 kBoxVelocity_m_s{150.0, 20.0, 0.0};

io::SpectrumDocument even_light(double value) {
  io::SpectrumDocument spectrum;
  spectrum.source = io::ConstantSpectrum{value};
  spectrum.quantity = io::SpectrumOf::radiance;
  return spectrum;
}

/// `time_s`: the box stands where it is then; none: it moves.
io::Document yard_document(const MovingYard& yard, const double* time_s, io::SamplingDocument sampling,
                           std::uint64_t seed, double speed) {
  const double rows_s = yard.rolling ? 0.5e-3 : 0.0, exposure_s = yard.rolling ? 0.0 : kYardExposure_s;
  io::Document document =
      nadir_document(exposed_frame(kYardAcross, kYardHeight_m, kYardPixel_m,
                                   time_s != nullptr ? 0.0 : exposure_s, time_s != nullptr ? 0.0 : rows_s),
                     "red", 0.65, std::move(sampling), seed);
  io::MaterialDocument mirror = grey("mirror", 0.9);
  mirror.scattering.model = "mirror";
  document.scene.materials = {grey("lawn", 0.15), grey("wall", 0.5), grey("box", 0.7), std::move(mirror)};
  io::BoxPrimitive wall, box;
  // Off the pixels' rims, so that cells of grids do not err alike along it.
  wall.low_m = {-2.913, 0.537, 0.0}, wall.high_m = {3.171, 1.389, 2.0};
  box.low_m = {-0.5, -0.3, -0.4}, box.high_m = {0.5, 0.3, 0.4};
  io::ObjectDocument thing = object_of(box, "box");
  if (time_s == nullptr) {
    carry(thing, kBoxAt_m, speed * kBoxVelocity_m_s);
  } else {
    const math::Point3 at = kBoxAt_m + *time_s * kBoxVelocity_m_s;
    thing.transform.translate_m = {at.x, at.y, at.z};
  }
  document.scene.objects = {level_ground("lawn"), object_of(wall, "wall"), std::move(thing)};
  if (yard.mirror) {
    // In front of the wall, leaning back so that it shows the yard to the camera.
    io::PolygonPrimitive pane;
    pane.vertices_m = {{-2.5, -0.83, 0.05}, {2.8, -0.83, 0.05}, {2.8, 0.51, 1.7}, {-2.5, 0.51, 1.7}};
    document.scene.objects.push_back(object_of(pane, "mirror"));
  }
  document.light.sun.emplace().direction = io::CelestialDirection{40.0 * kRight, 150.0 * kRight};
  document.light.sky = io::SkyRadiance{even_light(60.0)};
  return document;
}

}  // namespace

MovingTruth moving_truth(const MovingYard& yard, const StudyOptions& options) {
  const auto still = [&](double time_s, int k) {
    return render_sensor(yard_document(yard, &time_s, grid_sampling((yard.rolling ? 61 : 23) + k % 7),
                                       700 + static_cast<unsigned>(k), 1.0),
                         options);
  };
  constexpr std::size_t kPixels = kYardAcross * kYardAcross;
  MovingTruth found{std::vector<double>(kPixels, 0.0), std::vector<double>(kPixels, 0.0)};
  const int instants = yard.rolling ? kYardAcross : yard.instants;
  for (int k = 0; k < instants; ++k) {
    // Each row of a rolling shutter is of its own instant, and of one image.
    const double time_s = yard.rolling ? (k + 0.5 - 0.5 * kYardAcross) * 0.5e-3
                                       : ((k + 0.5) / instants - 0.5) * kYardExposure_s;
    const SensorImage image = still(time_s, k);
    for (std::size_t p = 0; p < kPixels; ++p) {
      if (!yard.rolling) found.moving[p] += image.radiance[p] / instants;
      if (yard.rolling && static_cast<int>(p) / kYardAcross == k) found.moving[p] = image.radiance[p];
    }
  }
  constexpr int kMiddles = 5;
  for (int k = 0; k < kMiddles; ++k) {
    const SensorImage image = still(0.0, k);
    for (std::size_t p = 0; p < kPixels; ++p) found.at_rest[p] += image.radiance[p] / kMiddles;
  }
  return found;
}

MovingHeld moving_held(const MovingYard& yard, const MovingTruth& truth, const StudyOptions& options,
                       bool stands) {
  MovingHeld result;
  for (int seed = 1; seed <= yard.seeds; ++seed) {
    const SensorImage image =
        render_sensor(yard_document(yard, nullptr, accuracy_sampling({0.03, io::ErrorSize::Unit::fraction}),
                                    options.seed + static_cast<unsigned>(seed), stands ? 0.0 : 1.0),
                      options);
    for (std::size_t p = 0; p < truth.moving.size(); ++p) {
      const bool held = std::abs(image.radiance[p] - truth.moving[p]) <= image.half_width[p],
                 moving = std::abs(truth.moving[p] - truth.at_rest[p]) > 0.02 * truth.moving[p];
      result.held += held, ++result.pixels;
      result.held_moving += held && moving, result.moving += moving;
    }
  }
  return result;
}

}  // namespace ifov::studies
