// Tiny hot targets far beside a pixel, against the density of the PSF beyond its cut, integrated over the pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

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
  return tile;
}

/// Of the light of a point, what falls on a whole pixel from beyond the cut.
double share(const sensor::Psf& psf, double dx, double dy) {
  constexpr int kSteps = 48;
  double sum = 0.0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i)
      sum += psf.cut_density(dx + (i + 0.5) / kSteps - 0.5, dy + (j + 0.5) / kSteps - 0.5, false);
  return sum / (kSteps * kSteps);
}

struct Fit {
  int pixels = 0, inside = 0;
  double worst = 0.0;   ///< error over the truth
  double widest = 0.0;  ///< half-width over the truth
};

/// What discs add to pixels of a row, against `truth(x)`.
template <class Truth>
void compare(const sampling::TileResult& tile, const Truth& truth, Fit& fit) {
  for (int x = tile.tile.x0; x < tile.tile.x1; ++x) {
    const double expected = truth(x);
    if (!(expected > 0.0)) continue;
    const std::size_t p = static_cast<std::size_t>(x - tile.tile.x0);
    const double error = std::abs(tile.mean[p] - kBackground - expected);
    ++fit.pixels;
    fit.inside += error <= tile.half_width[p];
    fit.worst = std::max(fit.worst, error / expected);
    fit.widest = std::max(fit.widest, tile.half_width[p] / expected);
  }
}

constexpr sampling::PixelRect kRow{8, 20, 44, 21};

class WingSpotsOfApertures : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(WingSpotsOfApertures, ATinyHotTargetSendsWhatThePsfSays) {
  const auto [q, covered] = GetParam();
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.04 * q, 20e-6, covered});
  Fit with, without;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double part = static_cast<double>(seed) / 9.0;
    const std::vector<Disc> discs{{48.1 + part, 20.9 - part, 0.04 * part + 0.002, 1.0 / (part * part) * 3e6}};
    const WingSpots spots = spots_about(discs);
    const auto truth = [&](int x) {
      return share(*psf, discs[0].x - (x + 0.5), discs[0].y - 20.5) *
             (discs[0].light() - kBackground * discs[0].light() / discs[0].value);
    };
    compare(gathered(*psf, DiscField(kBackground, discs), &spots, kRow, seed), truth, with);
    compare(gathered(*psf, DiscField(kBackground, discs), nullptr, kRow, seed), truth, without);
  }
  RecordProperty("worst", std::to_string(with.worst) + " widest " + std::to_string(with.widest) + " inside " +
                              std::to_string(with.inside) + " of " + std::to_string(with.pixels) +
                              " without " + std::to_string(without.inside));
  EXPECT_GE(with.inside, 0.93 * with.pixels);
  EXPECT_LT(with.worst, 0.3);
  EXPECT_LT(with.widest, 0.6);
  EXPECT_LT(without.inside, 0.2 * without.pixels);  // the planted fault: cells alone
}

INSTANTIATE_TEST_SUITE_P(Airy, WingSpotsOfApertures,
                         ::testing::Values(std::pair{0.5, 0.0}, std::pair{0.5, 0.35}, std::pair{1.0, 0.0},
                                           std::pair{1.0, 0.35}, std::pair{2.0, 0.0}, std::pair{2.0, 0.5}));

}  // namespace
}  // namespace ifov::render::test_wing_spots
