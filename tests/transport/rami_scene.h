#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "geometry/periodic_world.h"
#include "geometry/world/world_builder.h"
#include "math/frame.h"
#include "radiometry/spectral_nodes.h"
#include "sampling/sequence.h"
#include "scene/scene.h"
#include "transport/path_light.h"
#include "transport/path_tracer.h"

namespace ifov::test {

/// HET01 of the radiation transfer model intercomparison (RAMI; Pinty et al. 2001, 2004): 15 balls of 49,999 leaf
/// discs on 100 m x 100 m of Lambertian ground, endlessly repeated, under a point Sun 20 degrees off the zenith.
class RamiScene {
 public:
  enum class Fault { none, one_sided, not_periodic, swapped };

  static constexpr double kSide_m = 100.0, kTop_m = 30.0;
  static constexpr double kGround = 0.159, kLeafReflectance = 0.4957, kLeafTransmittance = 0.4409;
  static constexpr double kSunZenith_rad = 20.0 / 180.0 * std::numbers::pi;

  RamiScene(const std::filesystem::path& folder, Fault fault) {
    geometry::WorldBuilder builder;
    const geometry::ShapeId disk = builder.add_shape(geometry::Disk{});
    std::vector<geometry::Part> leaves;
    for (const std::vector<double>& v : numbers(folder / "het01_UNI_sphere.def", 7)) {
      const math::Frame frame =
          math::frame_from_normal(math::as_normal(math::normalized({v[4], v[5], v[6]})));
      const math::Vec3 x = frame.outer_from_local({1.0, 0.0, 0.0}),
                       y = frame.outer_from_local({0.0, 1.0, 0.0}),
                       z = frame.outer_from_local({0.0, 0.0, 1.0});
      leaves.push_back(
          {disk, math::Transform::from_columns(x * v[0], y * v[0], z * v[0], {v[1], v[2], v[3]}), {}});
    }
    const geometry::ShapeId ball = builder.add_prototype(leaves);
    const std::vector<std::uint32_t> leaf{0}, ground{1};
    for (const std::vector<double>& v : numbers(folder / "het01_UNI_instances.def", 3))
      builder.place(ball, math::Transform::translation({v[0], v[1], v[2]}), leaf);
    builder.place(builder.add_shape(geometry::Plane{}), {}, ground);
    std::unique_ptr<geometry::World> world = builder.build(0);
    if (fault != Fault::not_periodic)
      world = std::make_unique<geometry::PeriodicWorld>(
          std::move(world), geometry::PeriodicWorld::Cell{-0.5 * kSide_m, -0.5 * kSide_m, kSide_m, kSide_m});
    scene_.world = std::move(world);

    const bool swapped = fault == Fault::swapped;
    add_material("leaf", swapped ? kLeafTransmittance : kLeafReflectance,
                 swapped ? kLeafReflectance : kLeafTransmittance);
    add_material("ground", kGround, 0.0);
    add_material("surroundings", 0.0, 0.0);
    scene_.surroundings = scene_.states.back();
    if (fault == Fault::one_sided) scene_.assignments[0].patterns.push_back(std::make_shared<BlackBehind>());
    scene::Sun sun;
    sun.direction = {std::sin(kSunZenith_rad), 0.0, std::cos(kSunZenith_rad)};
    sun.irradiance = radiometry::Spectrum::constant(1.0);
    scene_.sun = sun;
    std::vector<radiometry::Spectrum> surfaces;
    for (const auto& m : scene_.materials) surfaces.push_back(m.reflectance);
    const std::vector<radiometry::Channel> channels = {radiometry::Channel::monochromatic("nir", 0.8)};
    nodes_ = std::make_unique<radiometry::SpectralNodes>(
        radiometry::SpectralNodes::build(channels, scene_.sun->irradiance, surfaces));
    spectral_ = std::make_unique<transport::SpectralScene>(scene_, *nodes_);
  }

  struct Estimate {
    double brf = 0.0, standard_error = 0.0;
  };

