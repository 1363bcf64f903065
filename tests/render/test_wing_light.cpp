// An edge through an Airy pattern, against the response of a diffraction-limited pixel to a half plane in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "render/wings/cut_room.h"
#include "render/wings/wing_light.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sensor/airy_aperture.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"

namespace ifov::render::test_wing_light {
namespace {

CutRange nothing_about(int columns) {
  const auto n = static_cast<std::size_t>(columns);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::vector<double>(n, kInfinity), std::vector<double>(n, -kInfinity)};
}

constexpr double kPi = std::numbers::pi;

/// Bright on one side of a straight edge through (x0, y0), at `angle` from the image's y axis.
class EdgeField final : public sampling::Field {
 public:
  EdgeField(double dark, double bright, double x0_px, double y0_px, double angle_rad)
      : dark_(dark),
        bright_(bright),
        x0_(x0_px),
        y0_(y0_px),
        cosine_(std::cos(angle_rad)),
        sine_(std::sin(angle_rad)) {}
  int columns() const override { return 1; }
  double distance(double x_px, double y_px) const { return (x_px - x0_) * cosine_ + (y_px - y0_) * sine_; }
  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k)
      labels[k] = distance(points[k].x_px, points[k].y_px) > 0.0;
    counts_.primary += points.size();
  }
  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = distance(requests[k].point.x_px, requests[k].point.y_px) > 0.0;
      values[k * static_cast<std::size_t>(stride())] = static_cast<float>(labels[k] != 0 ? bright_ : dark_);
    }
    counts_.primary += requests.size();
  }
  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label);
  }
  sampling::RayCounts counts() const override { return counts_; }

 private:
  double dark_, bright_, x0_, y0_, cosine_, sine_;
  sampling::RayCounts counts_;
};

class Percent final : public sampling::Tolerance {
 public:
  explicit Percent(double share) : share_(share) {}
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    limit[0] = share_ * std::abs(mean[0]) + 1e-9;
  }
  double confidence() const override { return 0.95; }

 private:
  double share_;
};

double sinc(double t) { return std::abs(t) < 1e-9 ? 1.0 : std::sin(kPi * t) / (kPi * t); }

/// Share of the response of a whole pixel behind an aperture that lies on one side of an edge at a signed distance:
/// 1/2 + integral of MTF(nu) sin(2 pi nu d) / (pi nu) over the frequencies across the edge (Goodman 2005, 6.4).
double response(double distance_px, double q_px, double angle_rad) {
  constexpr int kSteps = 1200;
  const double cutoff = 1.0 / q_px;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double nu = (k + 0.5) / kSteps * cutoff, s = q_px * nu;
    const double optics = 2.0 / kPi * (std::acos(s) - s * std::sqrt(1.0 - s * s));
    sum += optics * sinc(nu * std::cos(angle_rad)) * sinc(nu * std::sin(angle_rad)) *
           std::sin(2.0 * kPi * nu * distance_px) / (kPi * nu) * cutoff / kSteps;
  }
  return 0.5 + sum;
}

struct Edge {
  std::vector<double> distance, error, half_width, truth;
  /// What of the modulation at a frequency across the edge the errors make: the transform of the derivative of the
  /// response's error, its mean over the rows.
  double modulation_error(double frequency, int rows, double cosine) const {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < error.size(); ++k)
      sum += error[k] * 2.0 * kPi * frequency * std::polar(1.0, -2.0 * kPi * frequency * distance[k]);
    return std::abs(sum) * cosine / rows;
  }
};

constexpr double kAngle = 5.0 * kPi / 180.0, kDark = 0.05, kBright = 0.5;
constexpr int kSide = 40;

/// Errors are in units of the step, the rest in those of the picture.
Edge picture(double q_px, double tolerance, bool with_wings, std::uint64_t seed) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.04 * q_px, 20e-6});
  const sampling::PixelFootprint footprint = sensor::make_footprint(psf.get(), 1.0);
  const sensor::PsfWings wings(*psf, 1.0);
  EdgeField field(kDark, kBright, 0.5 * kSide + 0.13, 0.5 * kSide, kAngle);
  const Percent limits(0.9 * tolerance);
  const int steering_channels[] = {0};
  sampling::TileProblem problem;
  problem.tile = problem.image = {0, 0, kSide, kSide};
  problem.seed = seed;
  problem.footprint = &footprint;
  problem.tolerance = &limits;
  problem.steering_channels = steering_channels;
  sampling::TileResult tile;
  sampling::AccuracySampler().sample(problem, field, tile);
  if (with_wings)
    add_wings(std::vector<const sensor::PsfWings*>{&wings}, problem, nullptr, nullptr, field, tile);
  tile.join_bounds(joint_of(nullptr));
  Edge edge;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const std::size_t p = static_cast<std::size_t>(y * kSide + x);
      const double d = field.distance(x + 0.5, y + 0.5);
      const double truth = kDark + (kBright - kDark) * response(d, q_px, kAngle);
      edge.distance.push_back(d);
      edge.truth.push_back(truth);
      edge.error.push_back((tile.mean[p] - truth) / (kBright - kDark));
      edge.half_width.push_back(tile.half_width[p]);
    }
  return edge;
}

