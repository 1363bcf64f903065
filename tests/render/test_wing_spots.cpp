// Tiny hot targets far beside a pixel, against the density of the PSF beyond its cut, integrated over the pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "render/tolerance/accuracy_tolerance.h"
#include "render/wings/wing_light.h"
#include "render/wings/wing_spots.h"
#include "sampling/tile.h"
#include "sensor/airy_aperture.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"

namespace ifov::render::test_wing_spots {
namespace {

struct Disc {
  double x, y, radius, value;
  double light() const { return std::numbers::pi * radius * radius * value; }
};

/// Discs, the first on top, before an even background; a screen left of `screen_px` hides discs.
class DiscField final : public sampling::Field {
 public:
  DiscField(double background, std::vector<Disc> discs, double screen_px = -1e9)
      : background_(background), discs_(std::move(discs)), screen_(screen_px) {}
  int columns() const override { return 1; }
  double at(sampling::FocalPoint p) const {
    if (p.x_px >= screen_)
      for (const Disc& disc : discs_)
        if (std::hypot(p.x_px - disc.x, p.y_px - disc.y) < disc.radius) return disc.value;
    return background_;
  }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = at(points[k]) != background_;
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = at(requests[k].point) != background_;
      values[k * static_cast<std::size_t>(stride())] = static_cast<float>(at(requests[k].point));
    }
  }
  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label);
  }
  sampling::RayCounts counts() const override { return {}; }

 private:
  double background_;
  std::vector<Disc> discs_;
  double screen_;
};

constexpr double kBackground = 1.0;

WingSpots spots_about(const std::vector<Disc>& discs) {
  std::vector<WingSpots::Box> boxes;
  for (const Disc& d : discs) {
    WingSpots::Box box{};
    box.centre = {d.x, d.y};
    box.half_width_px = box.half_height_px = 1.05 * d.radius;
    boxes.push_back(box);
  }
  return WingSpots(std::move(boxes));
}

/// Of a tile that knows the background within the cut.
sampling::TileResult gathered(const sensor::Psf& psf, DiscField field, const WingSpots* spots,
                              sampling::PixelRect rect, std::uint64_t seed) {
  const sensor::PsfWings wings(psf, 1.0);
  sampling::TileProblem problem;
  problem.tile = rect;
  problem.image = {0, 0, 64, 64};
  problem.seed = seed;
  sampling::TileResult tile;
  tile.reset(rect, 1);
  std::fill(tile.mean.begin(), tile.mean.end(), static_cast<float>(kBackground));
  tile.reasons.assign(tile.reasons.size(), 0);
  std::optional<SpotLight> light;
  if (spots != nullptr) light.emplace(*spots, seed, nullptr, field);
  add_wings(std::vector<const sensor::PsfWings*>{&wings}, problem, nullptr, light ? &*light : nullptr, field,
            tile);
  tile.join_bounds(joint_of(nullptr));
  return tile;
}

/// Of the light of a point, what falls on a whole pixel from beyond the cut.
double share(const sensor::Psf& psf, double dx, double dy, bool smooth = false) {
  constexpr int kSteps = 24;
  double sum = 0.0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i)
      sum += psf.cut_density(dx + (i + 0.5) / kSteps - 0.5, dy + (j + 0.5) / kSteps - 0.5, smooth);
  return sum / (kSteps * kSteps);
}

struct Fit {
  int pixels = 0, inside = 0;
  double worst = 0.0, widest = 0.0;  ///< error and half-width, over what the mean of the rings is or more
};

/// What discs of some light, over that of the background, add to the pixels of a tile.
void compare(const sampling::TileResult& tile, const sensor::Psf& psf, const std::vector<Disc>& discs,
             const std::vector<double>& light, Fit& fit) {
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    const int width = tile.tile.width(), index = static_cast<int>(p);
    const double x = tile.tile.x0 + index % width + 0.5, y = tile.tile.y0 + index / width + 0.5;
    double expected = 0.0, even = 0.0;
    for (std::size_t k = 0; k < discs.size(); ++k) {
      expected += light[k] * share(psf, discs[k].x - x, discs[k].y - y);
      even += light[k] * share(psf, discs[k].x - x, discs[k].y - y, true);
    }
    if (!(expected > 0.0)) continue;  // within the cut
    const double error = std::abs(tile.mean[p] - kBackground - expected), scale = std::max(expected, even);
    ++fit.pixels;
    fit.inside += error <= tile.half_width[p];
    fit.worst = std::max(fit.worst, error / scale);
    fit.widest = std::max(fit.widest, tile.half_width[p] / scale);
  }
}

std::string told(const Fit& with, const Fit& without) {
  return std::to_string(with.inside) + " of " + std::to_string(with.pixels) + " worst " +
         std::to_string(with.worst) + " widest " + std::to_string(with.widest) + ", by cells alone " +
         std::to_string(without.inside);
}

constexpr sampling::PixelRect kRow{8, 20, 44, 21};

double over_background(const Disc& d) { return d.light() * (1.0 - kBackground / d.value); }

