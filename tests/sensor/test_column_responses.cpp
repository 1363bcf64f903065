#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "sensor/detector/brightness_scale.h"
#include "sensor/spectrometer/column_responses.h"

namespace ifov::sensor {
namespace {

using radiometry::Channel;
using radiometry::OutsideRange;
using radiometry::Spectrum;

/// A place and a width for each of so many columns.
template <class Centre, class Width>
ChannelColumns columns_of(int count, const Centre& centre, const Width& width) {
  ChannelColumns columns;
  for (int i = 0; i < count; ++i) {
    const double u = (2.0 * i + 1.0) / count - 1.0;
    columns.centre_um.push_back(centre(u));
    columns.fwhm_um.push_back(width(u));
  }
  return columns;
}

Spectrum line_spectrum(double at_um, double sigma_um) {
  std::vector<double> um, values;
  for (int k = 0; k <= 5000; ++k) {
    um.push_back(0.45 + 0.1 * k / 5000.0);
    const double z = (um.back() - at_um) / sigma_um;
    values.push_back(1.0 - 0.9 * std::exp(-0.5 * z * z));
  }
  return {std::move(um), std::move(values)};
}

/// The largest difference of a column's mean to the sum of those that are carried, and what is told to be left out.
struct Off {
  double worst, left_out, spread;
  std::size_t carried;
};

Off off_of(const Channel& channel, const ChannelColumns& columns, const Spectrum& spectrum) {
  const ColumnResponses responses = ColumnResponses::find(std::vector{channel}, std::vector{columns});
  Off off{0.0, responses[0].left_out, responses.most_spread(), responses.carried()};
  for (std::size_t i = 0; i < columns.centre_um.size(); ++i) {
    const double own = channel_mean(moved(channel, columns.centre_um[i], columns.fwhm_um[i]), spectrum);
    const std::span<const float> weights = responses.weights(0, static_cast<int>(i));
    double sum = 0.0, all = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      sum += static_cast<double>(weights[k]) * channel_mean(responses[0].carried[k], spectrum);
      all += static_cast<double>(weights[k]);
    }
    EXPECT_NEAR(all, 1.0, 1e-6);
    off.worst = std::max(off.worst, std::abs(sum - own));
  }
  return off;
}

TEST(ColumnResponses, OfAGaussianFewAreCarriedAndSumsAreRight) {
  const Channel channel = Channel::gaussian("c", 0.5, 0.01);
  const auto own = [](double) { return 0.01; };
  struct Case {
    double reach_um;
    std::size_t most;
  };
  for (const auto& [reach_um, most] : {Case{0.0005, 3}, Case{0.001, 4}, Case{0.005, 9}}) {
    const ChannelColumns columns = columns_of(
        41, [&, reach = reach_um](double u) { return 0.5 + reach * u; }, own);
    for (const double sigma_um : {0.0002, 0.001, 0.01}) {
      const Off off = off_of(channel, columns, line_spectrum(0.502, sigma_um));
      EXPECT_LE(off.left_out, ColumnResponses::kLeftOut);
      EXPECT_LE(off.worst, 1.1e-4);  // at most what is left out of a spectrum between 0.1 and 1
      EXPECT_LE(off.carried, most);
      EXPECT_LT(off.spread, 2.2);
      EXPECT_GT(off.carried, 1u);
    }
  }
}

TEST(ColumnResponses, WidthsAndTablesOfMeasuredResponses) {
  std::vector<double> um, values;
  for (int k = 0; k <= 40; ++k) {
    um.push_back(0.48 + 0.001 * k);
    values.push_back(std::exp(-std::pow((um.back() - 0.497) / 0.006, 4)) + 0.1 * (k % 3));
  }
  const Channel channel = Channel::tabulated("t", Spectrum(um, values, OutsideRange::zero));
  const ChannelColumns columns = columns_of(
      81, [&](double u) { return channel.centre_um + 0.001 * u - 0.0005 * u * u; },
      [&](double u) { return channel.fwhm_um * (1.0 + 0.05 * u * u); });
  const Off off = off_of(channel, columns, line_spectrum(0.497, 0.001));
  EXPECT_LE(off.worst, off.left_out + 1e-5);
  EXPECT_LE(off.left_out, 2e-3);
}

TEST(ColumnResponses, RectanglesLeaveOutNoMoreThanIsTold) {
  const Channel channel = Channel::top_hat("r", 0.495, 0.505);
  const ChannelColumns columns = columns_of(
      160, [](double u) { return 0.5 + 0.002 * u; }, [](double) { return 0.01; });
  const Off off = off_of(channel, columns, line_spectrum(0.5055, 0.0003));
  EXPECT_EQ(off.carried, ColumnResponses::kMostCarried);
  EXPECT_GT(off.left_out, ColumnResponses::kLeftOut);
  EXPECT_LE(off.worst, off.left_out + 1e-5);
}

TEST(ColumnResponses, WhatIsAlikeInAllColumnsIsCarriedOnce) {
  const std::vector<Channel> channels{Channel::gaussian("a", 0.5, 0.01), Channel::monochromatic("b", 0.6),
                                      Channel::gaussian("c", 0.7, 0.01)};
  const auto moved_as = [](double u) { return 0.7 + 0.001 * u; };
  const std::vector<ChannelColumns> columns{
      columns_of(
          20, [](double) { return 0.502; }, [](double) { return 0.01; }),
      {},
      columns_of(20, moved_as, [](double) { return 0.01; })};
  const ColumnResponses responses = ColumnResponses::find(channels, columns);
  EXPECT_EQ(responses.first(1), 1u);
  EXPECT_EQ(responses.first(2), 2u);
  EXPECT_GT(responses.carried(), 4u);
  EXPECT_DOUBLE_EQ(responses.all_carried()[0].centre_um, 0.502);
  EXPECT_EQ(responses.all_carried()[1].name, "b");
  EXPECT_EQ(responses.all_carried()[2].name, "c in column 1");
  EXPECT_EQ(responses.channel_of(responses.carried() - 1), 2u);
  EXPECT_DOUBLE_EQ(responses.spread(1, 7), 1.0);
  EXPECT_GE(responses.most_spread(), 1.0);
  EXPECT_LT(responses.most_spread(), 1.7);  // of Chebyshev's four points 5/3
}

TEST(ColumnResponses, AResponseThatReachesBelowNoWavelengthIsRefused) {
  const Channel channel = Channel::gaussian("a", 0.5, 0.1);
  EXPECT_THROW(moved(channel, 0.1, 0.1), InputError);
}

TEST(BrightnessScale, ThereAndBack) {
  const BrightnessScale scale(Channel::gaussian("a", 10.0, 0.8));
  for (const double kelvin : {55.0, 211.3, 300.0, 1234.5, 4900.0, 6000.0}) {
    const double radiance = scale.radiance_w_m2_sr_um(kelvin);
    EXPECT_NEAR(radiance / radiometry::channel_planck_w_m2_sr_um(scale.channel(), kelvin), 1.0, 2e-6);
    EXPECT_NEAR(scale.kelvin(radiance), kelvin, 2e-4);
  }
}

}  // namespace
}  // namespace ifov::sensor
