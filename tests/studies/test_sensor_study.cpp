// What the study of sensors measures, small: each with a planted fault beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/sensor/channel_scenes.h"
#include "studies/sensor/modulation_scenes.h"
#include "studies/sensor/moving_scenes.h"
#include "studies/sensor/scanning_images.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"
#include "studies/study_folder.h"

namespace ifov::studies::test_sensor_study {
namespace {

/// An edge 5 degrees aslant that a Gaussian alone has blurred.
SensorImage blurred_edge(double sigma_px) {
  constexpr int kPixels = 96;
  SensorImage image{kPixels, kPixels, {}, {}, 0};
  const double angle = kEdgeAngle_deg * std::numbers::pi / 180.0;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) {
      const double across = (x - 0.5 * kPixels) * std::cos(angle) + (y - 0.5 * kPixels) * std::sin(angle);
      image.radiance.push_back(0.5 * std::erfc(-across / (sigma_px * std::sqrt(2.0))));
    }
  return image;
}

TEST(SensorStudy, ASlantedEdgeShowsTheModulationThatBlurredIt) {
  const auto gaussian = [](double sigma_px) {
    return [=](double v) { return std::exp(-2.0 * std::pow(std::numbers::pi * sigma_px * v, 2)); };
  };
  for (const double sigma_px : {0.4, 0.6}) {
    const EdgeResponse found = edge_response(blurred_edge(sigma_px));
    EXPECT_LT(edge_difference(found, gaussian(sigma_px)), 2e-3) << sigma_px;
    EXPECT_GT(edge_difference(found, gaussian(1.05 * sigma_px)), 0.01) << sigma_px;
    // As the standard has it, the bins are left in.
    const EdgeResponse standard = edge_response(blurred_edge(sigma_px), {1, false, false});
    EXPECT_NEAR(standard.at(0.4) / found.at(0.4), std::sin(0.1 * std::numbers::pi) / (0.1 * std::numbers::pi),
                1e-3);
  }
}

TEST(SensorStudy, RenderedEdgesAreTheProductOfTheirParts) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_edges");
  const EdgeOptics gaussian{0.5, 0.0}, all{0.3, 0.5, 0.4, 0.2, 0.02};
  EXPECT_LT(edge_difference(still_edge({}, options, 96), [](double v) { return still_modulation({}, v); }),
            0.005);
  const EdgeResponse blurred = still_edge(gaussian, options, 96);
  EXPECT_LT(edge_difference(blurred, [&](double v) { return still_modulation(gaussian, v); }), 0.003);
  EXPECT_GT(edge_difference(blurred, [](double v) { return still_modulation({0.52, 0.0}, v); }), 0.01);
  const EdgeResponse product = still_edge(all, options, 96);
  EXPECT_LT(edge_difference(product, [&](double v) { return still_modulation(all, v); }), 0.01);
  for (const EdgeOptics& other : {EdgeOptics{0.0, 0.5, 0.4, 0.2, 0.02}, EdgeOptics{0.3, 0.5, 0.0, 0.2, 0.02},
                                  EdgeOptics{0.3, 0.5, 0.4, 0.0, 0.02}, EdgeOptics{0.3, 0.5, 0.4, 0.2, 0.0}})
    EXPECT_GT(edge_difference(product, [&](double v) { return still_modulation(other, v); }), 0.02);
  const EdgeResponse stages = scanned_edge(1.0, 16, 0.02, options, 96);
  EXPECT_LT(edge_difference(stages, [](double v) { return scanned_modulation(1.0, 16, 0.02, v); }), 0.005);
  EXPECT_GT(edge_difference(stages, [](double v) { return scanned_modulation(1.0, 16, 0.04, v); }), 0.02);
}

TEST(SensorStudy, APointLeaksIntoPixelsAround) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_points");
  const PointShares shares = point_shares({0.8, 0.0}, 0.3, -0.2, options);
  EXPECT_LT(shares.largest, 0.005);
  double sum = 0.0;
  for (const double share : shares.found) sum += share;
  EXPECT_NEAR(sum, 1.0, 0.01);
  // Planted fault: as if it fell into its pixel alone.
  EXPECT_GT(1.0 - *std::max_element(shares.found.begin(), shares.found.end()), 0.5);
}

