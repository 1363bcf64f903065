// What the study of temperatures measures, small: each with a planted fault beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "studies/common/reference_data.h"
#include "studies/study_folder.h"
#include "studies/temperature/temperature_checks.h"
#include "studies/temperature/temperature_sections.h"

namespace ifov::studies::test_temperature_study {
namespace {

TEST(TemperatureStudy, SolidsAreAsTheirClosedForms) {
  for (int k = 0; k < kSlabCases; ++k) {
    const auto of = static_cast<SlabCase>(k);
    EXPECT_LT(slab_error_k(of, 300.0), 0.1) << name_of(of);
    EXPECT_GT(slab_error_k(of, 300.0, 1.2), 0.1) << name_of(of);
  }
  EXPECT_LT(layered_error_k(900.0), 0.2);
  EXPECT_GT(layered_error_k(900.0, 1.5), 0.2);
  // Known answers of the forms themselves: 0.47908 of the step of air after an hour at the surface; a wave of 14.748 K.
  EXPECT_NEAR(closed_form_k(SlabCase::air_step, 3600.0, 0.0), 4.7908, 1e-4);
  double most_k = 0.0;
  for (int minute = 0; minute < 1440; ++minute)
    most_k = std::max(most_k, closed_form_k(SlabCase::periodic_flux_in_air, 60.0 * minute, 0.0));
  EXPECT_NEAR(most_k, 14.748, 1e-3);
}

TEST(TemperatureStudy, BalancesClose) {
  EXPECT_NEAR(steady_plate_k(900.0, 280.0, 10.0, 300.0), 347.204, 1e-3);
  EXPECT_LT(heat_unaccounted(), 1e-6);
  EXPECT_LT(therm_error_k(), 0.05);
  EXPECT_GT(therm_error_k(0.5), 1.0);
}

TEST(TemperatureStudy, RoofsStandInTheWindOfTheirHeight) {
  const StudyOptions options = in_a_folder("ifov_test_temperature_roofs");
  EXPECT_LT(roof_wind(true, options).worst_k, 0.1);
  EXPECT_GT(roof_wind(true, options, true).worst_k, 1.0);
}

TEST(TemperatureStudy, EachWrongWeatherIsNoticed) {
  const StudyOptions options = in_a_folder("ifov_test_temperature_faults");
  for (const Fault fault : {Fault::no_diffuse_light, Fault::wind_of_10_m, Fault::local_clock,
                            Fault::sky_as_air, Fault::other_yesterday})
    EXPECT_GT(pole_shadow(options, fault).worst_k, 1.0) << static_cast<int>(fault);
}

TEST(TemperatureStudy, PointsOfASuburbAreAsEachSolvedInFull) {
  const StudyOptions options = in_a_folder("ifov_test_temperature_suburb");
  const SuburbPoints found = suburb_points(100, std::span(kSuburbHours).subspan(2, 1), false, options);
  EXPECT_EQ(found.points, 100u);
  EXPECT_LT(found.rms_k, 0.15);
  EXPECT_LT(std::abs(found.bias_k), 0.02);
  EXPECT_GT(found.covered, 0.93);
  // What is compared differs from point to point: a class that knew nothing of it would be far off.
  double mean_k = 0.0, squares_k2 = 0.0;
  for (const double kelvin : found.full_k) mean_k += kelvin / 100.0;
  for (const double kelvin : found.full_k) squares_k2 += (kelvin - mean_k) * (kelvin - mean_k) / 100.0;
  EXPECT_GT(std::sqrt(squares_k2), 5.0);
}

TEST(TemperatureStudy, SaysWhatIsNotMeasured) {
  const StudyOptions options = in_a_folder("ifov_test_temperature_missing");
  const ReferenceData nothing("");
  const ReportSection section = unmeasured_section({nothing, options});
  EXPECT_GE(section.figures.figures().size(), 5u);
  for (const Figure& figure : section.figures.figures()) EXPECT_FALSE(figure.ok) << figure.name;
}

/// A name that is misspelt is not taken for "no reference data".
TEST(ReferenceFolder, IsAFolderWhereOneIsNamed) {
  StudyOptions options = in_a_folder("ifov_test_reference_folder");
  options.reference = options.output_folder;
  EXPECT_EQ(reference_folder(options), options.output_folder);
  options.reference /= "misspelt";
  try {
    reference_folder(options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "'" + options.reference.string() + "' is no folder: reference data were said to be there");
  }
}

}  // namespace
}  // namespace ifov::studies::test_temperature_study
