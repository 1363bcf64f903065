// What a pixel says of why it ended above its limit.
#include <gtest/gtest.h>

#include <bit>

#include "accuracy_scenes.h"

namespace ifov::test::test_reasons {
namespace {

using sampling::bit;
using sampling::Reason;

/// Noise from 0 to 1 that no number of strata tames.
ShapeField noise() {
  return {[](double, double) { return sampling::Label{0}; },
          [](sampling::Label, double x, double y, int) {
            const auto key =
                sampling::mix(std::bit_cast<std::uint64_t>(x) ^ (std::bit_cast<std::uint64_t>(y) << 1));
            return static_cast<float>(sampling::unit_double(sampling::mix(key)));
          }};
}

TEST(AccuracyReasons, SamplesThatRanOutAreSaid) {
  for (const bool wide : {false, true}) {
    ShapeField field = noise();
    Rendering render = three_by_three(3);
    if (wide) render.footprint = gaussian(0.6, 2.0);
    render.half_width = 1e-3;  // asks for some 300,000 values
    render.options.max_samples_per_pixel = 3000;
    const sampling::TileResult r = render(field);
    for (std::size_t p = 0; p < r.reasons.size(); ++p)
      EXPECT_EQ(r.reasons[p], bit(Reason::samples)) << wide << ' ' << p;
  }
}

TEST(AccuracyReasons, AWidthThatMoreSamplesWouldNotLowerIsAnotherReason) {
  ShapeField field = disc_field(1.5, 1.5, 0.7);
  Rendering render = three_by_three(3);
  render.half_width = 1e-14;  // below what brackets are halved to
  const sampling::TileResult r = render(field);
  EXPECT_GT(r.half_width[4], 1e-14);
  EXPECT_LT(r.samples[4], render.options.max_samples_per_pixel / 4);
  EXPECT_EQ(r.reasons[4], bit(Reason::error));
}

// Specks between the points of the lattice, of which more tests are wanted than one round has: more of them may turn
// up, unless the pixel is sampled as clutter.
TEST(AccuracyReasons, WhatMayGoOnTurningUpIsSaid) {
  for (const bool clutter_switch : {false, true}) {
    ShapeField field = two_surfaces([](double x, double y) {
      const double dx = 12.0 * x - std::floor(12.0 * x) - 0.5, dy = 12.0 * y - std::floor(12.0 * y) - 0.5;
      return static_cast<sampling::Label>(std::hypot(dx, dy) < 0.36);
    });
    Rendering render = three_by_three(3);
    render.options.max_probe_rounds = 1;
    render.options.clutter_switch = clutter_switch;
    EXPECT_EQ((render(field).reasons[4] & bit(Reason::structure)) != 0, !clutter_switch) << clutter_switch;
  }
}

TEST(AccuracyReasons, NoneWhereTheLimitIsKept) {
  ShapeField field = noise();
  Rendering render = three_by_three(3);
  render.half_width = 0.05;
  const sampling::TileResult r = render(field);
  for (const auto reasons : r.reasons) EXPECT_EQ(reasons, 0);
}

}  // namespace
}  // namespace ifov::test::test_reasons
