#pragma once

#include <cstdint>
#include <vector>

#include "honesty/plain_tracer.h"

namespace ifov::benchmarks {

/// Sunlight that mirrors, panes and smooth boundaries send to surfaces that scatter, traced from the Sun: photons start on a square
/// across the sunbeam about each ball that holds such things, count where they meet one of it first and are turned before they meet a
/// surface that scatters (what comes straight through panes PlainTracer finds), are scattered by chance, and each scattering that the camera sees is added to the pixels whose
/// footprint holds it. With what PlainTracer finds this is all the light, but for what is seen in a mirror. Only for
/// orthographic cameras and footprints of bounded reach.
class SunPhotons {
 public:
  /// Keeps references to all but the hints. Throws std::runtime_error for another camera.
  SunPhotons(const scene::Scene& scene, const PlainSpectra& spectra, const sensor::Camera& camera,
             const PlainFootprint& footprint, PlainHints hints);

  static constexpr int kReplicates = 16;
  /// Means of all pixels, [pixel * channels + channel], from 16 replicates of side x side photons for each ball;
  /// without the radiance of the view path.
  struct Image {
    std::vector<double> mean, error;
    double photons = 0.0;
  };
  Image image(int side, std::uint64_t key) const;

 private:
  void follow(math::Ray ray, std::size_t ball, double power, RandomStream& random,
              std::vector<double>& columns) const;
  void show(const geometry::SurfacePoint& hit, math::Vec3 along, std::uint32_t material,
            const std::vector<double>& throughput, std::vector<double>& columns) const;
  /// The share of what arrives along `along` that leaves towards the camera, by column, over pi.
  std::vector<double> shown(const geometry::SurfacePoint& hit, math::Vec3 along,
                            std::uint32_t material) const;

  const scene::Scene& scene_;
  const PlainSpectra& spectra_;
  PlainSurfaces surfaces_;
  const sensor::Camera& camera_;
  const PlainFootprint& footprint_;
  PlainHints hints_;
  math::Vec3 towards_camera_;
  double pixel_area_m2_ = 1.0;  ///< across the line of sight
};

}  // namespace ifov::benchmarks