TEST(SensorStudy, ChannelsHaveTheDiffractionOfTheirWavelengths) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_channels");
  EXPECT_NEAR(channel_edges({1.2, 0.25, false}, options, 384).ratio(), 2.2 / 0.45, 0.01 * 2.2 / 0.45);
  EXPECT_NEAR(channel_edges({1.2, 0.25, true}, options, 192).ratio(), 1.0, 0.01);  // planted fault
  // The last stands on a corner that four pixels share.
  for (const auto& [x, y] : {std::pair{0.3, -0.2}, {0.0, 0.0}, {0.5, 0.5}}) {
    for (const double off : channel_points_off({0.1, 1.0, false}, x, y, options)) EXPECT_LT(off, 0.005);
    EXPECT_GT(channel_points_off({0.1, 1.0, true}, x, y, options).back(), 0.02);
  }
}

TEST(SensorStudy, PixelsLookWhereTheyAreTold) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_places");
  EXPECT_LT(frames_there_and_back_m(), 1e-3);
  EXPECT_LT(rays_from_orbit_m(options), 0.01);
  EXPECT_GT(rays_from_orbit_m(options, 1e-3), 0.01);
  for (const bool rough : {false, true}) {
    const PlacesOff off = places_off(rough, options);
    EXPECT_LT(off.image_px, 0.01);
    EXPECT_LT(off.ground_m, 1e-4);
    EXPECT_GT(places_off(rough, options, 2e-4).image_px, 0.01);  // a fiftieth of a line late
  }
}

TEST(SensorStudy, ScannedDiscsAreWhereGeometryPutsThem) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_scans");
  ScannerFlight flight;
  flight.roll_rad = 1e-3, flight.speed_m_s = 75.0;
  const SensorImage image = scan_discs(flight, options);
  EXPECT_GE(held_shares(image, discs_by_geometry(flight, 60)).edges, 0.93);
  flight.roll_rad = 1.02e-3;
  EXPECT_LT(held_shares(image, discs_by_geometry(flight, 60)).edges, 0.85);
}

TEST(SensorStudy, WhatMovesIsWhereKinematicsPutsIt) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_moving");
  for (const MovingCar& car : {MovingCar{}, MovingCar{0.0, 0.003, 20.0, 5.0}}) {
    EXPECT_LT(moving_car_off_px(car, options), 0.02);
    EXPECT_GT(moving_car_off_px(car, options, true), 0.2);
  }
}

TEST(SensorStudy, IntervalsHoldWhatMovesBeforeAMirror) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_yard");
  for (const bool rolling : {false, true}) {
    const MovingYard yard{rolling, true, 2, 16};
    const MovingTruth truth = moving_truth(yard, options);
    const MovingHeld held = moving_held(yard, truth, options);
    EXPECT_GT(held.share(), 0.93);
    EXPECT_GT(held.moving, 30u);
    EXPECT_GT(held.moving_share(), 0.93);
    if (!rolling) {  // planted: a thing that stands
      EXPECT_LT(moving_held({false, true, 1, 16}, truth, options, true).moving_share(), 0.6);
    }
  }
}

TEST(SensorStudy, WavefrontsAreThePupilsIntegral) {
  for (const int noll : {4, 8, 11}) EXPECT_LT(pupil_points_off(noll, 1.0), 0.01) << noll;
  EXPECT_GT(pupil_points_off(8, -1.0), 0.05);
  EXPECT_LT(memory_of_cube_gib(128, 30, in_a_folder("ifov_test_sensor_memory")), 2.0);
}

TEST(SensorStudy, NoiseAndPartsAreAsTheyWereToldToBe) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_noise");
  const NoisyPlane plane = noisy_plane(100, 0.05, options);
  const double within = 0.05 * 3.0 / std::sqrt(2.0 * static_cast<double>(plane.pixels));
  EXPECT_NEAR(plane.spread_k, 0.05, within);
  EXPECT_GT(std::abs(noisy_plane(100, 0.053, options).spread_k - 0.05), within);
  EXPECT_LE(parts_sum(options).worst, 1e-6);
  EXPECT_GT(parts_sum(options, 1.001).worst, 1e-6);
  EXPECT_TRUE(detect_cube(16, 5, 1, options).same_bytes);
}

TEST(SensorStudy, WhatIsNotThereIsNotMet) {
  const StudyOptions options = in_a_folder("ifov_test_sensor_nothing");
  const ReferenceData nothing("");
  for (const auto section : {orbit_section, bands_section, tirs_section, missing_section}) {
    const ReportSection found = section({nothing, options});
    for (const Figure& figure : found.figures.figures())
      EXPECT_TRUE(figure.name == "frames" || !figure.ok.has_value()) << figure.name;
  }
}

}  // namespace
}  // namespace ifov::studies::test_sensor_study
