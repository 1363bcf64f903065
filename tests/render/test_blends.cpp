#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/mirror.h"
#include "radiometry/planck.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/grid_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/orthographic_camera.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_blends {
namespace {

using test::SmallScene;

constexpr double kSun = 1000.0;
const math::Ray kDown{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};

double planck(double temperature_k) {
  return radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, temperature_k);
}

/// Puts fixed shares of states side by side.
class FixedBlend final : public scene::Pattern {
 public:
  FixedBlend(std::vector<scene::Constituent> parts, bool mixes = true)
      : parts_(std::move(parts)), mixes_(mixes) {}
  void apply(const geometry::SurfacePoint&, scene::ResolvedSurface& surface) const override {
    surface.count = parts_.size();
    std::copy(parts_.begin(), parts_.end(), surface.constituents.begin());
  }
  bool mixes_materials() const override { return mixes_; }
  std::optional<scene::TemperatureRange> temperatures() const override {
    return scene::TemperatureRange{300.0, 340.0};
  }

 private:
  std::vector<scene::Constituent> parts_;
  bool mixes_;
};

/// Tilts the shading normal about a horizontal axis.
class Tilt final : public scene::Pattern {
 public:
  explicit Tilt(math::Vec3 added) : added_(added) {}
  void apply(const geometry::SurfacePoint& point, scene::ResolvedSurface& surface) const override {
    surface.shading_normal = math::as_normal(math::normalized(point.geometric_normal.as_vector() + added_));
  }

 private:
  math::Vec3 added_;
};

TEST(Blend, ReflectanceAndEmissionAreSharesOfTheParts) {
  SmallScene scene;
  const std::uint32_t bright = scene.material(0.6, 300.0), dark = scene.material(0.1, 320.0);
  scene.place(geometry::Plane{}, bright);
  scene.scene().assignments[bright].patterns.push_back(
      std::make_shared<FixedBlend>(std::vector<scene::Constituent>{
          {bright, bright, 0.3, 0.0}, {dark, dark, 0.5, 0.0}, {dark, dark, 0.2, 340.0}}));
  scene.sun({0.0, 0.3, 1.0}, kSun, 0.00465);
  scene.build();
  const double sine = 1.0 / std::sqrt(1.09);
  const double reflected = (0.3 * 0.6 + 0.7 * 0.1) * kSun * sine / std::numbers::pi;
  const double emitted = 0.3 * 0.4 * planck(300.0) + 0.9 * (0.5 * planck(320.0) + 0.2 * planck(340.0));
  const auto estimate = scene.radiance(kDown, 64);
  EXPECT_NEAR(estimate.mean, reflected + emitted, 2e-5 * estimate.mean);
  EXPECT_LT(estimate.standard_error, 1e-5 * estimate.mean);  // no chance is in it
}

/// A meadow with mirrors in it under a sky that nothing else lights: mean radiance.
SmallScene::Estimate meadow_with_mirrors(double mirror_share, double mirror_reflectance) {
  SmallScene scene;
  const std::uint32_t meadow = scene.material(0.4);
  const std::uint32_t mirror = scene.material(mirror_reflectance, 0.0, materials::Mirror::shared());
  scene.place(geometry::Plane{}, meadow);
  // A hot plate overhead that only the mirrors show whole.
  scene.place(geometry::Disk{{0.0, 0.0, 20.0}, 1.0}, scene.material(0.0, 400.0));
  scene.scene().assignments[meadow].patterns.push_back(
      std::make_shared<FixedBlend>(std::vector<scene::Constituent>{{meadow, meadow, 1.0 - mirror_share, 0.0},
                                                                   {mirror, mirror, mirror_share, 0.0}}));
  scene.build();
  return scene.radiance({{0.0, 0.0, 10.0}, {0.0, 0.0, -1.0}}, 1 << 16);
}

TEST(Blend, UnlikeShapesAreRightInTheMean) {
  const double view_factor = 1.0 / 401.0;  // of a disk of radius 1 seen from 20 m below (Howell, B-13)
  for (const double share : {0.1, 0.6}) {
    const auto estimate = meadow_with_mirrors(share, 0.8);
    const double expected = (share * 0.8 + (1.0 - share) * 0.4 * view_factor) * planck(400.0);
    EXPECT_NEAR(estimate.mean, expected, 4.0 * estimate.standard_error) << share;
    EXPECT_LT(estimate.standard_error, 0.02 * expected);
  }
}

/// A closed room at one temperature, its walls blended of unlike materials and bumped.
SmallScene::Estimate furnace(std::shared_ptr<const scene::Pattern> bump, bool whole_weights) {
  SmallScene scene;
  const std::uint32_t wall = scene.material(0.8, 300.0), other = scene.material(0.3, 300.0);
  const std::uint32_t mirror = scene.material(0.6, 300.0, materials::Mirror::shared());
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}, wall);
  auto& patterns = scene.scene().assignments[wall].patterns;
  patterns.push_back(std::make_shared<FixedBlend>(std::vector<scene::Constituent>{
      {wall, wall, 0.4, 0.0}, {other, other, 0.3, 0.0}, {mirror, mirror, whole_weights ? 0.3 : 0.28, 0.0}}));
  if (bump) patterns.push_back(std::move(bump));
  scene.build();
  return scene.radiance({{0.1, -0.2, 0.3}, math::normalized({0.3, 0.5, -0.7})}, 1 << 15);
}

