#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "studies/atmosphere/node_errors.h"
#include "studies/atmosphere/rendered_checks.h"
#include "studies/atmosphere/rfmip_fluxes.h"
#include "studies/studies.h"
#include "support/truth_data.h"

namespace ifov::studies::test_atmosphere_checks {
namespace {

StudyOptions in_temporary_folder() {
  StudyOptions options;
  options.output_folder = std::filesystem::temp_directory_path();
  return options;
}

double worst(const NodeErrors& errors) {
  double result = 0.0;
  for (const auto& by_channel : errors.relative)
    for (const double error : by_channel) result = std::max(result, std::abs(error));
  return result;
}

// Every bin and term of channels of an imaging spectrometer, in and out of bands, and of wide ones.
TEST(AtmosphereNodes, StandForAllTerms) {
  std::vector<radiometry::Channel> channels;
  for (const double um : {0.4, 0.7616, 1.38, 2.49})
    channels.push_back(radiometry::Channel::gaussian("", um, 0.01));
  channels.push_back(radiometry::Channel::top_hat("", 1.36, 1.39));
  const NodeErrors errors = node_errors(channels, {});
  RecordProperty("worst", std::to_string(worst(errors)));
  EXPECT_LE(worst(errors), 0.0025);
  EXPECT_LE(errors.nodes, 4 * channels.size());
  // The planted fault: one node a channel, as if its absorption were grey. It is seen in a single one.
  const std::array faulty{radiometry::Channel::gaussian("", 2.49, 0.01)};
  EXPECT_GT(worst(node_errors(faulty, {.most_nodes = 1})), 0.005);
}

TEST(AtmosphereNodes, StandForAllTermsOfThermalChannels) {
  std::vector<radiometry::Channel> channels;
  for (const double um : {4.3, 9.6}) channels.push_back(radiometry::Channel::gaussian("", um, 0.05 * um));
  EXPECT_LE(worst(node_errors(channels, {})), 0.005);
  const std::array faulty{radiometry::Channel::gaussian("", 9.6, 0.48)};
  EXPECT_GT(worst(node_errors(faulty, {.most_nodes = 1})), 0.02);
}

// Surfaces of every kind, polished metals among them, in a channel with bands of water and ozone in it: the nodes are as near
// to all terms as they say, and they say what can be lived with.
TEST(AtmosphereNodes, SayHowFarTheyAreOffOverManySurfaces) {
  std::vector<radiometry::Channel> channels{radiometry::Channel::top_hat("", 8.0, 12.0),
                                            radiometry::Channel::top_hat("", 3.5, 4.2)};
  const NodeErrors errors =
      node_errors(channels, {.most_nodes = 32, .tolerance = 1e-3, .whole_library = true});
  ASSERT_GT(errors.surfaces.size(), 50u);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    EXPECT_LT(errors.claimed[c], 1e-2) << c;
    for (std::size_t s = 0; s < errors.surfaces.size(); ++s)
      EXPECT_LE(std::abs(errors.relative[s][c]), errors.claimed[c]) << c << ' ' << errors.surfaces[s];
  }
  // The planted fault: one node a channel. It is off by more, and says so.
  const NodeErrors one = node_errors(std::span(channels).first(1), {.most_nodes = 1, .whole_library = true});
  EXPECT_GT(worst(one), 0.02);
  EXPECT_GT(one.claimed[0], 0.02);
}

// A dozen of RFMIP's hundred columns, warm and cold.
TEST(AtmosphereFluxes, RfmipClearColumns) {
  const auto folder = test::truth_file("atmosphere/rrtmgp_rfmip");
  if (!folder) GTEST_SKIP() << "reference data not found: atmosphere/rrtmgp_rfmip";
  constexpr std::array<std::size_t, 12> kSites{0, 9, 18, 27, 36, 45, 54, 63, 72, 81, 90, 99};
  double difference = 0.0, sun = 0.0, sun_reference = 0.0;
  int lit = 0;
  for (const RfmipColumn& column :
       rfmip_fluxes(*folder, kSites, {.longwave_step_cm1 = 15.0, .shortwave_step_cm1 = 75.0})) {
    EXPECT_NEAR(column.longwave, column.longwave_reference, 9.0) << "site " << column.site;
    EXPECT_LE(std::abs(column.longwave - column.longwave_reference), column.longwave_stated) << column.site;
    EXPECT_LT(column.longwave_stated, 0.25 * column.longwave) << column.site;
    difference += (column.longwave - column.longwave_reference) / kSites.size();
    if (column.shortwave_reference <= 0.0) continue;
    ++lit;
    EXPECT_LE(std::abs(column.shortwave - column.shortwave_reference), column.shortwave_stated)
        << column.site;
    EXPECT_LT(column.shortwave_stated, 0.25 * column.shortwave) << column.site;
    sun += column.shortwave;
    sun_reference += column.shortwave_reference;
  }
  RecordProperty("longwave", std::to_string(difference));
  RecordProperty("shortwave", std::to_string(sun / sun_reference));
  EXPECT_NEAR(difference, 0.0, 6.0);
  EXPECT_GT(lit, 3);
  EXPECT_NEAR(sun / sun_reference, 1.0, 0.02);
  // The planted fault: a tenth of the water vapour.
  constexpr std::array<std::size_t, 1> kOne{0};
  const RfmipColumn dry =
      rfmip_fluxes(*folder, kOne, {.water_share = 0.1, .longwave_step_cm1 = 15.0, .shortwave_step_cm1 = 75.0})
          .front();
  EXPECT_GT(std::abs(dry.longwave - dry.longwave_reference), 12.0);
  EXPECT_GT(std::abs(dry.longwave - dry.longwave_reference), dry.longwave_stated);
}

TEST(AtmosphereRendered, ClosedRoomAtOneTemperature) {
  for (const EnclosureChannel& channel : render_enclosure(in_temporary_folder()))
    EXPECT_NEAR(channel.mean, channel.planck, 3.5 * channel.standard_error) << channel.centre_um;
  // The planted fault: colder air in the room. It shows where 50 m of air are opaque.
  const EnclosureChannel faulty = render_enclosure(in_temporary_folder(), 290.0).front();
  EXPECT_GT(std::abs(faulty.mean - faulty.planck), 10.0 * faulty.standard_error);
}

TEST(AtmosphereRendered, LinesAddNoVarianceToPathsOverAPlain) {
  const std::vector<PlainChannel> channels = render_plain(in_temporary_folder());
  ASSERT_EQ(channels.size(), 3u);
  const double outside = channels[0].relative_deviation;
  EXPECT_LT(outside, 0.2);
  for (std::size_t c = 1; c < channels.size(); ++c) {
    EXPECT_LT(channels[c].relative_deviation, 1.1 * outside) << channels[c].centre_um;
    // The planted fault: one term a path.
    EXPECT_GT(channels[c].drawn_deviation, 2.0 * outside) << channels[c].centre_um;
  }
}

}  // namespace
}  // namespace ifov::studies::test_atmosphere_checks
