#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "radiometry/channel_grid.h"
#include "radiometry/node_search.h"
#include "radiometry/node_trial.h"
#include "radiometry/planck.h"
#include "radiometry/planck_table.h"
#include "radiometry/solar_spectrum.h"
#include "radiometry/spectral_nodes.h"

namespace ifov::radiometry::test_spectral_nodes {
namespace {

/// Vegetation, soil and snow in outline: a red edge, a slope, water bands.
std::vector<Spectrum> outlines() {
  return {Spectrum({0.3, 0.5, 0.55, 0.60, 0.68, 0.72, 0.76, 1.3, 1.45, 1.65, 1.95, 2.2, 2.6, 20.0},
                   {0.03, 0.04, 0.10, 0.06, 0.04, 0.22, 0.45, 0.46, 0.15, 0.30, 0.05, 0.14, 0.02, 0.02}),
          Spectrum({0.3, 0.6, 1.0, 2.0, 2.6, 8.0, 9.0, 9.6, 14.0, 20.0},
                   {0.05, 0.18, 0.30, 0.38, 0.30, 0.05, 0.30, 0.12, 0.03, 0.03}),
          Spectrum({0.3, 0.9, 1.05, 1.2, 1.5, 1.8, 2.0, 2.3, 20.0},
                   {0.98, 0.9, 0.75, 0.5, 0.03, 0.15, 0.01, 0.1, 0.01}),
          Spectrum::constant(0.25)};
}

std::vector<Channel> imaging_spectrometer() {
  std::vector<Channel> channels;
  for (int i = 0; i < 210; ++i)
    channels.push_back(Channel::gaussian(std::to_string(i), 0.4 + 0.01 * i, 0.010));
  return channels;
}

/// Channel mean of a product of up to four spectra, by brute force: `per_um` points a micrometre.
double brute_force(const Channel& channel, const std::vector<const Spectrum*>& product, double per_um) {
  if (channel.is_monochromatic()) {
    double value = 1.0;
    for (const Spectrum* factor : product) value *= factor->at(channel.centre_um);
    return value;
  }
  const double first = channel.response.first_um(), last = channel.response.last_um();
  const int steps = static_cast<int>(std::ceil((last - first) * per_um));
  double sum = 0.0, total = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double x = first + (i + 0.5) * (last - first) / steps;
    double value = channel.response.at(x);
    total += value;
    for (const Spectrum* factor : product) value *= factor->at(x);
    sum += value;
  }
  return sum / total;
}

class Rows {
 public:
  Rows(const SpectralNodes& nodes, std::span<const Spectrum> surfaces, const Spectrum& sun)
      : nodes_(nodes), sun_(nodes.node_count()) {
    for (const Spectrum& surface : surfaces) {
      surfaces_.emplace_back(nodes.node_count());
      nodes.average_surface(surface, surfaces_.back());
    }
    nodes.average_source(sun, sun_);
  }
  /// Channel values of sun x surfaces a, b, c (-1: none).
  std::vector<float> reflected(std::initializer_list<int> surfaces) const {
    std::vector<float> light = sun_, channels(nodes_.channel_count());
    for (const int s : surfaces)
      for (std::size_t n = 0; n < light.size(); ++n) light[n] *= surfaces_[static_cast<std::size_t>(s)][n];
    nodes_.to_channels(light.data(), channels.data());
    return channels;
  }
  const std::vector<float>& surface(std::size_t s) const { return surfaces_[s]; }

 private:
  const SpectralNodes& nodes_;
  std::vector<std::vector<float>> surfaces_;
  std::vector<float> sun_;
};

TEST(SpectralNodes, ReflectedSunlightIsWithinATenthOfAPercentOfA1NmIntegration) {
  const auto channels = imaging_spectrometer();
  const auto surfaces = outlines();
  const Spectrum& sun = solar_irradiance_1au();
  const auto nodes = SpectralNodes::build(channels, sun, surfaces);
  EXPECT_LE(nodes.worst_error(), 7e-4);
  EXPECT_LT(static_cast<double>(nodes.node_count()), 2.0 * 210.0);
  RecordProperty("nodes", static_cast<int>(nodes.node_count()));
  const Rows rows(nodes, surfaces, sun);
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b)
      for (int c = 0; c <= b; ++c) {
        const auto found = rows.reflected({a, b, c});
        const auto single = rows.reflected({a});
        for (std::size_t i = 0; i < channels.size(); ++i) {
          const auto of = [&](int s) { return &surfaces[static_cast<std::size_t>(s)]; };
          const double white = brute_force(channels[i], {&sun}, 20000.0);
          const double three = brute_force(channels[i], {&sun, of(a), of(b), of(c)}, 20000.0);
          EXPECT_NEAR(found[i], three, 1e-3 * std::max(three, 1e-2 * white)) << i << ' ' << a << b << c;
          if (b == 0 && c == 0) {
            const double one = brute_force(channels[i], {&sun, of(a)}, 20000.0);
            EXPECT_NEAR(single[i] / one, 1.0, 1e-4) << i;
          }
        }
      }
}