TEST(Blend, FurnaceOfBlendedWallsReturnsPlanck) {
  const auto estimate = furnace(nullptr, true);
  EXPECT_LT(estimate.standard_error, 1e-3 * planck(300.0));
  EXPECT_NEAR(estimate.mean, planck(300.0), 3.0 * estimate.standard_error + 1e-6 * planck(300.0));
}

TEST(Blend, FurnaceOfBumpedWallsReturnsPlanck) {
  const auto estimate = furnace(std::make_shared<Tilt>(math::Vec3{0.5, 0.3, 0.4}), true);
  EXPECT_LT(estimate.standard_error, 1e-3 * planck(300.0));
  EXPECT_NEAR(estimate.mean, planck(300.0), 3.0 * estimate.standard_error + 1e-6 * planck(300.0));
}

TEST(Blend, PlantedFaultLostWeightFailsTheFurnace) {
  const auto estimate = furnace(nullptr, false);
  EXPECT_GT(std::abs(estimate.mean - planck(300.0)), 3.0 * estimate.standard_error + 1e-3 * planck(300.0));
}

/// Keeps the one tile of a small image.
struct KeptTile final : render::TileSink {
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { kept = tile; }
  sampling::TileResult kept;
};

/// Abundances are those of the map's shares, and of labels where nothing is mixed: a slab covers half of the pixel.
TEST(Blend, AbundancesAreTheSharesByArea) {
  SmallScene scene;
  const std::uint32_t bright = scene.material(0.6), dark = scene.material(0.1), slab = scene.material(0.3);
  scene.place(geometry::Plane{}, bright);
  scene.place(geometry::Box{{-5.0, -5.0, 0.0}, {0.0, 5.0, 0.1}}, slab);
  scene.scene().assignments[bright].patterns.push_back(std::make_shared<FixedBlend>(
      std::vector<scene::Constituent>{{bright, bright, 0.3, 0.0}, {dark, dark, 0.7, 0.0}}));
  scene.sky(1.0);
  const transport::SpectralScene& spectral = scene.build();
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = 1;
  settings.gsd_m = 1.0;
  settings.start_height_m = 10.0;
  const sensor::OrthographicCamera camera(settings);
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  const sampling::GridSampler sampler(4, 4);
  KeptTile sink;
  render::render_image({spectral, camera, footprint, sampler}, {}, sink);
  ASSERT_EQ(sink.kept.abundances.size(), 3u);
  EXPECT_EQ(sink.kept.columns, 1);
  const double expected[] = {0.15, 0.35, 0.5};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(sink.kept.abundances[k].material, k);
    EXPECT_NEAR(sink.kept.abundances[k].fraction, expected[k], 1e-6) << k;
  }
}

TEST(Bump, SunlightComesAtTheShadingNormalsCosine) {
  // Tilted by 45 degrees to the east, under a Sun 30 degrees off the zenith to the east and to the west.
  for (const double zenith : {0.5236, -0.5236}) {
    SmallScene scene;
    const std::uint32_t ground = scene.material(0.5);
    scene.place(geometry::Plane{}, ground);
    scene.scene().assignments[ground].patterns.push_back(std::make_shared<Tilt>(math::Vec3{1.0, 0.0, 0.0}));
    scene.sun({std::sin(zenith), 0.0, std::cos(zenith)}, kSun, 0.00465);
    scene.build();
    const auto estimate = scene.radiance(kDown, 256);
    EXPECT_NEAR(estimate.mean, 0.5 * kSun * std::cos(zenith - 0.7854) / std::numbers::pi, 1e-4 * kSun);
  }
}

TEST(Bump, LowSunFromBelowTheTiltComesMirrored) {
  // Sun 10 degrees above the eastern horizon; the normal leans 60 degrees to the east: cosines of 20 and of 40 degrees
  // (the Sun's mirror image below the horizon).
  SmallScene scene;
  const std::uint32_t ground = scene.material(0.5);
  scene.place(geometry::Plane{}, ground);
  scene.scene().assignments[ground].patterns.push_back(
      std::make_shared<Tilt>(math::Vec3{std::tan(std::numbers::pi / 3.0), 0.0, 0.0}));
  const double height = std::numbers::pi / 18.0;
  scene.sun({std::cos(height), 0.0, std::sin(height)}, kSun, 0.0);
  scene.build();
  const auto estimate = scene.radiance(kDown, 64);
  EXPECT_NEAR(estimate.mean,
              0.5 * kSun * (std::cos(2.0 * height) + std::cos(4.0 * height)) / std::numbers::pi, 1e-4 * kSun);
}

}  // namespace
}  // namespace ifov::test_blends