class WingSpotsOfApertures : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(WingSpotsOfApertures, ATinyHotTargetSendsWhatThePsfSays) {
  const auto [q, covered] = GetParam();
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.04 * q, 20e-6, covered});
  Fit with, without;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const double part = static_cast<double>(seed) / 5.0, radius = 0.002 + 0.04 * part;
    const std::vector<Disc> discs{{48.1 + part, 20.9 - part, radius, 1e4 / (radius * radius)}};
    const WingSpots spots = spots_about(discs);
    const std::vector<double> light{over_background(discs[0])};
    compare(gathered(*psf, DiscField(kBackground, discs), &spots, kRow, seed), *psf, discs, light, with);
    compare(gathered(*psf, DiscField(kBackground, discs), nullptr, kRow, seed), *psf, discs, light, without);
  }
  RecordProperty("told", told(with, without));
  EXPECT_GE(with.inside, 0.93 * with.pixels);
  EXPECT_LT(with.worst, 0.3);
  EXPECT_LT(with.widest, 0.5);
  EXPECT_LT(without.inside, 0.2 * without.pixels);  // the planted fault: cells alone
}

INSTANTIATE_TEST_SUITE_P(Airy, WingSpotsOfApertures,
                         ::testing::Values(std::pair{0.5, 0.0}, std::pair{0.5, 0.35}, std::pair{1.0, 0.0},
                                           std::pair{1.0, 0.35}, std::pair{2.0, 0.0}, std::pair{2.0, 0.5}));

// Boxes overlap, and where they do the light is of one.
TEST(WingSpots, ARowOfTenSendsAsMuchAsTenDo) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.02, 20e-6});
  std::vector<Disc> discs;
  std::vector<double> light;
  for (int k = 0; k < 10; ++k) {
    discs.push_back({48.0 + 0.031 * k, 20.3 + 0.031 * k, 0.02, 1e7});
    light.push_back(over_background(discs.back()));
  }
  Fit with, twice, without;
  const WingSpots spots = spots_about(discs);
  compare(gathered(*psf, DiscField(kBackground, discs), &spots, kRow, 3), *psf, discs, light, with);
  compare(gathered(*psf, DiscField(kBackground, discs), nullptr, kRow, 3), *psf, discs, light, without);
  // The planted fault: what overlaps counts twice.
  std::vector<double> half(light);
  for (double& l : half) l *= 0.7;
  compare(gathered(*psf, DiscField(kBackground, discs), &spots, kRow, 3), *psf, discs, half, twice);
  RecordProperty("told", told(with, without));
  EXPECT_GE(with.inside, 0.93 * with.pixels);
  EXPECT_LT(with.worst, 0.2);
  EXPECT_LT(twice.inside, 0.2 * twice.pixels);
  EXPECT_LT(without.inside, 0.2 * without.pixels);
}

// Of a disc of which a screen hides the left half, and of one behind it, only what is seen comes.
TEST(WingSpots, WhatIsHiddenSendsNothing) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.02, 20e-6});
  const std::vector<Disc> discs{{48.3, 20.3, 0.2, 1e5}, {47.6, 20.8, 0.1, 1e5}};
  const WingSpots spots = spots_about(discs);
  const sampling::TileResult tile = gathered(*psf, DiscField(kBackground, discs, 48.3), &spots, kRow, 5);
  Fit half, whole;
  // Its centroid is that of a half disc.
  const double r = discs[0].radius;
  const std::vector<Disc> seen{{48.3 + 4.0 * r / (3.0 * std::numbers::pi), 20.3, r, 1e5}};
  compare(tile, *psf, seen, {0.5 * over_background(discs[0])}, half);
  compare(tile, *psf, seen, {over_background(discs[0])}, whole);
  RecordProperty("told", told(half, whole));
  EXPECT_GE(half.inside, 0.93 * half.pixels);
  EXPECT_LT(half.worst, 0.2);
  EXPECT_LT(whole.inside, 0.2 * whole.pixels);
}

// What is no larger than a box and no brighter than what is about it changes nothing beyond rounding.
TEST(WingSpots, AnEvenFieldStaysExact) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.02, 20e-6});
  const WingSpots spots =
      spots_about({{26.0, 20.5, 0.2, 1.0}, {50.0, 20.5, 0.2, 1.0}, {150.0, 9.0, 0.1, 1.0}});
  const sampling::TileResult tile = gathered(*psf, DiscField(kBackground, {}), &spots, kRow, 5);
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    EXPECT_NEAR(tile.mean[p], kBackground, 1e-6);
    EXPECT_NEAR(tile.half_width[p], 0.0, 1e-6);
  }
}

TEST(WingSpots, DoNotDependOnTheTiling) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.02, 20e-6});
  const std::vector<Disc> discs{{26.3, 20.3, 0.03, 1e6}, {9.1, 3.2, 0.02, 1e6}};
  const WingSpots spots = spots_about(discs);
  const DiscField field(kBackground, discs);
  const sampling::TileResult all = gathered(*psf, field, &spots, {0, 0, 40, 24}, 5),
                             part = gathered(*psf, field, &spots, {16, 4, 24, 8}, 5);
  for (int y = 4; y < 8; ++y)
    for (int x = 16; x < 24; ++x) {
      const std::size_t of_part = static_cast<std::size_t>((y - 4) * 8 + x - 16),
                        of_all = static_cast<std::size_t>(y * 40 + x);
      EXPECT_EQ(part.mean[of_part], all.mean[of_all]);
      EXPECT_EQ(part.half_width[of_part], all.half_width[of_all]);
    }
}

}  // namespace
}  // namespace ifov::render::test_wing_spots