// The same with one average per channel misses by percents on the red edge: the check above can fail.
TEST(SpectralNodes, OneAveragePerChannelWouldNotDo) {
  const auto channels = imaging_spectrometer();
  const auto surfaces = outlines();
  const Spectrum& sun = solar_irradiance_1au();
  const auto nodes = SpectralNodes::build(channels, sun, surfaces, {.tolerance = 1.0});
  EXPECT_EQ(nodes.node_count(), channels.size());
  const auto twice = Rows(nodes, surfaces, sun).reflected({0, 0});
  double worst = 0.0;
  for (std::size_t i = 0; i < channels.size(); ++i)
    worst = std::max(
        worst,
        std::abs(twice[i] / brute_force(channels[i], {&sun, &surfaces[0], &surfaces[0]}, 20000.0) - 1));
  EXPECT_GT(worst, 0.01);
}

TEST(SpectralNodes, ThermalEmissionInWideChannels) {
  const std::vector<Channel> channels{Channel::top_hat("lwir", 8.0, 14.0), Channel::top_hat("mwir", 3.0, 5.0),
                                      Channel::gaussian("b11", 12.0, 1.0), Channel::monochromatic("m", 8.5)};
  const auto surfaces = outlines();
  for (const Spectrum& sun : {solar_irradiance_1au(), Spectrum()}) {
    const auto nodes = SpectralNodes::build(channels, sun, surfaces);
    EXPECT_LE(nodes.worst_error(), 7e-4);
    const Rows rows(nodes, surfaces, sun);
    std::vector<float> planck(nodes.node_count()), light(planck.size()), found(channels.size());
    for (const double temperature : {200.0, 260.0, 300.0, 350.0, 600.0, 1000.0}) {
      nodes.planck(temperature, std::span<float>(planck));
      for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const auto& rho = rows.surface(s);
        for (std::size_t n = 0; n < light.size(); ++n) light[n] = (1.0f - rho[n]) * planck[n];
        nodes.to_channels(light.data(), found.data());
        for (std::size_t i = 0; i < channels.size(); ++i) {
          double expected = 0.0, total = 0.0;
          const Channel& c = channels[i];
          const double first = c.is_monochromatic() ? c.centre_um : c.response.first_um();
          const double last = c.is_monochromatic() ? c.centre_um : c.response.last_um();
          for (int k = 0; k < 20000; ++k) {
            const double x = first + (k + 0.5) * (last - first) / 20000;
            expected += c.response.at(x) * (1.0 - surfaces[s].at(x)) * planck_w_m2_sr_um(x, temperature);
            total += c.response.at(x);
          }
          expected /= total;
          const double floor = std::max(1e-2 * channel_planck_w_m2_sr_um(c, 300.0),
                                        0.1 * channel_planck_w_m2_sr_um(c, temperature));
          EXPECT_NEAR(found[i], expected, 1e-3 * std::max(expected, floor)) << c.name << ' ' << temperature;
        }
      }
    }
  }
}

TEST(SpectralNodes, PlanckOfChannelsIsExact) {
  std::vector<Channel> channels = imaging_spectrometer();
  channels.push_back(Channel::top_hat("wide", 8.0, 14.0));
  channels.push_back(Channel::top_hat("mwir", 3.0, 5.0));
  channels.push_back(Channel::top_hat("all", 0.3, 14.0));
  const auto nodes = SpectralNodes::build(channels, solar_irradiance_1au(), outlines());
  std::vector<double> found(channels.size());
  for (const double temperature : {200.0, 300.0, 1000.0}) {
    nodes.planck_channels(temperature, found);
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const double expected = channel_planck_w_m2_sr_um(channels[i], temperature);
      EXPECT_NEAR(found[i], expected, 1e-5 * std::max(expected, 1e-6))
          << channels[i].name << ' ' << temperature;
    }
  }
}

TEST(SpectralNodes, OneReflectionNeedsOneNode) {
  const auto channels = imaging_spectrometer();
  const auto nodes = SpectralNodes::build(channels, solar_irradiance_1au(), outlines(),
                                          {.reflections = 1, .hottest_k = 350.0});
  EXPECT_EQ(nodes.node_count(), channels.size());
}

