#include "atmosphere/imported_atmosphere.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "atmosphere/imported_light.h"
#include "core/error.h"
#include "radiometry/channel_grid.h"

namespace ifov::atmosphere {
namespace {

/// Centres within this share of the width, and widths within this share, are those of one channel: tables of
/// channels are rounded, and filter files hold responses step by step.
constexpr double kSameCentre = 0.1, kSameWidth = 0.15;
/// Where the response is below this share of its largest value, values beyond the runs may stand in for it.
constexpr double kCounts = 0.01;

using radiometry::Channel;
using radiometry::Spectrum;

/// Integral of the response over its largest value, as MODTRAN states widths.
double equivalent_width_um(const Channel& channel) {
  return radiometry::integral(channel.response, channel.response.first_um(), channel.response.last_um()) /
         channel.response.maximum();
}

/// The channel of the file that is this one.
std::optional<std::size_t> same_channel(const ImportedLight& light, const Channel& channel) {
  if (light.width_um.empty() || channel.is_monochromatic()) return std::nullopt;
  const auto& um = light.wavelength_um;
  const auto next = std::lower_bound(um.begin(), um.end(), channel.centre_um);
  std::size_t nearest = static_cast<std::size_t>(next - um.begin());
  if (nearest == um.size() ||
      (nearest > 0 && channel.centre_um - um[nearest - 1] < um[nearest] - channel.centre_um))
    --nearest;
  const double width_um = light.width_um[nearest];
  if (std::abs(channel.centre_um - um[nearest]) > kSameCentre * width_um ||
      std::abs(equivalent_width_um(channel) / width_um - 1.0) > kSameWidth)
    return std::nullopt;
  return nearest;
}

/// Where the channel's response counts.
std::pair<double, double> needed_um(const Channel& channel) {
  if (channel.is_monochromatic()) return {channel.centre_um, channel.centre_um};
  const auto um = channel.response.wavelength_um();
  const auto values = channel.response.values();
  const double least = kCounts * channel.response.maximum();
  std::size_t first = 0, last = values.size() - 1;
  while (values[first] < least) ++first;
  while (values[last] < least) --last;
  return {um[first], um[last]};
}

void check_range(const ImportedLight& light, const Channel& channel) {
  const auto [first, last] = needed_um(channel);
  if (first >= light.wavelength_um.front() && last <= light.wavelength_um.back()) return;
  throw InputError(format(
      "{} goes from {:g} to {:g} um, and channel '{}' needs {:g} to {:g} um; leave the channel out, or "
      "give runs that reach further",
      light.source, light.wavelength_um.front(), light.wavelength_um.back(), channel.name, first, last));
}

Spectrum spectrum_of(const ImportedLight& light, const std::vector<double>& values) {
  return {light.wavelength_um, values, radiometry::OutsideRange::extend, light.source};
}

}  // namespace

ImportedAtmosphere::ImportedAtmosphere(const ImportedLight& light, const Inputs& inputs)
    : has_sky_(!light.sky.empty()) {
  const std::vector<double> no_sky(light.wavelength_um.size(), 0.0);
  const Spectrum sun = spectrum_of(light, light.sun);
  std::vector<std::optional<std::size_t>> same;
  std::vector<radiometry::ChannelGrid> grids;
  for (std::size_t c = 0; c < inputs.channels.size(); ++c) {
    const Channel& channel = inputs.channels[c];
    same.push_back(same_channel(light, channel));
    if (same[c]) {
      grids.emplace_back(channel, Spectrum::constant(light.sun[*same[c]]));
      continue;
    }
    check_range(light, channel);
    if (!light.width_um.empty()) unmatched_.push_back(c);
    grids.emplace_back(channel, sun);
  }
  std::vector<Spectrum> factors(inputs.surfaces.begin(), inputs.surfaces.end());
  const bool integrated = std::any_of(same.begin(), same.end(), [](const auto& found) { return !found; });
  if (integrated) factors.push_back(spectrum_of(light, light.view));
  nodes_ = radiometry::SpectralNodes::build(grids, factors, inputs.demands);

  const auto fill = [&](const std::vector<double>& values, std::vector<double>& row, bool is_source) {
    const Spectrum spectrum = spectrum_of(light, values);
    row.assign(node_count(), 0.0);
    for (std::size_t c = 0; c < grids.size(); ++c) {
      const std::vector<double> at_points =
          same[c] ? std::vector<double>(grids[c].size(), values[*same[c]]) : grids[c].sampled(spectrum);
      const std::size_t first = nodes_.first_node(c);
      const std::span<double> at_nodes = std::span(row).subspan(first, nodes_.first_node(c + 1) - first);
      if (is_source)
        nodes_.average_source(c, at_points, at_nodes);
      else
        nodes_.average_factor(c, at_points, at_nodes);
    }
  };
  fill(light.sun, sun_, true);
  fill(has_sky_ ? light.sky : no_sky, sky_, true);
  fill(light.path, path_, true);
  fill(light.view, view_, false);
  fill(light.diffuse_transmittance, diffuse_transmittance_, false);
  fill(light.spherical_albedo, spherical_albedo_, false);
}

}  // namespace ifov::atmosphere
