// What a path among glossy walls of many colours may weigh, in the channel where it weighs most.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/format.h"
#include "geometry/world/world_builder.h"
#include "materials/bsdf/rough_conductor.h"
#include "materials/bsdf/rough_dielectric.h"
#include "materials/bsdf/ward.h"
#include "radiometry/channel.h"
#include "radiometry/refractive_index.h"
#include "radiometry/spectral_nodes.h"
#include "scene/scene.h"
#include "transport/path_light.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::test_weights_of_paths {
namespace {

using materials::FacetShape;
using radiometry::Spectrum;

std::shared_ptr<const materials::Bsdf> metal(std::string_view name, double slope) {
  const radiometry::RefractiveIndex& index = radiometry::refractive_index(name);
  return std::make_shared<materials::RoughConductor>(
      index.n, index.k, Spectrum::constant(1.0),
      materials::RoughConductor::Facets{FacetShape::ggx, slope, slope});
}

/// A metal whose directions are drawn as if it were matt: the planted fault.
class DrawnAsMatt final : public materials::Bsdf {
 public:
  explicit DrawnAsMatt(std::shared_ptr<const materials::Bsdf> metal) : metal_(std::move(metal)) {}
  std::span<const Spectrum> spectra() const override { return metal_->spectra(); }
  void evaluate(const materials::BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                float* bsdf) const override {
    metal_->evaluate(event, rows, count, bsdf);
  }

 private:
  std::shared_ptr<const materials::Bsdf> metal_;
};

/// A yard between walls of gold, red lacquer, blue plastic and aluminium, with a ball of copper, under an even sky of 1: what a path
/// brings is its weight.
class Yard {
 public:
  explicit Yard(const std::shared_ptr<const materials::Bsdf>& gold) {
    const auto coloured = [](std::vector<double> values) {
      return Spectrum({0.4, 0.5, 0.6, 0.9}, std::move(values));
    };
    const std::uint32_t walls[] = {
        material(gold),
        material(std::make_shared<materials::RoughDielectric>(
            Spectrum::constant(1.5), coloured({0.02, 0.02, 0.8, 0.9}), FacetShape::ggx, 0.15)),
        material(std::make_shared<materials::Ward>(coloured({0.7, 0.3, 0.02, 0.02}), Spectrum::constant(0.2),
                                                   0.2, 0.2, 0.0)),
        material(metal("aluminium", 0.3))};
    using math::Point3;
    const std::array<Point3, 5> corner = {
        Point3{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 1.0, 0.0}, {-1.0, -1.0, 0.0}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Point3 a = corner[k], b = corner[k + 1];
      place(geometry::Polygon{{b, a, {a.x, a.y, 2.0}, {b.x, b.y, 2.0}}}, walls[k]);
    }
    place(geometry::Plane{}, walls[1]);
    place(geometry::Sphere{{0.2, 0.3, 0.5}, 0.4}, material(metal("copper", 0.1)));
    scene_.sky.radiance = Spectrum::constant(1.0);
    scene_.surroundings = {material(metal("aluminium", 0.3)), 0.0};
    geometry::BuildOptions options{.threads = 1};
    options.surveyed = scene_.mirror_assignments();
    options.lobes = scene_.lobe_assignments();
    scene_.world = builder_.build(options);
    std::vector<radiometry::Channel> channels;
    for (const double um : {0.42, 0.47, 0.52, 0.57, 0.65, 0.8})
      channels.push_back(radiometry::Channel::monochromatic(format("{}", um), um));
    nodes_ = std::make_unique<radiometry::SpectralNodes>(
        radiometry::SpectralNodes::build(channels, Spectrum(), {}));
    spectral_ = std::make_unique<transport::SpectralScene>(scene_, *nodes_, false);
  }

  /// Of so many paths from above, whose weight in the worst channel is counted.
  struct Weights {
    double largest = 0.0, mean = 0.0;
  };
  Weights weights(std::uint32_t paths) const {
    constexpr std::uint32_t kBatch = 1 << 14;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> side(-0.95, 0.95);
    transport::PathTracer tracer(*spectral_, {});
    transport::PathLight light(*spectral_);
    sampling::RayCounts counts;
    std::vector<math::Ray> rays(kBatch);
    std::vector<transport::PathKey> keys(kBatch);
    std::vector<geometry::SurfacePoint> hits(kBatch);
    Weights found;
    for (std::uint32_t first = 0; first < paths; first += kBatch) {
      for (std::uint32_t k = 0; k < kBatch; ++k) {
        const math::Point3 from{side(random), side(random), 2.0}, to{side(random), side(random), 0.0};
        rays[k] = {from, math::normalized(to - from)};
        keys[k] = {1, first + k};
      }
      const transport::PathRecord& record = tracer.trace(rays, keys, hits, counts);
      for (std::uint32_t k = 0; k < kBatch; ++k) {
        const float* weight = light.radiance(record, k);
        const double worst = static_cast<double>(*std::max_element(weight, weight + nodes_->node_count()));
        found.largest = std::max(found.largest, worst);
        found.mean += worst / paths;
      }
    }
    return found;
  }

 private:
  std::uint32_t material(std::shared_ptr<const materials::Bsdf> bsdf) {
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    materials::Material material;
    material.name = format("m{}", index);
    material.reflectance = Spectrum::constant(1.0);
    material.bsdf = std::move(bsdf);
    scene_.materials.push_back(material);
    scene_.states.push_back({index, 0.0});
    scene::SurfaceAssignment assignment;
    assignment.states = {index};
    scene_.assignments.push_back(assignment);
    return index;
  }
  void place(geometry::Shape shape, std::uint32_t material) {
    const geometry::ShapeId id = builder_.add_shape(std::move(shape));
    builder_.place(id, {}, std::vector<std::uint32_t>(builder_.slot_count(id), material));
  }

  scene::Scene scene_;
  geometry::WorldBuilder builder_;
  std::unique_ptr<radiometry::SpectralNodes> nodes_;
  std::unique_ptr<transport::SpectralScene> spectral_;
};

TEST(WeightsOfPaths, AmongGlossyWallsOfManyColoursAreBounded) {
  const auto gold = metal("gold", 0.1);
  const Yard::Weights found = Yard(gold).weights(1 << 17);
  std::printf("largest weight of 2^17 paths in the worst of 6 channels: %.2f, mean %.3f\n", found.largest,
              found.mean);
  RecordProperty("largest", format("{:.3f}", found.largest));
  EXPECT_LT(found.largest, 2.5);  // 1.62 of 2^20
  const Yard::Weights matt = Yard(std::make_shared<DrawnAsMatt>(gold)).weights(1 << 14);
  EXPECT_GT(matt.largest, 20.0) << "gold that is drawn as if it were matt is as bounded";
}

}  // namespace
}  // namespace ifov::test_weights_of_paths
