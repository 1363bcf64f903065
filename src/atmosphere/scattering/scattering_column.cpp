#include "atmosphere/scattering/scattering_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "atmosphere/scattering/layer_cuts.h"
#include "atmosphere/scattering/phase/phase_function.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {

namespace {

void check(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad, bool spherical) {
  const std::size_t n = optics.layers();
  if (n == 0 || levels.layers() != n || optics.rayleigh_scattering.size() != n ||
      optics.aerosol_scattering.size() != n || optics.aerosol_absorption.size() != n ||
      optics.aerosol_asymmetry.size() != n ||
      (optics.aerosol_phases &&
       optics.aerosol_phases->share.size() != n * optics.aerosol_phases->functions.size())) {
    throw std::invalid_argument("levels and layer optics must describe the same layers");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!(levels.altitude_km[i + 1] > levels.altitude_km[i])) {
      throw std::invalid_argument("altitudes of levels must rise");
    }
  }
  if (!(sun_zenith_rad >= 0.0 && sun_zenith_rad < (spherical ? kLowestSun_rad : 0.5 * std::numbers::pi))) {
    throw std::invalid_argument(spherical
                                    ? "the Sun must not be farther below the horizon than twilight lasts"
                                    : "the Sun must be above the horizon");
  }
}

/// Depth of sunbeams that the Earth is in the way of.
constexpr double kShadowDepth = 60.0;

/// sum += factor (a - b) from `first` on.
void add_difference(double factor, const std::vector<double>& a, const std::vector<double>& b,
                    std::size_t first, std::vector<double>& sum) {
  const double* __restrict left = a.data(), * __restrict right = b.data();
  double* __restrict to = sum.data();
  for (std::size_t k = first; k < sum.size(); ++k) to[k] += factor * (left[k] - right[k]);
}

/// The part of what a layer's aerosol scatters that delta-M takes for not scattered, and moments of the rest.
class ForwardPeaks {
 public:
  ForwardPeaks(const LayerOptics& optics, int terms) : optics_(optics), terms_(terms) {}
  struct Peak {
    double share = 0.0, first = 0.0, second = 0.0;
  };
  Peak of(std::size_t layer) {
    if (!optics_.aerosol_phases) {
      const double g = optics_.aerosol_asymmetry[layer];
      return without_peak(std::pow(std::abs(g), terms_), g, g * g);
    }
    const AerosolPhases& phases = *optics_.aerosol_phases;
    const double* share = phases.shares(layer);
    // Layers of one kind of haze follow each other, and a moment is an integral.
    if (last_ == nullptr || !std::equal(share, share + phases.functions.size(), last_)) {
      double sums[] = {0.0, 0.0, 0.0};
      for (std::size_t f = 0; f < phases.functions.size(); ++f)
        if (share[f] > 0.0)
          for (std::size_t k = 0; k < 3; ++k) sums[k] += share[f] * moments_of(f)[k];
      peak_ = without_peak(std::max(sums[0], 0.0), sums[1], sums[2]);
    }
    last_ = share;
    return peak_;
  }

 private:
  static Peak without_peak(double share, double first, double second) {
    if (!(share < 1.0)) return {share, 0.0, 0.0};
    return {share, (first - share) / (1.0 - share), (second - share) / (1.0 - share)};
  }
  /// The one that is cut off, the first and the second of a phase function: integrals, and layers mix the same few functions.
  const std::array<double, 3>& moments_of(std::size_t function) {
    const AerosolPhases& phases = *optics_.aerosol_phases;
    if (moments_.empty()) moments_.resize(phases.functions.size());
    std::optional<std::array<double, 3>>& known = moments_[function];
    const PhaseFunction& of = phases.functions[function];
    if (!known) known = {of.moment(terms_), of.moment(1), of.moment(2)};
    return *known;
  }
  const LayerOptics& optics_;
  int terms_;
  std::vector<std::optional<std::array<double, 3>>> moments_;
  const double* last_ = nullptr;
  Peak peak_;
};

}  // namespace

ScatteringColumn::ScatteringColumn(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                   const ScatteringOptions& options, std::span<const int> parts)
    : ScatteringColumn(levels, optics, sun_zenith_rad, options, parts, Detail::kSublayers) {}

ScatteringColumn ScatteringColumn::of_layers(const Levels& levels, const LayerOptics& optics,
                                             double sun_zenith_rad, const ScatteringOptions& options) {
  return {levels, optics, sun_zenith_rad, options, {}, Detail::kLayers};
}

