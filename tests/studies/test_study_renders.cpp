#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "io/document/document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "sampling/hash.h"
#include "sampling/random.h"
#include "studies/clutter_scene.h"
#include "studies/clutter_trials.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/common/study_rendering.h"
#include "studies/sampling_sweep.h"
#include "studies/studies.h"
#include "studies/suburb/image_curves.h"
#include "studies/suburb/radiance_errors.h"
#include "studies/suburb/suburb_study.h"

namespace ifov::studies::test_study_renders {
namespace {

const std::filesystem::path kFolder = std::filesystem::temp_directory_path();

/// The studies' figures, for fewer trials: from a document through the ray tracer and the samplers.
StudyOptions few(int trials) {
  StudyOptions options;
  options.trials = trials;
  options.threads = 2;
  options.output_folder = kFolder;
  return options;
}

TEST(StudyRenders, GridOfThePaper) {
  const ThermalScene dome = dome_scene(paper_dome());
  const ThermalTrial n40 = render_thermal(dome, grid_sampling(40), 1, kFolder, nullptr);
  const ThermalTrial n42 = render_thermal(dome, grid_sampling(42), 1, kFolder, nullptr);
  EXPECT_EQ(n42.cost.samples, 15876u);
  EXPECT_EQ(n42.cost.rays.primary, 15876u);
  EXPECT_NEAR(std::abs(n40.error_c), 0.149, 0.0005);
  EXPECT_NEAR(std::abs(n42.error_c), 0.022, 0.001);
}

TEST(StudyRenders, AdaptiveOfThePaper) {
  const ThermalTrial n20 = render_thermal(dome_scene(paper_dome()), paper_adaptive(20), 1, kFolder, nullptr);
  EXPECT_EQ(n20.cost.samples, 1119u);
  EXPECT_NEAR(std::abs(n20.error_c), 0.149, 0.0005);
}

TEST(StudyRenders, AdaptiveHoldsATenthInThreeQuartersOfShifts) {
  const TextureMap none(1, 1.0);
  StudyProgress progress(0, nullptr);
  const TrialSummary dome =
      run_series({"dome", Family::dome, paper_adaptive(20)}, none, kFolder, few(100), progress);
  EXPECT_NEAR(dome.within(0.1), 0.77, 0.13);  // three standard errors of 100 shifts
}

TEST(StudyRenders, PathNoiseIsWhatPairsOfRaysDifferBy) {
  std::vector<float> one, other;
  for (int p = 0; p < 20000; ++p)
    for (int c = 0; c < 2; ++c) {
      const auto noisy = [&](int seed) {
        const double width = c == 0 ? 0.5 : 0.1;
        return static_cast<float>(3.0 *
                                  (1.0 + width * (sampling::unit_double(sampling::hash(p, c, seed)) - 0.5)));
      };
      one.push_back(noisy(1));
      other.push_back(noisy(2));
    }
  // Differences of two uniform numbers of width w stay within w (1 - sqrt(0.05)) in 95 %.
  EXPECT_NEAR(path_noise(one, other, 1, 2), 0.1 * (1.0 - std::sqrt(0.05)), 0.002);
}

TEST(StudyRenders, SamplesThatStayWithin) {
  std::vector<SweepPoint> sweep(4);
  const double errors[] = {0.05, -0.2, 0.09, -0.1};
  for (std::size_t k = 0; k < 4; ++k) {
    sweep[k].trial.error_c = errors[k];
    sweep[k].trial.cost.samples = 10 * (k + 1);
  }
  EXPECT_EQ(samples_that_stay_within(sweep, 0.1), 30.0);
  EXPECT_EQ(samples_that_stay_within(sweep, 0.2), 10.0);
  EXPECT_TRUE(std::isnan(samples_that_stay_within(sweep, 0.01)));
}

TEST(StudyRenders, AccuracyReachesWhatWasAsked) {
  const TextureMap none(1, 1.0);
  StudyProgress progress(0, nullptr);
  const TrialSummary dome = run_series({"dome", Family::dome, accuracy_sampling(radiance_of_error(0.1))},
                                       none, kFolder, few(100), progress);
  EXPECT_GE(dome.within(0.1), 0.95);
  EXPECT_LE(dome.mean_samples, 200.0);
  EXPECT_GE(dome.coverage, 0.9);
}

TEST(StudyRenders, SeedsFindSmallTargetsAndNothingElseDoes) {
  const TextureMap none(1, 1.0);
  StudyProgress progress(0, nullptr);
  const io::ErrorSize error = radiance_of_error(0.1);
  const TrialSummary seeded = run_series({"seeded", Family::small_target, accuracy_sampling(error)}, none,
                                         kFolder, few(60), progress);
  const TrialSummary unseeded =
      run_series({"unseeded", Family::small_target,
                  accuracy_sampling(error, [](io::AccuracySampling& a) { a.pilot_rays = false; })},
                 none, kFolder, few(60), progress);
  EXPECT_EQ(seeded.seen, 1.0);
  EXPECT_LT(unseeded.seen, 0.5);
}

TEST(StudyRenders, TexturedTruthIsWhatAFineGridSees) {
  const TextureMap texture(2, 8.0);
  const auto folder = kFolder / "ifov_textured";
  make_folder(folder);
  texture.write(folder, "ground", kCold_k);
  texture.write(folder, "target", kHot_k);
  const ThermalScene scene = random_scene(Family::textured_dome, 2, 0, texture);
  const ThermalTrial trial = render_thermal(scene, grid_sampling(200), 1, folder, nullptr);
  EXPECT_LT(std::abs(trial.error_c), 0.02);
  std::filesystem::remove_all(folder);
}

TEST(ClutterScene, CellsTileTheImage) {
  const ClutterScene scene(8, 1.5, 3);
  const std::vector<double> truth = scene.pixel_truth();
  for (double radiance : truth) {
    EXPECT_GT(radiance, cold_radiance() - 1e-9);
    EXPECT_LT(radiance, hot_radiance() + 1e-9);
  }
  ImageStore image;
  render_document(study_text(scene.document(grid_sampling(60), 0.0, 1)), kFolder, {2, nullptr, nullptr, {}},
                  image);
  double squares = 0.0;
  for (std::size_t p = 0; p < truth.size(); ++p)
    squares += std::pow(error_c(static_cast<double>(image.mean()[p]) - truth[p]), 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(truth.size())), 0.06);
}

TEST(ClutterScene, BlurredTruthIsWhatAFineGridSees) {
  const ClutterScene scene(8, 1.5, 3);
  const std::vector<double> truth = scene.blurred_truth(0.6, 24);
  ImageStore image;
  render_document(study_text(scene.document(grid_sampling(24), 0.6, 1)), kFolder, {2, nullptr, nullptr, {}},
                  image);
  for (int y = 3; y < 5; ++y)
    for (int x = 3; x < 5; ++x) {
      const std::size_t p = image.index(x, y);
      EXPECT_NEAR(error_c(static_cast<double>(image.mean()[p]) - truth[p]), 0.0, 0.06);
    }
}

TEST(ClutterScene, RaysAtAnRmsAreInterpolated) {
  const std::vector<ClutterResult> results = {{"a", 0.2, 1.0, 10.0, 0.0}, {"b", 0.05, 1.0, 40.0, 0.0}};
  EXPECT_NEAR(rays_at_rms(results, 0.1), 20.0, 1e-9);
  EXPECT_TRUE(std::isinf(rays_at_rms(results, 0.01)));
  EXPECT_EQ(rays_at_rms(results, 0.5), 10.0);
}

TEST(SuburbStudy, ErrorsAreOverThePixelsOfTheReference) {
  ImageStore image, reference;
  render::ImageInfo info;
  info.width_px = 3, info.height_px = 1;
  info.channels.resize(2);
  const auto fill = [&](ImageStore& store, std::vector<float> mean, float half_width,
                        std::vector<std::uint32_t> samples) {
    store.begin(info);
    sampling::TileResult tile;
    tile.reset({0, 0, 3, 1}, 2);
    tile.mean = std::move(mean);
    tile.half_width.assign(6, half_width);
    tile.variance_geometry.assign(6, 0.0f);
    tile.samples = std::move(samples);
    store.write(tile);
  };
  // The second pixel is not in the reference; the second channel has no error.
  fill(reference, {1, 2, 1, 2, 1, 2}, 0.0f, {1, 0, 1});
  fill(image, {1.3f, 2, 9, 9, 0.6f, 2}, 0.35f, {1, 1, 1});
  const RadianceErrors errors = radiance_errors(image, reference);
  EXPECT_NEAR(errors.rms[0], std::sqrt((0.09 + 0.16) / 2.0), 1e-7);
  EXPECT_EQ(errors.rms[1], 0.0);
  EXPECT_NEAR(errors.coverage, 0.75, 1e-12);
  EXPECT_NEAR(errors.mean[1], 2.0, 1e-12);
  // Where the other one errs by roundings alone a channel does not count.
  RadianceErrors other = errors;
  other.rms = {2.0 * errors.rms[0], 1e-9};
  const ErrorRatios ratios = error_ratios(errors, other);
  EXPECT_NEAR(ratios.mean, 0.5, 1e-12);
  EXPECT_NEAR(ratios.worst, 0.5, 1e-12);
  EXPECT_NEAR(error_quantile(image, reference, errors, 1.0), 0.4 / errors.rms[0], 1e-6);
}

TEST(SuburbStudy, TimeIsReadOnThePowerBetweenPoints) {
  const auto at = [](double error, double seconds) {
    CurvePoint point;
    point.mean_band.mean = error;
    point.seconds = seconds;
    return point;
  };
  // Time goes with the inverse square of the error: 8 s at 1, between the points and beyond them.
  EXPECT_NEAR(seconds_at_one({at(2.0, 2.0), at(0.5, 32.0)}, &CurvePoint::mean_band), 8.0, 1e-9);
  EXPECT_NEAR(seconds_at_one({at(4.0, 0.5), at(2.0, 2.0)}, &CurvePoint::mean_band), 8.0, 1e-9);
  EXPECT_NEAR(seconds_at_one({at(0.5, 32.0), at(0.25, 128.0)}, &CurvePoint::mean_band), 8.0, 1e-9);
  EXPECT_TRUE(std::isnan(seconds_at_one({at(0.5, 32.0)}, &CurvePoint::mean_band)));
}

TEST(Studies, AreFoundByName) {
  ASSERT_NE(find_study("thermal"), nullptr);
  ASSERT_NE(find_study("aliasing"), nullptr);
  EXPECT_EQ(find_study("thermic"), nullptr);
  ASSERT_NE(find_study("suburb"), nullptr);
  EXPECT_EQ(all_studies().size(), 7u);
}

TEST(Studies, AliasingWritesItsFiles) {
  StudyOptions options = few(1);
  options.output_folder = kFolder / "ifov_aliasing";
  const StudyOutcome outcome = find_study("aliasing")->run(options);
  // Figures, page, document; the chart, its images, samples and errors by four ways, and a plot, each as SVG and PDF.
  ASSERT_EQ(outcome.files.size(), 3u + 2u * (1u + 4u * 3u + 1u));
  for (const auto& file : outcome.files) EXPECT_GT(std::filesystem::file_size(file), 1000u) << file;
  EXPECT_NE(outcome.table.find("grid_10_rms"), std::string::npos);
  EXPECT_EQ(outcome.all_met, outcome.table.find("  NO\n") == std::string::npos);
  std::filesystem::remove_all(options.output_folder);
}

}  // namespace
}  // namespace ifov::studies::test_study_renders
