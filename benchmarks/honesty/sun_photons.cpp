#include "honesty/sun_photons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "geometry/world.h"
#include "materials/bsdf/bsdf.h"
#include "sensor/orthographic_camera.h"

namespace ifov::benchmarks {

namespace {

constexpr int kCertainSurfaces = 6;

bool inside(const PlainHints::Ball& ball, math::Point3 point) {
  return math::length(point - ball.centre_m) <= ball.radius_m * (1.0 + 1e-9);
}

}  // namespace

SunPhotons::SunPhotons(const scene::Scene& scene, const PlainSpectra& spectra, const sensor::Camera& camera,
                       const PlainFootprint& footprint, PlainHints hints)
    : scene_(scene),
      spectra_(spectra),
      surfaces_(scene, spectra),
      camera_(camera),
      footprint_(footprint),
      hints_(std::move(hints)) {
  const auto* parallel = dynamic_cast<const sensor::OrthographicCamera*>(&camera);
  if (parallel == nullptr || !std::isfinite(footprint.reach_px()))
    throw std::runtime_error("photons need an orthographic camera and a bounded footprint");
  const sampling::FocalPoint middle{0.5 * camera.width_px(), 0.5 * camera.height_px()};
  math::Ray view;
  camera.rays({&middle, 1}, {&view, 1});
  towards_camera_ = -view.direction;
  pixel_area_m2_ = parallel->settings().gsd_m * parallel->settings().gsd_m * towards_camera_.z;
}

std::vector<double> SunPhotons::shown(const geometry::SurfacePoint& hit, math::Vec3 along,
                                      std::uint32_t material) const {
  const math::Vec3 side = side_of(hit);  // where the photon came from
  const bool back = math::dot(towards_camera_, side) > 0.0;
  if (surfaces_.is_plain(material))
    return back ? spectra_.reflectance(material) : spectra_.transmittance(material);
  if (!back && !surfaces_.bsdf(material).may_transmit()) return {};
  // Models are reciprocal.
  materials::BsdfEvent event = surfaces_.view(material, -along, side);
  event.incoming = towards_camera_;
  event.side = back ? materials::Side::reflected : materials::Side::transmitted;
  std::vector<double> bsdf = surfaces_.evaluate(material, event);
  for (double& value : bsdf) value *= std::numbers::pi;
  return bsdf;
}

void SunPhotons::show(const geometry::SurfacePoint& hit, math::Vec3 along, std::uint32_t material,
                      const std::vector<double>& throughput, std::vector<double>& columns) const {
  sampling::FocalPoint place;
  if (!camera_.project(hit.position_m, place)) return;
  const double reach = footprint_.reach_px();
  const int x0 = std::max(0, static_cast<int>(std::ceil(place.x_px - 0.5 - reach)));
  const int x1 = std::min(camera_.width_px() - 1, static_cast<int>(std::floor(place.x_px - 0.5 + reach)));
  const int y0 = std::max(0, static_cast<int>(std::ceil(place.y_px - 0.5 - reach)));
  const int y1 = std::min(camera_.height_px() - 1, static_cast<int>(std::floor(place.y_px - 0.5 + reach)));
  if (x0 > x1 || y0 > y1) return;
  const math::Vec3 side = side_of(hit);
  const double seen = math::dot(towards_camera_, side);
  std::vector<double> share;
  if (!surfaces_.comes_through(
          {hit.position_m + (seen > 0.0 ? hit.offset_m : -hit.offset_m) * side, towards_camera_}, share))
    return;
  const std::vector<double> factor = shown(hit, along, material);
  if (factor.empty()) return;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double weight = footprint_.density(place.x_px - x - 0.5, place.y_px - y - 0.5) * std::abs(seen) /
                            (std::numbers::pi * pixel_area_m2_);
      if (weight <= 0.0) continue;
      double* sum = &columns[(static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width_px()) +
                              static_cast<std::size_t>(x)) *
                             spectra_.columns()];
      for (std::size_t c = 0; c < spectra_.columns(); ++c)
        sum[c] += weight * throughput[c] * factor[c] * share[c];
    }
}

