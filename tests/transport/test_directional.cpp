// Models that are not separable: what a path keeps of its events, and directional emission.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/bsdf/hapke.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/oren_nayar.h"
#include "materials/bsdf/ross_li.h"
#include "materials/bsdf/roujean.h"
#include "materials/bsdf/rpv.h"
#include "radiometry/planck.h"
#include "transport/small_scene.h"
#include "transport/spectral_scene.h"

namespace ifov::test_directional {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using test::SmallScene;

/// Lambert's law, told by event: reflectance / pi here, transmittance / pi there.
class ByEvent final : public materials::Bsdf {
 public:
  ByEvent(Spectrum reflectance, Spectrum transmittance, double fault = 1.0)
      : spectra_{std::move(reflectance), std::move(transmittance)}, fault_(fault) {}
  bool may_transmit() const override { return spectra_[1].maximum() > 0.0; }
  std::span<const Spectrum> spectra() const override { return spectra_; }
  void evaluate(const materials::BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                float* bsdf) const override {
    const bool reflected = event.side == materials::Side::reflected;
    // A direction on the wrong side would be a path's mistake.
    EXPECT_GT(event.incoming_cosine(), -1e-9);
    EXPECT_GT(event.outgoing_cosine(), -1e-9);
    for (std::size_t n = 0; n < count; ++n)
      bsdf[n] =
          rows[reflected ? 0 : 1][n] * static_cast<float>((reflected ? 1.0 : fault_) / std::numbers::pi);
  }

 private:
  std::vector<Spectrum> spectra_;
  double fault_;
};

/// Makes every Lambertian material of a scene tell its law by event.
void by_event(scene::Scene& scene, double fault = 1.0) {
  for (materials::Material& m : scene.materials)
    if (m.bsdf->is_separable() && !m.bsdf->is_delta() && m.reflectance.maximum() > 0.0)
      m.bsdf =
          std::make_shared<ByEvent>(m.reflectance, m.transmittance.value_or(Spectrum::constant(0.0)), fault);
}

/// Tilts the shading normal, and lays a mirror over a part of the surface.
class Tilt final : public scene::Pattern {
 public:
  explicit Tilt(std::optional<std::uint32_t> mirror) : mirror_(mirror) {}
  void apply(const geometry::SurfacePoint&, scene::ResolvedSurface& surface) const override {
    surface.shading_normal =
        math::as_normal(math::normalized(surface.shading_normal.as_vector() + Vec3{0.35, 0.2, 0.0}));
    if (!mirror_) return;
    surface.constituents[1] = surface.constituents[0];
    surface.constituents[1].state = surface.constituents[1].material = *mirror_;
    surface.constituents[0].weight = 0.6;
    surface.constituents[1].weight = 0.4;
    surface.count = 2;
  }
  bool mixes_materials() const override { return mirror_.has_value(); }
  bool bends_normals() const override { return true; }

