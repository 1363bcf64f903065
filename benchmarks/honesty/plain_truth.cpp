#include "honesty/plain_truth.h"

#include <algorithm>
#include <cmath>

#include "geometry/world.h"
#include "io/document/document.h"
#include "sensor/camera.h"

namespace ifov::benchmarks {

namespace {

constexpr int kFirstSide = 16, kSpreadSide = 2, kFirstPhotonSide = 128;

/// The larger part of the variance that is wanted may be the photons'.
constexpr double kPhotonShare = 0.8;

bool reached(std::span<const double> error, std::span<const double> wanted, double share) {
  for (std::size_t c = 0; c < error.size(); ++c)
    if (!(error[c] <= share * wanted[c])) return false;
  return true;
}

}  // namespace

PlainTruth::PlainTruth(const session::Session& session, PlainHints hints)
    : parts_(session.parts()),
      hints_(std::move(hints)),
      spectra_(parts_.scene, parts_.channels),
      footprint_(parts_.document.sensor),
      tracer_(parts_.scene, spectra_, *parts_.camera, footprint_, hints_) {
  if (parts_.scene.sun && !hints_.around_mirrors.empty())
    photons_ = std::make_unique<SunPhotons>(parts_.scene, spectra_, *parts_.camera, footprint_, hints_);
}

std::vector<double> PlainTruth::spread(std::uint64_t key) const {
  std::vector<double> spread;
  for (int y = 0; y < parts_.camera->height_px(); ++y)
    for (int x = 0; x < parts_.camera->width_px(); ++x) {
      const PlainMean mean = tracer_.pixel(x, y, kSpreadSide, key + spread.size());
      double most = 0.0;
      for (std::size_t c = 0; c < mean.mean.size(); ++c)
        most = std::max(most, mean.mean[c] > 0.0 ? mean.error[c] / mean.mean[c] : 0.0);
      spread.push_back(most);
    }
  return spread;
}

std::vector<PlainTruthPixel> PlainTruth::pixels(std::span<const PixelIndex> pixels, const Wanted& wanted,
                                                double most_paths, double most_photons,
                                                std::uint64_t key) const {
  std::vector<PlainTruthPixel> truth;
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    PlainMean mean;
    double paths = 0.0;
    for (int side = kFirstSide;; side *= 2) {
      mean = tracer_.pixel(pixels[p].x, pixels[p].y, side,
                           key * 1000003u + p * 64u + static_cast<std::uint64_t>(side));
      paths += mean.paths;
      if (paths + 4.0 * mean.paths > most_paths ||
          reached(mean.error, wanted(p, mean.mean),
                  photons_ ? std::sqrt(1.0 - kPhotonShare * kPhotonShare) : 1.0))
        break;
    }
    truth.push_back({std::move(mean.mean), std::move(mean.error), std::move(mean.above)});
  }
  if (photons_) add_photons(pixels, wanted, most_photons, key, truth);
  add_point_glints(pixels, truth);
  return truth;
}

void PlainTruth::add_photons(std::span<const PixelIndex> pixels, const Wanted& wanted, double most_photons,
                             std::uint64_t key, std::vector<PlainTruthPixel>& truth) const {
  const std::size_t channels = spectra_.channels();
  const auto place = [&](std::size_t p) {
    return (static_cast<std::size_t>(pixels[p].y) * static_cast<std::size_t>(parts_.camera->width_px()) +
            static_cast<std::size_t>(pixels[p].x)) *
           channels;
  };
  SunPhotons::Image image;
  double photons = 0.0;
  for (int side = kFirstPhotonSide;; side *= 2) {
    image = photons_->image(side, key ^ static_cast<std::uint64_t>(side));
    photons += image.photons;
    bool enough = photons + 4.0 * image.photons > most_photons;
    if (!enough) {
      enough = true;
      for (std::size_t p = 0; p < pixels.size() && enough; ++p) {
        std::vector<double> sum = truth[p].mean;
        for (std::size_t c = 0; c < channels; ++c) sum[c] += image.mean[place(p) + c];
        enough = reached({&image.error[place(p)], channels}, wanted(p, sum), kPhotonShare);
      }
    }
    if (enough) break;
  }
  for (std::size_t p = 0; p < pixels.size(); ++p)
    for (std::size_t c = 0; c < channels; ++c) {
      truth[p].mean[c] += image.mean[place(p) + c];
      truth[p].error[c] = std::hypot(truth[p].error[c], image.error[place(p) + c]);
    }
}

/// A mirror sphere of radius R sends rho E R^2 / 4 per steradian to every side that it is seen from; under a point
/// Sun all of it comes from one point.
void PlainTruth::add_point_glints(std::span<const PixelIndex> pixels,
                                  std::vector<PlainTruthPixel>& truth) const {
  if (!parts_.scene.sun || parts_.scene.sun->half_angle_rad > 0.0) return;
  for (const PlainHints::Ball& ball : hints_.mirrors) {
    const sampling::FocalPoint middle{0.5 * parts_.camera->width_px(), 0.5 * parts_.camera->height_px()};
    math::Ray view;
    parts_.camera->rays({&middle, 1}, {&view, 1});
    const math::Vec3 towards_sun = parts_.scene.sun->direction;
    const math::Point3 glint = ball.centre_m + ball.radius_m * math::normalized(towards_sun - view.direction);
    const math::Vec3 away = math::normalized(glint - ball.centre_m);
    const math::Ray legs[2] = {{glint + 1e-6 * ball.radius_m * away, towards_sun},
                               {glint + 1e-6 * ball.radius_m * away, -view.direction}};
    std::uint8_t blocked[2] = {0, 0};
    parts_.scene.world->occluded(legs, blocked);
    sampling::FocalPoint place;
    if (blocked[0] != 0 || blocked[1] != 0 || !parts_.camera->project(glint, place)) continue;
    const geometry::SurfacePoint hit =
        nearest(parts_.scene, {glint - 0.01 * ball.radius_m * view.direction, view.direction});
    if (!hit.hit()) continue;
    const std::uint32_t material = parts_.scene.resolve(hit).constituents[0].material;
    const double gsd_m = parts_.camera->gsd_m(glint);
    const double pixel_area_m2 = gsd_m * gsd_m * -view.direction.z;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const double share = footprint_.density(place.x_px - pixels[p].x - 0.5, place.y_px - pixels[p].y - 0.5);
      std::vector<double> columns(spectra_.columns());
      for (std::size_t c = 0; c < columns.size(); ++c)
        columns[c] = 0.25 * ball.radius_m * ball.radius_m / pixel_area_m2 * share * spectra_.sun()[c] *
                     spectra_.reflectance(material)[c];
      const std::vector<double> value = spectra_.at_sensor(columns, false);
      for (std::size_t c = 0; c < value.size(); ++c) truth[p].mean[c] += value[c];
    }
  }
}

}  // namespace ifov::benchmarks
