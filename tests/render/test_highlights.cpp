// The Sun's highlights in narrow lobes, against sums over the shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "materials/bsdf/bsdf.h"
#include "materials/bsdf/rough_conductor.h"
#include "render/mirrors/highlights.h"
#include "sampling/footprint_groups.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/orthographic_camera.h"
#include "transport/mirrors/sun_lobes.h"
#include "transport/small_scene.h"

namespace ifov::test_highlights {
namespace {

using materials::BsdfEvent;
using std::numbers::pi;
using test::SmallScene;

/// Facets that do not hide each other, of Gaussian slopes or with a long tail (GGX), over a Lambertian base.
class Lobe final : public materials::Bsdf {
 public:
  Lobe(double slope, double base, bool tail = false) : slope_(slope), base_(base), tail_(tail) {}
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, materials::ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override {
    const double value = of(event);
    for (std::size_t n = 0; n < count; ++n) bsdf[n] = parameters[0][n] * static_cast<float>(value);
  }
  double grey(const BsdfEvent& event) const override { return of(event); }
  LobeSlopes lobe_slopes() const override { return {slope_, slope_}; }
  double lobe_share(const BsdfEvent& event) const override { return lobe(event) / of(event); }

  double lobe(const BsdfEvent& event) const {
    const math::Vec3 half = math::normalized(event.outgoing + event.incoming);
    const double cosine = math::dot(event.normal, half), square = cosine * cosine;
    const double tangent2 = (1.0 - square) / square;
    const double over = tangent2 / (slope_ * slope_);
    const double distribution = (tail_ ? 1.0 / ((1.0 + over) * (1.0 + over)) : std::exp(-over)) /
                                (pi * slope_ * slope_ * square * square);
    return distribution / 4.0 / std::max(event.outgoing_cosine(), event.incoming_cosine());
  }
  double of(const BsdfEvent& event) const { return lobe(event) + base_ / pi; }

 private:
  double slope_, base_;
  bool tail_;
  std::vector<radiometry::Spectrum> spectra_{radiometry::Spectrum::constant(0.5)};
};

constexpr double kFactor = 0.5, kIrradiance = 1000.0, kRadius = 0.4, kGsd = 1.0;
constexpr int kSide = 4;
const math::Vec3 kSun = math::normalized({0.6, 0.2, 1.0});

sensor::OrthographicCamera nadir_camera(double gsd_m) {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.gsd_m = gsd_m;
  settings.start_height_m = 100.0;
  return sensor::OrthographicCamera(settings);
}

/// Sum over the pixels of what highlights add, and its standard error.
struct Sum {
  double mean = 0.0, error = 0.0;
};
Sum highlights_of(const transport::SpectralScene& scene, std::uint64_t seed = 1, double gsd_m = kGsd) {
  const auto camera = nadir_camera(gsd_m);
  sampling::TileResult tile;
  tile.reset({0, 0, kSide, kSide}, 1);
  if (render::Highlights::in(scene))
    render::Highlights(scene, camera, 0.5, seed).add_to(sampling::PixelFootprint::box(1.0), nullptr, tile);
  Sum sum;
  for (std::size_t k = 0; k < tile.mean.size(); ++k) {
    sum.mean += static_cast<double>(tile.mean[k]);
    sum.error += static_cast<double>(tile.variance_path[k]);
  }
  sum.error = std::sqrt(sum.error);
  return sum;
}

/// What a ball sends straight up of sunlight, in pixels; `weigh` each direction's BSDF.
template <class Weigh>
double sent_by_ball(const Weigh& weigh) {
  constexpr int kAcross = 1500;
  double sum = 0.0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const double x = (2.0 * i + 1.0) / kAcross - 1.0, y = (2.0 * j + 1.0) / kAcross - 1.0;
      if (x * x + y * y >= 1.0) continue;
      BsdfEvent event;
      event.outgoing = {0.0, 0.0, 1.0};
      event.incoming = kSun;
      event.normal = math::as_normal({x, y, std::sqrt(1.0 - x * x - y * y)});
      if (event.incoming_cosine() > 0.0) sum += weigh(event) * event.incoming_cosine();
    }
  return sum * kFactor * kIrradiance * 4.0 * kRadius * kRadius / (kAcross * kAcross) / (kGsd * kGsd);
}

struct Ball : SmallScene {
  Ball(double slope, double base, double half_angle, double x = 0.13, bool tail = false)
      : lobe(std::make_shared<Lobe>(slope, base, tail)) {
    place(geometry::Sphere{{x, 0.21, 1.0}, kRadius}, material(kFactor, 0.0, lobe));
    sun(kSun, kIrradiance, half_angle);
  }
  std::shared_ptr<Lobe> lobe;
};

TEST(Highlights, AreTheLobesShareOfABallsSunlight) {
  for (const double slope : {0.1, 0.2})
    for (const double base : {0.0, 0.4})
      for (const double half_angle : {0.0, 0.00465}) {
        Ball ball(slope, base, half_angle);
        const Sum found = highlights_of(ball.build());
        const double expected = sent_by_ball([&](const BsdfEvent& event) {
          return ball.lobe->of(event) * transport::SunLobes::seen_share(*ball.lobe, event);
        });
        EXPECT_NEAR(found.mean, expected, 4.0 * found.error + 1e-3 * expected) << slope << " " << base;
        EXPECT_LT(found.error, 5e-3 * expected);
        // All of the lobe but its tail, which is none here.
        const double whole = sent_by_ball([&](const BsdfEvent& event) { return ball.lobe->lobe(event); });
        EXPECT_NEAR(expected, whole, 5e-3 * whole) << slope << " " << base;
      }
}

/// Rims of balls, where the tail of a real model is seen at grazing angles: triangles are wide there, and their images curved.
TEST(Highlights, TailsReachTheBallsRim) {
  const auto gold = std::make_shared<materials::RoughConductor>(
      radiometry::Spectrum::constant(0.15), radiometry::Spectrum::constant(3.5),
      radiometry::Spectrum::constant(1.0),
      materials::RoughConductor::Facets{materials::FacetShape::ggx, 0.29, 0.29, 0.0});
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : gold->spectra())
    values.push_back(static_cast<float>(spectrum.at(10.0)));
  for (const float& value : values) rows.push_back(&value);
  const double expected = sent_by_ball([&](const BsdfEvent& event) {
                            float bsdf = 0.0f;
                            gold->evaluate(event, rows, 1, &bsdf);
                            return static_cast<double>(bsdf) * transport::SunLobes::seen_share(*gold, event);
                          }) /
                          kFactor;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SmallScene scene;
    scene.place(geometry::Sphere{{0.5, 0.5, 2.0}, kRadius}, scene.material(1.0, 0.0, gold));
    scene.sun(kSun, kIrradiance, 0.0);
    const Sum found = highlights_of(scene.build(), seed);
    sum += found.mean / 20.0, squares += found.error * found.error;
  }
  const double error = std::sqrt(squares) / 20.0;
  EXPECT_NEAR(sum, expected, 4.0 * error + 1e-4 * expected) << (sum - expected) / expected;
  EXPECT_LT(error, 1e-3 * expected);
  RecordProperty("off", std::to_string((sum - expected) / expected));
}