  static constexpr int kReplicates = 16;

  /// Bidirectional reflectance factor of the whole cell seen at a zenith angle in the principal plane, negative on
  /// the Sun's side, from 16 independently scrambled nets of `paths` (a power of 2) each.
  Estimate brf(double view_zenith_deg, std::uint32_t paths) const {
    const double zenith = view_zenith_deg / 180.0 * std::numbers::pi;
    const math::Vec3 towards_viewer{-std::sin(zenith), 0.0, std::cos(zenith)};
    std::array<double, kReplicates> mean{};
    parallel_for(kReplicates, 0, [&](std::int64_t r) {
      transport::PathTracer tracer(*spectral_, {});
      const std::uint64_t key = sampling::hash(0x72616d69, static_cast<int>(std::lround(view_zenith_deg)), r);
      constexpr std::uint32_t kBatch = 4096;
      std::vector<math::Ray> rays(kBatch);
      std::vector<transport::PathKey> keys(kBatch);
      std::vector<geometry::SurfacePoint> hits(kBatch);
      transport::PathLight light(*spectral_);
      sampling::RayCounts counts;
      double sum = 0.0;
      for (std::uint32_t first = 0; first < paths; first += kBatch) {
        const std::uint32_t count = std::min(kBatch, paths - first);
        for (std::uint32_t k = 0; k < count; ++k) {
          const sampling::Point2 u = sampling::sequence_point(key, first + k, 0);
          const math::Point3 ground{(u.x - 0.5) * kSide_m, (u.y - 0.5) * kSide_m, 0.0};
          rays[k] = {ground + (kTop_m / towards_viewer.z) * towards_viewer, -towards_viewer};
          keys[k] = {key, first + k};
        }
        const transport::PathRecord& record = tracer.trace(
            std::span(rays).first(count), std::span(keys).first(count), std::span(hits).first(count), counts);
        for (std::uint32_t k = 0; k < count; ++k) sum += static_cast<double>(light.radiance(record, k)[0]);
      }
      mean[static_cast<std::size_t>(r)] = sum / paths * std::numbers::pi / std::cos(kSunZenith_rad);
    });
    Estimate e;
    for (const double m : mean) e.brf += m / kReplicates;
    for (const double m : mean) e.standard_error += (m - e.brf) * (m - e.brf);
    e.standard_error = std::sqrt(e.standard_error / (kReplicates * (kReplicates - 1.0)));
    return e;
  }

  /// Rows of `columns` numbers of a text file.
  static std::vector<std::vector<double>> numbers(const std::filesystem::path& file, std::size_t columns) {
    std::ifstream in(file);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(in, line);) {
      std::replace(line.begin(), line.end(), ',', ' ');
      std::istringstream words(line);
      std::vector<double> row(columns);
      bool whole = true;
      for (double& value : row) whole = whole && static_cast<bool>(words >> value);
      if (whole) rows.push_back(std::move(row));
    }
    return rows;
  }

 private:
  /// A fault: leaves that take in all light on their lower face.
  class BlackBehind final : public scene::Pattern {
   public:
    void apply(const geometry::SurfacePoint& point, scene::ResolvedSurface& surface) const override {
      if (!point.front) surface.constituents[0].state = surface.constituents[0].material = 2;
    }
  };

  void add_material(const char* name, double reflectance, double transmittance) {
    materials::Material material;
    material.name = name;
    material.reflectance = radiometry::Spectrum::constant(reflectance);
    if (transmittance > 0.0) material.transmittance = radiometry::Spectrum::constant(transmittance);
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    scene_.states.push_back({index, 0.0});
    scene::SurfaceAssignment assignment;
    assignment.states = {index};
    scene_.assignments.push_back(std::move(assignment));
  }

  scene::Scene scene_;
  std::unique_ptr<radiometry::SpectralNodes> nodes_;
  std::unique_ptr<transport::SpectralScene> spectral_;
};

}  // namespace ifov::test