ScatteringColumn::ScatteringColumn(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                   const ScatteringOptions& options, std::span<const int> given_parts,
                                   Detail detail)
    : spherical(options.spherical_earth),
      sun_mu(std::cos(sun_zenith_rad)),
      depolarization(optics.depolarization),
      phases(optics.aerosol_phases) {
  check(levels, optics, sun_zenith_rad, spherical);
  const std::size_t n = optics.layers();
  if (!given_parts.empty() && given_parts.size() != n)
    throw std::invalid_argument("every layer needs its number of parts");
  ForwardPeaks peaks(optics, 2 * options.nodes_per_hemisphere);
  std::vector<double> scaled(n), whole(n);  // extinction per km, top down
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t layer = n - 1 - i;
    const double height = levels.altitude_km[layer + 1] - levels.altitude_km[layer];
    const double rayleigh = optics.rayleigh_scattering[layer], aerosol = optics.aerosol_scattering[layer];
    const double absorbed = optics.gas_absorption[layer] + optics.aerosol_absorption[layer];
    const auto [peak, first, second] = peaks.of(layer);
    const double all = rayleigh + aerosol + absorbed, kept = all - peak * aerosol;
    const double inverse = kept > 0.0 ? 1.0 / kept : 0.0;
    mixtures.push_back(
        {rayleigh * inverse, aerosol * inverse, optics.aerosol_asymmetry[layer], peak, layer, first, second});
    scaled[i] = kept / height;
    whole[i] = all / height;
    layer_altitude_km.push_back(levels.altitude_km[layer + 1]);
    layer_depth.push_back(kept);
    layer_true_depth.push_back(all);
    if (detail == Detail::kLayers) continue;

    const double scattered = rayleigh + aerosol * (1.0 - peak);
    const double wanted = std::ceil((scattered + 0.1 * absorbed) / options.sublayer_depth);
    const int parts =
        given_parts.empty()
            ? static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(options.most_sublayers)))
            : given_parts[layer];
    const double top_km = levels.altitude_km[layer + 1];
    const double bend =
        spherical ? bend_of_cuts(top_km, levels.altitude_km[layer], kept, sun_zenith_rad) : 0.0;
    for (int part = 0; part < parts; ++part) {
      const double from = place_of_cut(part, parts, bend), to = place_of_cut(part + 1, parts, bend);
      altitude_km.push_back(top_km - height * from);
      depth.push_back(kept * (to - from));
      true_depth.push_back(all * (to - from));
      mixture_of.push_back(i);
    }
  }
  layer_altitude_km.push_back(levels.altitude_km[0]);
  if (detail == Detail::kLayers) return;
  altitude_km.push_back(levels.altitude_km[0]);
  add_beams(levels, scaled, whole);
}

void ScatteringColumn::add_beams(const Levels& levels, const std::vector<double>& scaled,
                                 const std::vector<double>& whole) {
  // Layer by layer, for all boundaries below its top at once: the length of the sunbeam that arrives there
  // from the layer's top, less that from its bottom.
  const std::size_t boundaries = altitude_km.size();
  beam_depth.assign(boundaries, 0.0);
  true_beam_depth.assign(boundaries, 0.0);
  std::vector<double> from_top(boundaries), from_bottom(boundaries);
  beam_lengths(altitude_km.front(), from_top, 0);
  for (std::size_t i = 0, first = 1; i < scaled.size(); ++i) {
    const double bottom_km = levels.altitude_km[scaled.size() - 1 - i];
    if (sun_mu < 0.0) first = 0;  // beams from below cross layers under the place where they end
    beam_lengths(bottom_km, from_bottom, first);
    add_difference(scaled[i], from_top, from_bottom, first, beam_depth);
    add_difference(whole[i], from_top, from_bottom, first, true_beam_depth);
    std::swap(from_top, from_bottom);
    while (first < boundaries && altitude_km[first] >= bottom_km) ++first;
  }
  if (sun_mu < 0.0) {
    const double sine = std::sqrt(1.0 - sun_mu * sun_mu);
    for (std::size_t k = 0; k < boundaries; ++k)
      if ((kEarthRadius_km + altitude_km[k]) * sine < kEarthRadius_km + altitude_km.back())
        beam_depth[k] = true_beam_depth[k] = kShadowDepth;
  }
}

/// Lengths of the sunbeams that arrive at the boundaries from `first` on, from a level above: what
/// length_to_shell_km says, without a branch, for many at once. 0 at boundaries above the level.
void ScatteringColumn::beam_lengths(double level_km, std::vector<double>& lengths, std::size_t first) const {
  const double* __restrict from = altitude_km.data();
  double* __restrict to = lengths.data();
  if (!spherical) {
    for (std::size_t k = first; k < lengths.size(); ++k)
      to[k] = (std::max(from[k], level_km) - from[k]) / sun_mu;
    return;
  }
  if (sun_mu < 0.0) {
    // Of the way within the level's sphere, by half chords about the beam's point nearest to the Earth's centre.
    const double sine = std::sqrt(1.0 - sun_mu * sun_mu), shell = kEarthRadius_km + level_km;
    for (std::size_t k = first; k < lengths.size(); ++k) {
      const double start = kEarthRadius_km + from[k], half = half_chord_km(shell, start * sine);
      to[k] = level_km > from[k] ? half - start * sun_mu : 2.0 * half;
    }
    return;
  }
  for (std::size_t k = first; k < lengths.size(); ++k) {
    const double level = std::max(from[k], level_km), start = kEarthRadius_km + from[k];
    const double along = start * sun_mu, squares = (level - from[k]) * (start + kEarthRadius_km + level);
    to[k] = squares / (std::sqrt(squares + along * along) + along);
  }
}

}  // namespace ifov::atmosphere