TEST(Highlights, ErrorsOfPixelsHold) {
  const double whole = sent_by_ball([&](const BsdfEvent& event) { return Lobe(0.1, 0.0).lobe(event); });
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Ball ball(0.1, 0.0, 0.00465, 0.013 * static_cast<double>(seed));
    const Sum found = highlights_of(ball.build(), seed);
    held += std::abs(found.mean - whole) <= 2.5 * found.error + 5e-4 * whole;
  }
  EXPECT_GE(held, 93);
}

/// 100 balls are more than there is room for at the usual steps; at wider ones their highlights stay whole, and none is left to paths.
TEST(Highlights, OfManySmallThingsAreLookedAtMoreCoarsely) {
  constexpr int kAcross = 10;
  const auto lobe = std::make_shared<Lobe>(0.05, 0.0, true);
  SmallScene scene;
  const auto metal = scene.material(kFactor, 0.0, lobe);
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j)
      scene.place(geometry::Sphere{{3.0 * i - 13.3, 3.0 * j - 13.6, 1.0}, kRadius}, metal);
  scene.sun(kSun, kIrradiance, 0.00465);
  const transport::SpectralScene& spectral = scene.build();
  const auto camera = nadir_camera(10.0);
  const render::Highlights highlights(spectral, camera, 0.5, 1);
  EXPECT_TRUE(highlights.large().empty());
  EXPECT_TRUE(highlights.unsure().empty());
  sampling::TileResult tile;
  tile.reset({0, 0, kSide, kSide}, 1);
  highlights.add_to(sampling::PixelFootprint::box(1.0), nullptr, tile);
  double mean = 0.0, variance = 0.0;
  for (std::size_t k = 0; k < tile.mean.size(); ++k) {
    mean += static_cast<double>(tile.mean[k]);
    variance += static_cast<double>(tile.variance_path[k]);
  }
  const auto sent = [](const Lobe& of) {
    return kAcross * kAcross / 100.0 * sent_by_ball([&](const BsdfEvent& event) {
             return of.of(event) * transport::SunLobes::seen_share(of, event);
           });
  };
  const double expected = sent(*lobe);
  EXPECT_NEAR(mean, expected, 4.0 * std::sqrt(variance) + 1e-3 * expected);
  EXPECT_LT(std::sqrt(variance), 2e-3 * expected);
  // Planted fault: three of the balls' highlights are lost.
  EXPECT_GT(std::abs(0.97 * expected - mean), 4.0 * std::sqrt(variance) + 1e-3 * expected);
}