 private:
  std::optional<std::uint32_t> mirror_;
};

enum class Ground { plain, tilted, mixed };

/// Ground, a facade and a ball that mirror, a leaf, a hot ball; Sun and sky.
SmallScene::Estimate yard(Ground ground, const math::Ray& ray, bool directional, double fault = 1.0) {
  SmallScene scene;
  const std::uint32_t soil = scene.material(0.5, 290.0);
  const std::uint32_t mirror = scene.material(0.8, 0.0, materials::Mirror::shared());
  scene.place(geometry::Plane{}, soil);
  scene.place(geometry::Polygon{{{3.0, -4.0, 0.0}, {3.0, 4.0, 0.0}, {3.0, 4.0, 6.0}, {3.0, -4.0, 6.0}}},
              mirror);
  scene.place(geometry::Sphere{{1.0, 2.0, 0.7}, 0.5}, mirror);
  scene.place(geometry::Disk{{-1.0, 0.5, 1.0}, 0.8}, scene.leaf(0.4, 0.45, 285.0),
              math::Transform::rotation(math::normalized({1.0, 1.0, 0.0}), 0.3));
  scene.place(geometry::Sphere{{0.8, -0.8, 0.6}, 0.2}, scene.material(0.2, 900.0));
  if (ground != Ground::plain)
    scene.scene().assignments[soil].patterns.push_back(
        std::make_shared<Tilt>(ground == Ground::mixed ? std::optional(mirror) : std::nullopt));
  scene.sun({-0.8, 0.1, 1.0}, 300.0, 0.00465);
  scene.sky(20.0);
  if (directional) by_event(scene.scene(), fault);
  scene.build();
  return scene.radiance(ray, 1 << 12);
}

const math::Ray kOnGround{{0.2, 0.3, 5.0}, math::normalized({0.02, -0.04, -1.0})},
    kOnLeaf{{-1.1, 0.4, 5.0}, {0.0, 0.0, -1.0}};

TEST(DirectionalModels, LambertsLawByEventIsLambertsLaw) {
  for (const Ground ground : {Ground::plain, Ground::tilted, Ground::mixed})
    for (const math::Ray& ray : {kOnGround, kOnLeaf}) {
      const auto separable = yard(ground, ray, false), directional = yard(ground, ray, true);
      const double error = std::hypot(separable.standard_error, directional.standard_error);
      EXPECT_NEAR(directional.mean, separable.mean, 3.0 * error) << static_cast<int>(ground);
      EXPECT_NEAR(directional.mean, separable.mean, 1e-3 * separable.mean) << static_cast<int>(ground);
    }
}

TEST(DirectionalModels, PlantedFaultOfOneSideIsSeen) {
  const auto separable = yard(Ground::plain, kOnLeaf, false),
             wrong = yard(Ground::plain, kOnLeaf, true, 0.97);
  EXPECT_GT(std::abs(wrong.mean - separable.mean), 1e-3 * separable.mean);
}

std::uint32_t scattering_by(SmallScene& scene, const std::shared_ptr<const materials::Bsdf>& bsdf,
                            double temperature_k) {
  const Spectrum whole =
      materials::directional_hemispherical(*bsdf, materials::Side::reflected, materials::kBihemispherical);
  return scene.material(whole.values()[0], temperature_k, bsdf);
}

std::uint32_t rough(SmallScene& scene, double reflectance, double slope_rad, double temperature_k = 0.0) {
  return scattering_by(scene,
                       std::make_shared<materials::OrenNayar>(Spectrum::constant(reflectance), slope_rad),
                       temperature_k);
}

TEST(DirectionalModels, FurnaceReturnsPlanck) {
  // Emissivity by angle and reflection by event belong together (Kirchhoff).
  SmallScene scene;
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}, rough(scene, 0.8, 0.5, 300.0));
  scene.place(geometry::Sphere{{0.3, 0.4, -0.6}, 0.3}, rough(scene, 0.6, 0.9, 300.0));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  for (const Vec3 towards : {Vec3{0.3, 0.5, -0.7}, {0.9, 0.05, 0.1}, {0.2, 0.6, -0.9}}) {
    const auto estimate = scene.radiance({{0.1, -0.2, 0.3}, math::normalized(towards)}, 1 << 15);
    EXPECT_LT(estimate.standard_error, 2e-3 * expected);
    EXPECT_NEAR(estimate.mean, expected, 3.0 * estimate.standard_error + 3e-4 * expected);
  }
}

TEST(DirectionalModels, FurnaceOfLandReturnsPlanck) {
  // Their hot spots are sharp, and emissivity is known less well.
  SmallScene scene;
  const auto constant = [](double value) { return Spectrum::constant(value); };
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}},
              scattering_by(scene, std::make_shared<materials::Rpv>(constant(0.2), 0.8, -0.1), 300.0));
  scene.place(
      geometry::Sphere{{0.3, 0.4, -0.6}, 0.3},
      scattering_by(scene,
                    std::make_shared<materials::RossLi>(constant(0.3), constant(0.15), constant(0.02), 0.026),
                    300.0));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  for (const Vec3 towards : {Vec3{0.3, 0.5, -0.7}, {0.9, 0.05, 0.1}, {0.2, 0.6, -0.9}}) {
    const auto estimate = scene.radiance({{0.1, -0.2, 0.3}, math::normalized(towards)}, 1 << 15);
    EXPECT_LT(estimate.standard_error, 2e-3 * expected);
    EXPECT_NEAR(estimate.mean, expected, 3.0 * estimate.standard_error + 5e-4 * expected);
  }
}

