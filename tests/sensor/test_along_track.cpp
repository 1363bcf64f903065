#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "platform/trajectory.h"
#include "sensor/along_track.h"
#include "sensor/psf.h"
#include "sensor/pushbroom_camera.h"

namespace ifov::sensor {
namespace {

using platform::Trajectory;

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

/// |Fourier transform| of what a footprint holds in rows, or in columns, of 2000 strips.
double modulation(const sampling::PixelFootprint& footprint, double cycles_px, bool along) {
  constexpr int kStrips = 2000;
  const double h = footprint.half_width_px(), width = 2.0 * h / kStrips;
  double re = 0.0, im = 0.0;
  for (int k = 0; k < kStrips; ++k) {
    const double a = -h + k * width, phase = 2.0 * std::numbers::pi * cycles_px * (a + 0.5 * width);
    const double share =
        along ? footprint.integral(-h, a, h, a + width) : footprint.integral(a, -h, a + width, h);
    re += share * std::cos(phase), im += share * std::sin(phase);
  }
  return std::hypot(re, im);
}

constexpr double kFrequencies[] = {0.05, 0.13, 0.25, 0.37, 0.5};

TEST(AlongTrack, ModulatesAsAProductOfSincs) {
  for (const auto& [exposure, element] :
       {std::pair{1.0, 1.0}, {0.3, 1.0}, {1.0, 0.7}, {0.25, 2.3}, {0.5, 0.0}}) {
    const AlongTrack along{exposure, element};
    const auto footprint = make_footprint(nullptr, 1.0, along);
    EXPECT_NEAR(footprint.integral(-9.0, -9.0, 9.0, 9.0), 1.0, 1e-12);
    for (const double v : kFrequencies) {
      const double expected = std::abs(sinc(exposure * v) * sinc(element * v));
      EXPECT_NEAR(modulation(footprint, v, true), expected, 1e-5) << exposure << " " << element << " " << v;
      EXPECT_NEAR(along.mtf(v), expected, 1e-12);
      EXPECT_NEAR(modulation(footprint, v, false), std::abs(sinc(v)), 1e-3);
    }
  }
}

/// 16 stages whose charge is 2 % too slow: as motion over 0.32 lines, which is what their comb is for frequencies that lines hold.
TEST(AlongTrack, ModulatesAsMismatchOfStagesDoes) {
  const auto looks = [](double mismatch) { return make_footprint(nullptr, 1.0, {1.0, 1.0, 16, mismatch}); };
  for (const double v : kFrequencies) {
    const double expected = std::abs(sinc(v) * sinc(v) * sinc(16 * 0.02 * v));
    EXPECT_NEAR(modulation(looks(0.02), v, true), expected, 0.01) << v;
    EXPECT_NEAR(modulation(looks(0.0), v, true), std::abs(sinc(v) * sinc(v)), 1e-5) << v;
    double re = 0.0;
    for (int s = 0; s < 16; ++s) re += std::cos(2.0 * std::numbers::pi * v * 0.02 * (s - 7.5)) / 16.0;
    EXPECT_NEAR(modulation(looks(0.02), v, true), std::abs(sinc(v) * sinc(v) * re), 1e-5) << v;
  }
  EXPECT_GT(std::abs(modulation(looks(0.04), 0.37, true) -
                     std::abs(sinc(0.37) * sinc(0.37) * sinc(16 * 0.02 * 0.37))),
            0.02)
      << "4 % are noticed";
}

TEST(AlongTrack, GoesWithThePsf) {
  const auto psf = make_gaussian_psf(0.4);
  const auto footprint = make_footprint(psf.get(), 0.64, {0.5, 1.2});
  for (const double v : kFrequencies) {
    const double gaussian = std::exp(-2.0 * std::pow(std::numbers::pi * 0.4 * v, 2));
    EXPECT_NEAR(modulation(footprint, v, true), std::abs(gaussian * sinc(0.5 * v) * sinc(1.2 * v)), 2e-3)
        << v;
    EXPECT_NEAR(modulation(footprint, v, false), std::abs(gaussian * sinc(0.8 * v)), 2e-3) << v;
  }
}

TEST(AlongTrack, OfASquareIsASquare) {
  EXPECT_TRUE(make_footprint(nullptr, 1.0, AlongTrack{}).whole_pixel());
  EXPECT_TRUE(AlongTrack{}.plain());
  const auto half = make_footprint(nullptr, 1.0, {0.5, 0.0});
  EXPECT_EQ(half.density(0.2, 0.2), 2.0);
  EXPECT_EQ(half.density(0.2, 0.3), 0.0);
  EXPECT_NEAR(half.integral(-0.5, 0.0, 0.0, 0.5), 0.25, 1e-15);
  EXPECT_THROW(make_footprint(nullptr, 16.1, {0.5, 0.0}), InputError);
  // Elements of a line that overlap do so across, and see a line no longer than its period.
  const auto wide = make_footprint(nullptr, 2.25, {.timed = true});
  EXPECT_NEAR(wide.integral(-0.75, -0.5, 0.75, 0.5), 1.0, 1e-15);
  EXPECT_NEAR(wide.density(0.7, 0.45), 1.0 / 1.5, 1e-15);
  EXPECT_EQ(wide.density(0.7, 0.55), 0.0);
}

/// 1 m across at 1000 m, half a metre a line, to the north.
PushbroomCamera::Settings flight(double element_px, int stages, const Trajectory& path) {
  PushbroomCamera::Settings settings{40, 40, 1e-3, 0.0, 0.0, 0.01, std::make_shared<const Trajectory>(path)};
  settings.element_px = element_px, settings.stages = stages;
  return settings;
}
Trajectory straight() { return Trajectory::straight({0.0, 0.0, 1000.0}, {0.0, 50.0, 0.0}, {}); }

/// Rolls by `roll_rad` each 0.8 s and once back.
Trajectory rolling(double roll_rad) {
  std::vector<platform::PathPoint> path;
  std::vector<platform::Quaternion> attitudes;
  for (int k = -100; k <= 200; ++k) {
    const double t = 0.01 * k;
    path.push_back({t, {0.0, 50.0 * t, 1000.0}});
    attitudes.push_back(platform::quaternion_of(
        geodesy::enu_from_body({0.0, 0.0, roll_rad * std::sin(2.0 * std::numbers::pi * t / 0.8)})));
  }
  return {path, attitudes};
}

std::string refusal(const PushbroomCamera::Settings& settings) {
  try {
    const PushbroomCamera camera(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(PushbroomElements, AreAsLongAsTheGroundSays) {
  const AlongTrack along = PushbroomCamera(flight(0.8, 1, straight())).along_track();
  EXPECT_NEAR(along.element_px, 1.6, 1e-9) << "0.8 m in lines of half a metre";
  EXPECT_EQ(along.exposure_px, 1.0);
  EXPECT_TRUE(PushbroomCamera(flight(0.0, 1, straight())).along_track().plain());
  PushbroomCamera::Settings brief = flight(0.0, 1, straight());
  brief.exposure_s = 0.0025;
  EXPECT_NEAR(PushbroomCamera(brief).along_track().exposure_px, 0.25, 1e-12);
  // Ground at 500 m is half as far away: an element is half as long there, and in between in the image. The stages move with 1.02 m.
  PushbroomCamera::Settings stages =
      flight(1.0, 16, Trajectory::straight({0.0, 0.0, 500.0}, {0.0, 51.0, 0.0}, {}));
  EXPECT_NEAR(PushbroomCamera(stages).along_track().stage_px, 1.0 - 0.5 / 0.51, 1e-9);
}

TEST(PushbroomElements, AreRefusedWhereTheyCannotBeKnown) {
  // 0.06 mrad of roll are 0.06 * 2 pi / 0.8 s: 0.0094 pixels while it moves on by a pitch of 1 m.
  EXPECT_EQ(refusal(flight(1.0, 1, rolling(6e-5))), "taken");
  EXPECT_EQ(refusal(flight(0.0, 1, rolling(1e-2))), "taken");
  const std::string rolls = refusal(flight(1.0, 1, rolling(1e-3)));
  EXPECT_EQ(
      rolls,
      "what elements 1 pitches long, all stages together, see is 0.079 pixels off from what is known of their lines: at 0.004938 s the "
      "platform rolls or yaws by 0.157 pixels while it moves on by a pitch; expected 0.005 pixels at most, which 0.064 pitches have: a "
      "shorter 'element_length', fewer 'stages', or neither");
  EXPECT_EQ(refusal(flight(0.06, 1, rolling(1e-3))), "taken");
  PushbroomCamera::Settings hilly = flight(1.0, 1, straight());
  hilly.highest_m = 60.0;
  EXPECT_EQ(
      refusal(hilly),
      "what elements 1 pitches long, all stages together, see is 0.03 pixels off from what is known of their lines: it moves on by a "
      "pitch in 1.88 to 2 lines, as it turns and between 0 and 60 m of height; expected 0.005 pixels at most, which 0.17 pitches have: a "
      "shorter 'element_length', fewer 'stages', or neither");
}

TEST(PushbroomElements, StagesNeedMoreOfThePath) {
  PushbroomCamera::Settings settings = flight(1.0, 11, rolling(0.0));
  settings.start_s = -1.0;
  EXPECT_EQ(
      refusal(settings),
      "the platform's path covers -1 to 2 s, and the 40 lines are exposed from -1.05 to -0.55 s: it begins 0.05 s too late");
  PushbroomCamera::Settings slow = flight(1.0, 1, straight());
  slow.exposure_s = 0.02;
  EXPECT_EQ(refusal(slow), "an exposure of 0.02 s in a line period of 0.01 s; expected at most the period");
}

}  // namespace
}  // namespace ifov::sensor