/// Facets of a ball: what each shows is even, and together they show what the ball does.
TEST(Highlights, FacetsAreFoundToo) {
  constexpr int kRings = 120;
  geometry::TriangleMesh mesh;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j <= 2 * kRings; ++j) {
      const double a = pi * i / kRings, b = pi * j / kRings;
      mesh.vertices_m.push_back({kRadius * std::sin(a) * std::cos(b), kRadius * std::sin(a) * std::sin(b),
                                 1.0 + kRadius * std::cos(a)});
    }
  for (std::uint32_t i = 0; i < kRings; ++i)
    for (std::uint32_t j = 0; j < 2 * kRings; ++j) {
      const std::uint32_t a = i * (2 * kRings + 1) + j, b = a + 2 * kRings + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  SmallScene scene;
  const auto lobe = std::make_shared<Lobe>(0.1, 0.0);
  scene.place(std::move(mesh), scene.material(kFactor, 0.0, lobe));
  scene.sun(kSun, kIrradiance, 0.00465);
  const Sum found = highlights_of(scene.build());
  const double whole = sent_by_ball([&](const BsdfEvent& event) { return lobe->lobe(event); });
  EXPECT_NEAR(found.mean, whole, 0.02 * whole);
}

TEST(Highlights, NothingBeforeThemOrBetweenThemAndTheSun) {
  const math::Point3 middle =
      math::Point3{0.13, 0.21, 1.0} + math::normalized(kSun + math::Vec3{0.0, 0.0, 1.0}) * kRadius;
  for (const math::Vec3 leg : {math::Vec3{0.0, 0.0, 1.0}, kSun}) {
    Ball ball(0.1, 0.0, 0.00465);
    const math::Point3 at = middle + leg * 3.0;
    ball.place(geometry::Box{at - math::Vec3{1.0, 1.0, 0.05}, at + math::Vec3{1.0, 1.0, 0.05}},
               ball.material(0.1));
    EXPECT_EQ(highlights_of(ball.build()).mean, 0.0);
  }
}

TEST(Highlights, PathsLeaveOutWhatTheyAreAndNoMore) {
  using Kind = transport::TransportOptions::Highlights;
  Ball ball(0.15, 0.3, 0.0);
  ball.build();
  for (int k = 0; k < 40; ++k) {
    const math::Ray ray{.origin_m = {0.13 + kRadius * (k / 20.0 - 0.99), 0.21, 50.0},
                        .direction = {0.0, 0.0, -1.0}};
    const auto with = [&](Kind kind) {
      transport::TransportOptions options;
      options.maximum_scatterings = 1;
      options.highlights = kind;
      return ball.radiance(ray, 2, 1, options).mean;
    };
    const double all = with(Kind::found);
    EXPECT_NEAR(with(Kind::left_out) + with(Kind::alone), all, 1e-6 * all);
    // What is left is as even as the base: 3 times that of a white wall, at most.
    EXPECT_LE(with(Kind::left_out), 1.001 * kFactor * kIrradiance * 0.3 / pi);
  }
}

TEST(Highlights, WhatFillsManyPixelsIsLeftToPaths) {
  Ball ball(0.1, 0.0, 0.0);
  const std::uint32_t lobe = 0;
  ball.place(geometry::Sphere{{0.13, 1.2, 1.0}, 0.002}, lobe);
  const transport::SpectralScene& scene = ball.build();
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = 4000;
  settings.gsd_m = 0.001;
  settings.start_height_m = 100.0;
  const render::Highlights found(scene, sensor::OrthographicCamera(settings), 0.5, 1);
  EXPECT_EQ(found.large(), std::vector<std::uint32_t>{0});
  EXPECT_GT(found.count(), 100u);  // of the small ball
  EXPECT_LT(found.count(), 20000u);

  const math::Ray ray{.origin_m = {0.13, 0.21, 50.0}, .direction = {0.0, 0.0, -1.0}};
  transport::TransportOptions options;
  options.maximum_scatterings = 1;
  const double all = ball.radiance(ray, 2, 1, options).mean;
  options.highlights = transport::TransportOptions::Highlights::left_out;
  EXPECT_LT(ball.radiance(ray, 2, 1, options).mean, 1e-3 * all);
  options.large_lobes = &found.large();
  EXPECT_EQ(ball.radiance(ray, 2, 1, options).mean, all);
}

TEST(Highlights, WideLobesAndPlanesAreLeftToPaths) {
  Ball wide(0.35, 0.0, 0.0);
  EXPECT_FALSE(render::Highlights::in(wide.build()));
  SmallScene flat;
  flat.place(geometry::Plane{}, flat.material(kFactor, 0.0, std::make_shared<Lobe>(0.1, 0.0)));
  flat.sun(kSun, kIrradiance, 0.0);
  EXPECT_FALSE(render::Highlights::in(flat.build()));
}

}  // namespace
}  // namespace ifov::test_highlights