TEST(DirectionalModels, FurnaceOfSoilReturnsPlanck) {
  SmallScene scene;
  const auto constant = [](double value) { return Spectrum::constant(value); };
  materials::HapkeParameters regolith;
  regolith.b0 = 0.8;
  regolith.h = 0.1;
  regolith.b = 0.5;
  regolith.roughness_rad = 0.35;
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}},
              scattering_by(scene, std::make_shared<materials::Hapke>(constant(0.7), regolith), 300.0));
  scene.place(
      geometry::Sphere{{0.3, 0.4, -0.6}, 0.3},
      scattering_by(scene, std::make_shared<materials::Roujean>(constant(0.4), constant(0.05), constant(0.3)),
                    300.0));
  scene.build();
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  for (const Vec3 towards : {Vec3{0.3, 0.5, -0.7}, {0.9, 0.05, 0.1}, {-0.5, 0.5, 0.2}}) {
    const auto estimate = scene.radiance({{0.1, -0.2, 0.3}, math::normalized(towards)}, 1 << 15);
    EXPECT_LT(estimate.standard_error, 2e-3 * expected);
    EXPECT_NEAR(estimate.mean, expected, 3.0 * estimate.standard_error + 2e-3 * expected);
  }
}

/// Rough when its emissivity is worked out, and smoother when it scatters.
class Inconsistent final : public materials::Bsdf {
 public:
  Inconsistent(double slope_rad, std::shared_ptr<const bool> events)
      : rough_(Spectrum::constant(0.8), slope_rad),
        smooth_(Spectrum::constant(0.8), 0.9 * slope_rad),
        events_(std::move(events)) {}
  std::span<const Spectrum> spectra() const override { return rough_.spectra(); }
  void evaluate(const materials::BsdfEvent& event, materials::ParameterSpectra rows, std::size_t count,
                float* bsdf) const override {
    (*events_ ? smooth_ : rough_).evaluate(event, rows, count, bsdf);
  }

 private:
  materials::OrenNayar rough_, smooth_;
  std::shared_ptr<const bool> events_;
};

TEST(DirectionalModels, PlantedFaultOtherEmissivityFailsTheFurnace) {
  SmallScene scene;
  const auto events = std::make_shared<bool>(false);
  scene.place(geometry::Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}},
              scene.material(0.7, 300.0, std::make_shared<Inconsistent>(0.5, events)));
  scene.build();
  *events = true;
  const double expected = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  const auto estimate = scene.radiance({{0.1, -0.2, 0.3}, math::normalized({0.3, 0.5, -0.7})}, 1 << 17);
  EXPECT_GT(std::abs(estimate.mean - expected), 3.0 * estimate.standard_error + 3e-4 * expected);
}

TEST(DirectionalModels, SunlitPlaneShowsItsBrdf) {
  constexpr double kSlope = 0.6, kIrradiance = 1000.0;
  const Vec3 sun = math::normalized({-0.7, 0.2, 1.0});
  for (const Vec3 view : {Vec3{0.0, 0.0, 1.0}, {-1.0, 0.3, 1.0}, {1.0, -0.3, 1.0}}) {
    SmallScene scene;
    scene.place(geometry::Plane{}, rough(scene, 0.5, kSlope));
    scene.sun(sun, kIrradiance, 0.0);
    scene.build();
    const Vec3 towards = math::normalized(view);
    const auto found = scene.radiance({{5.0 * towards.x, 5.0 * towards.y, 5.0 * towards.z}, -towards}, 4);
    const auto terms = materials::OrenNayar(Spectrum::constant(0.5), kSlope)
                           .terms({towards, sun, {0.0, 0.0, 1.0}, {}, materials::Side::reflected});
    const double expected = (0.5 * terms[0] + 0.25 * terms[1]) * kIrradiance * sun.z;
    EXPECT_NEAR(found.mean, expected, 1e-5 * expected);
  }
}

TEST(DirectionalModels, EmissionDependsOnTheView) {
  SmallScene scene;
  scene.place(geometry::Plane{}, rough(scene, 0.8, 0.9, 300.0));
  scene.build();
  const materials::OrenNayar bsdf(Spectrum::constant(0.8), 0.9);
  const double planck = radiometry::planck_w_m2_sr_um(SmallScene::kWavelength_um, 300.0);
  for (const double cosine : {1.0, 0.5, 0.15}) {
    const Vec3 towards{std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
    const double reflectance =
        materials::directional_hemispherical(bsdf, materials::Side::reflected, cosine).values()[0];
    const auto found = scene.radiance({{5.0 * towards.x, 0.0, 5.0 * cosine}, -towards}, 4);
    EXPECT_NEAR(found.mean, (1.0 - reflectance) * planck, 2e-4 * planck) << cosine;
  }
}

}  // namespace
}  // namespace ifov::test_directional