TEST(SpectralNodes, ConstantsStay) {
  const auto nodes = SpectralNodes::build(imaging_spectrometer(), solar_irradiance_1au(), outlines());
  std::vector<float> row(nodes.node_count()), channels(nodes.channel_count());
  nodes.average_surface(Spectrum::constant(0.37), row);
  for (const float value : row) EXPECT_FLOAT_EQ(value, 0.37f);
  nodes.average_source(Spectrum::constant(2.5), row);
  nodes.to_channels(row.data(), channels.data());
  for (const float value : channels) EXPECT_NEAR(value, 2.5f, 2e-6f);
}

TEST(SpectralNodes, FactorsStayWithinTheirRangeAndSourcesPositive) {
  const auto nodes = SpectralNodes::build(imaging_spectrometer(), solar_irradiance_1au(), outlines());
  // Steps and needles, which a polynomial overshoots.
  std::vector<double> x, y;
  for (int i = 0; i < 2400; ++i) {
    x.push_back(0.3 + 0.001 * i);
    y.push_back(i % 37 < 2 ? 1.0 : 0.0);
  }
  const Spectrum needles(x, y);
  std::vector<float> row(nodes.node_count());
  nodes.average_surface(needles, row);
  EXPECT_GE(*std::min_element(row.begin(), row.end()), 0.0f);
  EXPECT_LE(*std::max_element(row.begin(), row.end()), 1.0f);
  nodes.average_source(needles, row);
  EXPECT_GE(*std::min_element(row.begin(), row.end()), 0.0f);
  std::vector<float> channels(nodes.channel_count());
  nodes.to_channels(row.data(), channels.data());
  const auto expected = imaging_spectrometer();
  for (std::size_t i = 0; i < channels.size(); ++i)
    EXPECT_NEAR(channels[i], brute_force(expected[i], {&needles}, 50000.0), 2e-3) << i;
}

TEST(SpectralNodes, MonochromaticIsExact) {
  const std::vector<Channel> channels{Channel::monochromatic("m", 8.5)};
  const auto nodes = SpectralNodes::build(channels, Spectrum(), outlines());
  ASSERT_EQ(nodes.node_count(), 1u);
  EXPECT_EQ(nodes.node_weight(0), 1.0);
  double radiance = 0.0;
  nodes.planck(313.15, std::span<double>(&radiance, 1));
  EXPECT_DOUBLE_EQ(radiance, planck_w_m2_sr_um(8.5, 313.15));
}

TEST(SpectralNodes, ASpectrumMustCoverTheChannels) {
  const std::vector<Channel> channels{Channel::gaussian("tir", 10.0, 0.5)};
  const std::vector<Spectrum> surfaces{Spectrum({0.4, 2.5}, {0.1, 0.2}, OutsideRange::error, "leaf")};
  EXPECT_THROW(SpectralNodes::build(channels, Spectrum(), surfaces), InputError);
}

TEST(PlanckTable, InterpolatesWithinItsTolerance) {
  const std::vector<Channel> channels{Channel::monochromatic("a", 8.5), Channel::gaussian("b", 3.7, 0.2),
                                      Channel::gaussian("c", 2.2, 0.01), Channel::gaussian("d", 0.5, 0.01),
                                      Channel::top_hat("e", 8.0, 14.0)};
  const auto nodes = SpectralNodes::build(channels, Spectrum(), {});
  const PlanckTable table(nodes, 230.0, 400.0);
  std::vector<double> exact(channels.size());
  ASSERT_EQ(nodes.node_count(), exact.size());
  SpectrumBlock row(1, exact.size());
  for (int i = 0; i <= 1700; ++i) {
    const double temperature = 230.0 + 0.1 * i + (i < 1700 ? 0.0371 : 0.0);
    table.row(temperature, row.row(0));
    nodes.planck(temperature, std::span<double>(exact));
    for (std::size_t n = 0; n < exact.size(); ++n)
      EXPECT_NEAR(row.row(0)[n], exact[n], 1.2e-5 * std::max(exact[n], 1e-6)) << temperature;
  }
  table.row(100.0, row.row(0));
  nodes.planck(230.0, std::span<double>(exact));
  EXPECT_NEAR(row.row(0)[0] / exact[0], 1.0, 1e-6);
  EXPECT_THROW(PlanckTable(nodes, 300.0, 300.0), InputError);
}