TEST(WingLight, ModulationAtASlantedEdgeIsThatOfTheAperture) {
  for (const double q : {0.5, 1.0}) {
    const Edge whole = picture(q, 0.01, true, 1), cut = picture(q, 0.01, false, 1);
    double worst = 0.0, worst_cut = 0.0;
    for (double f = 0.02; f < 0.6; f += 0.02) {
      worst = std::max(worst, whole.modulation_error(f, kSide, std::cos(kAngle)));
      worst_cut = std::max(worst_cut, cut.modulation_error(f, kSide, std::cos(kAngle)));
    }
    RecordProperty(q < 1.0 ? "worst_half" : "worst_one",
                   std::to_string(worst) + " cut " + std::to_string(worst_cut));
    EXPECT_LT(worst, 0.01) << q;
    EXPECT_GT(worst_cut, 0.02) << q;  // the planted fault: 95 % of the energy and no wings
  }
}

TEST(WingLight, PixelsBesideAnEdgeAreWithinTheirIntervals) {
  for (const double q : {0.5, 1.0}) {
    int pixels = 0, inside = 0, inside_cut = 0, narrow = 0;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Edge whole = picture(q, 0.01, true, seed), cut = picture(q, 0.01, false, seed);
      for (std::size_t p = 0; p < whole.error.size(); ++p) {
        if (whole.distance[p] > -0.7 || whole.distance[p] < -6.0) continue;  // the dark side
        ++pixels;
        const double step = kBright - kDark;
        inside += std::abs(whole.error[p]) * step <= whole.half_width[p];
        inside_cut += std::abs(cut.error[p]) * step <= cut.half_width[p];
        narrow += whole.half_width[p] <= 0.01 * whole.truth[p];
      }
    }
    RecordProperty(q < 1.0 ? "half" : "one", std::to_string(inside) + " narrow " + std::to_string(narrow) +
                                                 " cut " + std::to_string(inside_cut) + " of " +
                                                 std::to_string(pixels));
    EXPECT_GE(inside, 0.93 * pixels) << q;
    EXPECT_GE(narrow, 0.95 * pixels) << q;
    EXPECT_LT(inside_cut, 0.2 * pixels) << q;
  }
}

TEST(WingLight, AnEvenFieldStaysExact) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.04, 20e-6});
  const sensor::PsfWings wings(*psf, 0.8);
  EdgeField field(0.3, 0.3, 0.0, 0.0, 0.0);
  sampling::TileProblem problem;
  problem.tile = problem.image = {16, 32, 22, 37};
  sampling::TileResult tile;
  tile.reset(problem.tile, 1);
  std::fill(tile.mean.begin(), tile.mean.end(), 0.3f);
  tile.reasons.assign(tile.reasons.size(), 0);
  for (std::uint32_t p = 0; p < 30; ++p) tile.abundances.push_back({p, 0, 1.0f, 0.0f});
  add_wings(std::vector<const sensor::PsfWings*>{&wings}, problem, nullptr, nullptr, field, tile);
  tile.join_bounds(joint_of(nullptr));
  for (std::size_t p = 0; p < 30; ++p) {
    EXPECT_NEAR(tile.mean[p], 0.3, 1e-6);
    EXPECT_NEAR(tile.half_width[p], 0.0, 1e-6);
    EXPECT_EQ(tile.samples[p], 4u);
  }
  double fraction = 0.0;
  for (const sampling::Abundance& a : tile.abundances) fraction += a.fraction;
  EXPECT_NEAR(fraction / 30.0, 1.0, 2e-3);  // what lies beyond the wings is of no known material
}