void SunPhotons::follow(math::Ray ray, std::size_t ball, double power, RandomStream& random,
                        std::vector<double>& columns) const {
  std::vector<double> throughput = spectra_.sun();
  for (double& value : throughput) value *= power;
  const std::vector<double>* medium = nullptr;
  bool turned = false, scattered = false;
  for (int surfaces = 0;; ++surfaces) {
    const geometry::SurfacePoint hit = nearest(scene_, ray);
    if (!hit.hit()) return;
    const std::uint32_t material = pick_constituent(scene_.resolve(hit), random).material;
    const bool delta = surfaces_.is_delta(material), plain = surfaces_.is_plain(material);
    if (surfaces == 0) {
      // Each mirror belongs to the first ball that holds it.
      const auto first = std::find_if(hints_.around_mirrors.begin(), hints_.around_mirrors.end(),
                                      [&](const PlainHints::Ball& b) { return inside(b, hit.position_m); });
      if (!delta || first - hints_.around_mirrors.begin() != static_cast<std::ptrdiff_t>(ball)) return;
    }
    if (medium != nullptr)
      for (std::size_t c = 0; c < throughput.size(); ++c)
        throughput[c] *= std::exp(-(*medium)[c] * hit.distance_m);
    const std::vector<double>&reflectance = spectra_.reflectance(material),
          &transmittance = spectra_.transmittance(material);
    const double most_reflected = *std::max_element(reflectance.begin(), reflectance.end());
    const double most_let_through = *std::max_element(transmittance.begin(), transmittance.end());
    if (most_reflected + most_let_through <= 0.0) return;
    const math::Vec3 side = side_of(hit);
    if (!delta) {
      if (!turned && !scattered) return;  // came straight
      scattered = true;
      show(hit, ray.direction, material, throughput, columns);
    }
    if (plain && delta) {
      for (std::size_t c = 0; c < throughput.size(); ++c) throughput[c] *= reflectance[c];
      ray = {hit.position_m + hit.offset_m * side, mirror_image(ray.direction, side)};
      turned = true;
    } else if (plain) {
      const double reflected_probability = most_reflected / (most_reflected + most_let_through);
      const bool back = random.uniform() < reflected_probability;
      const math::Vec3 axis = back ? side : -side;
      for (std::size_t c = 0; c < throughput.size(); ++c)
        throughput[c] *=
            back ? reflectance[c] / reflected_probability : transmittance[c] / (1.0 - reflected_probability);
      ray = {hit.position_m + hit.offset_m * axis, cosine_direction(axis, random)};
    } else {
      const materials::Passage passage = surfaces_.bsdf(material).passage();
      const bool bends = passage == materials::Passage::into || passage == materials::Passage::out_of;
      if (bends && !delta) throw std::logic_error("photons do not go through rough boundaries");
      PlainSurfaces::Step step;
      if (!surfaces_.step(material, surfaces_.view(material, -ray.direction, side), random, step)) return;
      for (std::size_t c = 0; c < throughput.size(); ++c) throughput[c] *= step.factors[c];
      const bool through = step.event.side == materials::Side::transmitted;
      medium = surfaces_.medium_after(material, step.event.side, medium);
      turned = turned || !through || bends;
      ray = {hit.position_m + (through ? -hit.offset_m : hit.offset_m) * side, step.event.incoming};
    }
    if (surfaces < kCertainSurfaces) continue;
    const double survival = std::min(0.95, most_reflected + most_let_through);
    if (random.uniform() >= survival) return;
    for (double& factor : throughput) factor /= survival;
  }
}

SunPhotons::Image SunPhotons::image(int side, std::uint64_t key) const {
  const std::size_t pixels =
      static_cast<std::size_t>(camera_.width_px()) * static_cast<std::size_t>(camera_.height_px());
  const std::size_t channels = spectra_.channels();
  Image image{std::vector<double>(pixels * channels), std::vector<double>(pixels * channels)};
  if (!scene_.sun) return image;
  const scene::Sun& sun = *scene_.sun;
  const math::Vec3 other =
      std::abs(sun.direction.x) < 0.6 ? math::Vec3{1.0, 0.0, 0.0} : math::Vec3{0.0, 1.0, 0.0};
  const math::Vec3 right = math::normalized(math::cross(sun.direction, other)),
                   up = math::cross(right, sun.direction);
  const geometry::World::Bounds bounds = scene_.world->bounds();
  const double away_m = 2.0 * math::length(bounds.high_m - bounds.low_m) + 1.0;
  for (int replicate = 0; replicate < kReplicates; ++replicate) {
    RandomStream random(key, static_cast<std::uint64_t>(replicate));
    std::vector<double> columns(pixels * spectra_.columns());
    for (std::size_t b = 0; b < hints_.around_mirrors.size(); ++b) {
      const PlainHints::Ball& ball = hints_.around_mirrors[b];
      const double power = 4.0 * ball.radius_m * ball.radius_m / (static_cast<double>(side) * side);
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const double u = 2.0 * (i + random.uniform()) / side - 1.0,
                       v = 2.0 * (j + random.uniform()) / side - 1.0;
          const math::Point3 aim = ball.centre_m + (u * ball.radius_m) * right + (v * ball.radius_m) * up;
          const math::Vec3 from = sun.half_angle_rad > 0.0
                                      ? cone_direction(sun.direction, sun.half_angle_rad, random)
                                      : sun.direction;
          follow({aim + away_m * from, -from}, b, power, random, columns);
          ++image.photons;
        }
    }
    for (std::size_t p = 0; p < pixels; ++p) {
      const std::vector<double> value =
          spectra_.at_sensor({&columns[p * spectra_.columns()], spectra_.columns()}, false);
      for (std::size_t c = 0; c < channels; ++c) {
        image.mean[p * channels + c] += value[c] / kReplicates;
        image.error[p * channels + c] += value[c] * value[c] / kReplicates;
      }
    }
  }
  for (std::size_t k = 0; k < image.mean.size(); ++k)
    image.error[k] =
        std::sqrt(std::max(0.0, image.error[k] - image.mean[k] * image.mean[k]) / (kReplicates - 1));
  return image;
}

}  // namespace ifov::benchmarks