// A grid takes in the points of those surfaces alone that its sums would miss, also where they stand close or end within the channel.
TEST(SpectralNodes, GridsTakeInWhatTheyWouldMiss) {
  const Channel channel = Channel::gaussian("c", 1.0, 0.1);
  const Spectrum& sun = solar_irradiance_1au();
  const auto line = [](double width_um, OutsideRange outside, bool ends) {
    std::vector<double> um, values;
    if (!ends) um = {0.3}, values = {0.4};
    for (const auto& [at, value] : {std::pair(1.0, 0.4), {1.0 + width_um, 0.9}, {1.0 + 2.0 * width_um, 0.1}})
      um.push_back(at), values.push_back(value);
    if (!ends) um.push_back(2.6), values.push_back(0.1);
    return Spectrum(std::move(um), std::move(values), outside);
  };
  const std::size_t plain = ChannelGrid(channel, sun).size();
  const auto size_with = [&](const Spectrum& surface) {
    return ChannelGrid(channel, sun, std::span(&surface, 1)).size();
  };
  EXPECT_EQ(size_with(Spectrum({0.3, 2.6}, {0.1, 0.6})), plain);
  EXPECT_GT(size_with(line(3e-4, OutsideRange::error, false)), plain);
  EXPECT_GT(size_with(line(1e-5, OutsideRange::error, false)), plain);  // by points: too close for moments
  EXPECT_GT(size_with(line(3e-4, OutsideRange::extend, true)), plain);  // ends within the channel
  EXPECT_EQ(size_with(Spectrum({0.3, 1.0 - 1e-5, 1.0, 2.6}, {0.2, 0.2, 0.2 + 1e-9, 0.2})), plain);
}

/// Reflectances of `materials` models by 33 angles each, at the points of a channel on the red edge: what a scene of directional
/// materials has. Edges stand at different wavelengths.
std::vector<std::vector<double>> by_angle(const ChannelGrid& grid, int materials) {
  std::vector<std::vector<double>> surfaces;
  for (int m = 0; m < materials; ++m)
    for (int angle = 0; angle < 33; ++angle) {
      std::vector<double>& surface = surfaces.emplace_back();
      const double edge = 0.690 + 0.030 * ((7 * m) % materials) / materials,
                   grazing = std::pow(angle / 32.0, 3);
      for (const double um : grid.wavelength_um) {
        const double straight = 0.05 + 0.4 / (1.0 + std::exp((edge - um) / 0.006));
        surface.push_back(straight + (1.0 - straight) * grazing);
      }
    }
  return surfaces;
}

/// A channel behind lines of absorption, and in the open.
ChannelGrid red_edge(bool behind_air) {
  const ChannelGrid open(Channel::gaussian("edge", 0.705, 0.010), solar_irradiance_1au());
  if (!behind_air) return open;
  std::vector<double> seen, sky;
  for (const double um : open.wavelength_um) {
    seen.push_back(0.1 + 0.8 * std::pow(std::sin(900.0 * um), 2));
    sky.push_back(200.0 * um);
  }
  return {open.wavelength_um, open.response, open.irradiance, sky, seen, 0.0};
}

std::vector<std::span<const double>> spans_of(const std::vector<std::vector<double>>& surfaces) {
  return {surfaces.begin(), surfaces.end()};
}

// Counted in radiances that rules are judged by, not in seconds: those that are sought for some surfaces and judged by all,
// against as many that are sought for all.
TEST(SpectralNodes, MoreSurfacesAreLessWorkOnceRulesAreSoughtForSome) {
  const NodeDemands demands{.coldest_k = 0.0, .hottest_k = 0.0, .most_nodes = 12};
  const ChannelGrid grid = red_edge(true);
  const auto fewer = by_angle(grid, 19), more = by_angle(grid, 20);
  ASSERT_LE(fewer.size(), kMostJudgedTogether);
  ASSERT_GT(more.size(), kMostJudgedTogether);
  const FoundRule of_fewer = find_rule(grid, fewer, demands), of_more = find_rule(grid, more, demands);
  EXPECT_LT(3 * of_more.judged, of_fewer.judged);
  EXPECT_LT(of_more.worst_error, 2.0 * of_fewer.worst_error);
}

TEST(SpectralNodes, OfManySurfacesTheOneUnlikeTheOthersIsKeptToo) {
  const NodeDemands demands{.coldest_k = 0.0, .hottest_k = 0.0};
  for (const bool behind_air : {false, true}) {
    const ChannelGrid grid = red_edge(behind_air);
    auto surfaces = by_angle(grid, 20);
    const FoundRule without = find_rule(grid, surfaces, demands);
    // Varies less than most, but from wavelength to wavelength.
    std::vector<double>& unlike = surfaces.emplace_back();
    for (const double um : grid.wavelength_um) unlike.push_back(0.5 + 0.05 * std::sin(2500.0 * um));
    const FoundRule found = find_rule(grid, surfaces, demands);
    const auto all = spans_of(surfaces);
    const NodeTrial trial(grid, all, demands);
    EXPECT_LE(trial.errors(found.rule).worst, demands.tolerance) << behind_air;
    EXPECT_GT(trial.errors(without.rule).worst, demands.tolerance) << behind_air;
  }
}

}  // namespace
}  // namespace ifov::radiometry::test_spectral_nodes
