#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/spectra/channel_table.h"
#include "io/spectra/ecostress.h"
#include "io/spectra/sample_spectrum.h"
#include "io/spectra_files.h"
#include "radiometry/planck.h"
#include "radiometry/solar_spectrum.h"
#include "radiometry/spectral_nodes.h"
#include "support/truth_data.h"

namespace ifov::io::test_spectra_nodes {
namespace {

using radiometry::Channel;
using radiometry::SpectralNodes;
using radiometry::Spectrum;

/// All spectra of the library's sample that reach from 0.42 um to 12.5 um, and joined halves of leaves and
/// grass; none where the reference data are absent.
std::vector<Spectrum> library() {
  std::vector<Spectrum> spectra;
  const auto folder = test::truth_file("spectra/ecostress");
  if (!folder) return spectra;
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(*folder), {});
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const std::string name = file.filename().string();
    if (name.find(".tir.") != std::string::npos) continue;
    Spectrum spectrum = read_ecostress(file, radiometry::OutsideRange::extend).reflectance;
    if (const std::size_t at = name.find(".vswir."); at != std::string::npos) {
      const std::string partner = name.substr(0, at) + ".tir.";
      const auto tir = std::find_if(files.begin(), files.end(), [&](const auto& other) {
        return other.filename().string().starts_with(partner);
      });
      spectrum =
          join(spectrum, read_ecostress(*tir).reflectance).with_outside(radiometry::OutsideRange::extend);
    }
    spectra.push_back(std::move(spectrum));
  }
  return spectra;
}

/// Channel mean of a product by steps of at most 1 nm, and at least 400 in a channel.
double full_integration(const Channel& channel, const std::vector<const Spectrum*>& product,
                        double planck_k = 0.0) {
  const double first = channel.response.first_um(), last = channel.response.last_um();
  const int steps = std::max(400, static_cast<int>(std::ceil((last - first) * 1000.0)));
  double sum = 0.0, total = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double x = first + (i + 0.5) * (last - first) / steps;
    double value = channel.response.at(x);
    total += value;
    if (planck_k > 0.0) value *= radiometry::planck_w_m2_sr_um(x, planck_k);
    for (const Spectrum* factor : product) value *= factor->at(x);
    sum += value;
  }
  return sum / total;
}

/// Largest error of the nodes over surfaces singly, in pairs and in threes under the Sun, and emitting at
/// some temperatures, relative to the channel's radiance (or a hundredth of a white surface's).
double worst_error(const std::vector<Channel>& channels, const std::vector<Spectrum>& surfaces,
                   const SpectralNodes& nodes, bool sunlit) {
  const Spectrum& sun = radiometry::solar_irradiance_1au();
  std::vector<std::vector<float>> rows;
  for (const Spectrum& s : surfaces) nodes.average_surface(s, rows.emplace_back(nodes.node_count()));
  std::vector<float> source(nodes.node_count()), light, found(channels.size());
  double worst = 0.0;
  const auto compare = [&](const std::vector<const Spectrum*>& product, double planck_k) {
    nodes.to_channels(light.data(), found.data());
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const double expected = full_integration(channels[i], product, planck_k);
      const double white =
          planck_k > 0.0 ? full_integration(channels[i], {}, 300.0) : full_integration(channels[i], {&sun});
      worst = std::max(worst, std::abs(found[i] - expected) / std::max(expected, 1e-2 * white));
    }
  };
  const auto multiply = [&](std::size_t s) {
    for (std::size_t n = 0; n < light.size(); ++n) light[n] *= rows[s][n];
  };
  for (std::size_t a = 0; a < surfaces.size(); ++a) {
    if (!sunlit) {
      const Spectrum emissivity = surfaces[a].complement();
      for (const double temperature : {220.0, 300.0, 600.0}) {
        nodes.planck(temperature, std::span<float>(source));
        light = source;
        for (std::size_t n = 0; n < light.size(); ++n) light[n] *= 1.0f - rows[a][n];
        compare({&emissivity}, temperature);
      }
      continue;
    }
    nodes.average_source(sun, source);
    light = source;
    multiply(a);
    compare({&sun, &surfaces[a]}, 0.0);
    const std::size_t b = (a * 7 + 3) % surfaces.size();
    multiply(b);
    compare({&sun, &surfaces[a], &surfaces[b]}, 0.0);
    multiply(a);
    compare({&sun, &surfaces[a], &surfaces[b], &surfaces[a]}, 0.0);
  }
  return worst;
}

TEST(SpectralNodesOfRealSpectra, ImagingSpectrometer) {
  const auto surfaces = library();
  if (surfaces.empty()) GTEST_SKIP() << "reference data not found: spectra/ecostress";
  std::vector<Channel> channels;
  for (int i = 0; i < 210; ++i) channels.push_back(Channel::gaussian("", 0.4 + 0.01 * i, 0.010));
  const auto nodes = SpectralNodes::build(channels, radiometry::solar_irradiance_1au(), surfaces);
  std::printf("%zu surfaces, 210 channels of 10 nm: %zu nodes, worst error in construction %.1e\n",
              surfaces.size(), nodes.node_count(), nodes.worst_error());
  EXPECT_LT(nodes.node_count(), 420u);
  EXPECT_LE(worst_error(channels, surfaces, nodes, true), 1e-3);
}

// What a scene of a few materials costs.
TEST(SpectralNodesOfRealSpectra, FewMaterialsNeedFewNodes) {
  auto surfaces = library();
  if (surfaces.empty()) GTEST_SKIP() << "reference data not found: spectra/ecostress";
  std::vector<Spectrum> few;
  for (std::size_t i = 0; i < surfaces.size(); i += 6) few.push_back(surfaces[i]);
  std::vector<Channel> channels;
  for (int i = 0; i < 210; ++i) channels.push_back(Channel::gaussian("", 0.4 + 0.01 * i, 0.010));
  const auto nodes =
      SpectralNodes::build(channels, radiometry::solar_irradiance_1au(), few, {.hottest_k = 350.0});
  const auto single = SpectralNodes::build(channels, radiometry::solar_irradiance_1au(), few,
                                           {.reflections = 1, .hottest_k = 350.0});
  std::printf("%zu surfaces, 210 channels of 10 nm: %zu nodes, %zu for one reflection\n", few.size(),
              nodes.node_count(), single.node_count());
  EXPECT_LT(nodes.node_count(), 360u);
  EXPECT_EQ(single.node_count(), 210u);
}

TEST(SpectralNodesOfRealSpectra, LandsatSentinelAndAster) {
  const auto surfaces = library();
  if (surfaces.empty()) GTEST_SKIP() << "reference data not found: spectra/ecostress";
  for (const char* sensor : {"L8_OLI", "S2A_MSI_V4", "L8_TIRS", "TERRA_ASTER_TIR"}) {
    const auto file = test::truth_file(std::string("sensors/rsr-acolite/") + sensor + ".txt");
    if (!file) GTEST_SKIP() << "reference data not found: sensors/rsr-acolite";
    const std::vector<Channel> channels = read_channels(*file);
    const auto nodes = SpectralNodes::build(channels, radiometry::solar_irradiance_1au(), surfaces);
    std::printf("%s: %zu channels, %zu nodes, worst error in construction %.1e\n", sensor, channels.size(),
                nodes.node_count(), nodes.worst_error());
    EXPECT_LE(worst_error(channels, surfaces, nodes, channels[0].centre_um < 3.0), 1e-3) << sensor;
  }
}

}  // namespace
}  // namespace ifov::io::test_spectra_nodes