TEST(WingLight, DoesNotDependOnTheTiling) {
  const auto psf = sensor::make_airy_psf({10.0, 0.02, 0.02, 20e-6});
  const sensor::PsfWings wings(*psf, 1.0);
  const auto light = [&](sampling::PixelRect rect) {
    EdgeField field(0.1, 0.9, 11.3, 5.0, 0.2);
    sampling::TileProblem problem;
    problem.tile = rect;
    problem.image = {0, 0, 64, 64};
    problem.seed = 7;
    sampling::TileResult tile;
    tile.reset(rect, 1);
    add_wings(std::vector<const sensor::PsfWings*>{&wings}, problem, nullptr, nullptr, field, tile);
    return tile;
  };
  const sampling::TileResult all = light({0, 0, 16, 16}), part = light({8, 4, 12, 8});
  for (int y = 4; y < 8; ++y)
    for (int x = 8; x < 12; ++x)
      EXPECT_NEAR(part.mean[static_cast<std::size_t>((y - 4) * 4 + x - 8)],
                  all.mean[static_cast<std::size_t>(y * 16 + x)], 1e-6);
}

TEST(WingLight, ACutWithoutWingsIsInTheIntervalByTheContrast) {
  sampling::TileResult tile;
  tile.reset({0, 0, 3, 1}, 1);
  tile.mean = {1.0f, 1.0f, 101.0f};
  tile.reasons.assign(3, 0);
  widen_by_cut(std::vector<double>(static_cast<std::size_t>(tile.columns), 1e-3), nothing_about(tile.columns),
               nullptr, nullptr, tile);
  tile.join_bounds(joint_of(nullptr));
  EXPECT_NEAR(tile.half_width[0], 0.1, 1e-6);
  EXPECT_NEAR(tile.half_width[2], 0.1, 1e-6);
  tile.mean = {5.0f, 5.0f, 5.0f};
  tile.half_width = {0.0f, 0.0f, 0.0f};
  widen_by_cut(std::vector<double>(static_cast<std::size_t>(tile.columns), 1e-3), nothing_about(tile.columns),
               nullptr, nullptr, tile);
  tile.join_bounds(joint_of(nullptr));
  EXPECT_EQ(tile.half_width[1], 0.0f);
}

// The same step is too much for the dark pixel, of which a percent is asked, and not for the bright one.
TEST(WingLight, WhatACutMakesTooWideSaysSo) {
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("red", 0.6)};
  const auto nodes = radiometry::SpectralNodes::build(channels, radiometry::Spectrum(), {});
  const ChannelBrightness brightness(nodes);
  const AccuracyTolerance percent({}, brightness, {0.0}, 2);
  sampling::TileResult tile;
  tile.reset({0, 0, 2, 1}, 1);
  tile.mean = {1.0f, 101.0f};
  tile.reasons.assign(2, 0);
  widen_by_cut(std::vector<double>(static_cast<std::size_t>(tile.columns), 1e-3), nothing_about(tile.columns),
               nullptr, &percent, tile);
  EXPECT_NEAR(tile.worst_ratio[0], 0.1 / 0.01, 1e-4);
  EXPECT_NEAR(tile.worst_ratio[1], 0.1 / 1.01, 1e-6);
  EXPECT_EQ(tile.reasons[0], sampling::bit(sampling::Reason::psf_cut));
  EXPECT_EQ(tile.reasons[1], 0);
}

// A pixel of the darker side that is as wide as it may be is within what was asked for when the cut is in.
TEST(WingLight, ThereIsRoomForWhatACutLeavesOut) {
  const std::vector<radiometry::Channel> channels{radiometry::Channel::monochromatic("red", 0.6)};
  const auto nodes = radiometry::SpectralNodes::build(channels, radiometry::Spectrum(), {});
  const ChannelBrightness brightness(nodes);
  const AccuracyTolerance percent({}, brightness, {0.0}, 2);
  EdgeField field(0.1, 0.9, 11.3, 5.0, 0.0);
  sampling::TileProblem problem;
  problem.tile = problem.image = {0, 0, 16, 16};
  const std::vector<double> left_out(1, 5e-4), dark(1, 0.1);
  const CutRange about = cut_range(problem, 0.0, field);
  const CutRoom room(percent, left_out, about);
  std::vector<double> limit(1), asked(1);
  room.limits(dark, limit);
  percent.asked(dark, asked);
  EXPECT_LT(limit[0], 0.9 * asked[0]);
  sampling::TileResult tile;
  tile.reset({0, 0, 2, 1}, 1);
  tile.mean = {0.1f, 0.9f};
  tile.reasons.assign(2, 0);
  for (const bool with_room : {true, false}) {
    tile.half_width[0] = static_cast<float>(with_room ? limit[0] : asked[0]);
    tile.bound.assign(2, 0.0f);
    widen_by_cut(left_out, about, nullptr, &percent, tile);
    EXPECT_EQ(tile.worst_ratio[0] <= 1.0f, with_room);
  }
}

}  // namespace
}  // namespace ifov::render::test_wing_light
