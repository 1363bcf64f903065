#include "atmosphere/scattering/shell_line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "atmosphere/scattering/phase/scattering_matrix.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {
namespace {

/// A layer is cut where the beam's depth bends within it: where the Sun is lower than this cosine.
constexpr double kLowSunCosine = 0.25;
constexpr int kLowSunParts = 4;

/// Lengths from the lower end at which the line enters and leaves the Earth's shadow, a cylinder; those that count are
/// behind the Earth. `along`: cosine between the line and the direction to the Sun.
void add_shadow_edges(double start, double mu, double sun_mu, double along, double earth, double length,
                      std::vector<double>& at) {
  const double a = 1.0 - along * along, b = start * (mu - sun_mu * along),
               c = start * start * (1.0 - sun_mu * sun_mu) - earth * earth, square = b * b - a * c;
  if (!(a > 0.0) || !(square > 0.0)) return;
  for (const double root : {(-b - std::sqrt(square)) / a, (-b + std::sqrt(square)) / a})
    if (root > 0.0 && root < length && start * sun_mu + root * along < 0.0) at.push_back(root);
}

}  // namespace

ShellLineOfSight::ShellLineOfSight(std::span<const double> altitude_km, bool spherical, double sun_mu,
                                   const Propagation& direction, const Ends& ends, bool sunbeams)
    : spherical_(spherical),
      altitude_km_(altitude_km.begin(), altitude_km.end()),
      direction_(direction),
      scattering_cosine_(atmosphere::scattering_cosine({-sun_mu, 0.0}, direction)) {
  const double lower = std::max(ends.lower_km, altitude_km.back()),
               upper = std::min(ends.upper_km, altitude_km.front()), mu = std::abs(direction.mu);
  const bool looks_up = direction.mu <= 0.0;
  if (!(upper > lower)) return;
  // Cosine between the line, from its lower end up, and the direction to the Sun.
  const double towards = looks_up ? scattering_cosine_ : -scattering_cosine_;
  const double start = kEarthRadius_km + lower, earth = kEarthRadius_km + altitude_km.back();
  start_ = start, rise_ = mu, sun_at_start_ = sun_mu, towards_ = towards;
  const auto length_to = [&](double shell_km) {
    return spherical ? length_to_shell_km(lower, mu, shell_km) : (shell_km - lower) / mu;
  };
  const auto radius_at = [&](double length) {
    return std::sqrt(start * start + length * (length + 2.0 * start * mu));
  };
  const auto sun_at = [&](double length) {
    return spherical ? std::clamp((start * sun_mu + length * towards) / radius_at(length), -1.0, 1.0)
                     : sun_mu;
  };

  // From the lower end up: where the line crosses into the next layer, and places between.
  std::vector<double> at{0.0}, place_km{lower}, shadow, cuts;
  std::vector<std::size_t> layer;
  if (spherical && sunbeams) add_shadow_edges(start, mu, sun_mu, towards, earth, length_to(upper), shadow);
  const auto above = std::lower_bound(altitude_km.begin(), altitude_km.end(), lower, std::greater<>());
  const std::size_t most = static_cast<std::size_t>(above - altitude_km.begin()) + 1;
  at.reserve(most), place_km.reserve(most), layer.reserve(most);
  sun_mu_.push_back(sun_at(0.0));
  for (std::ptrdiff_t k = above - altitude_km.begin() - 1; k >= 0 && place_km.back() < upper; --k) {
    const double top = std::min(upper, altitude_km[static_cast<std::size_t>(k)]), from = at.back(),
                 to = length_to(top), sun_above = sun_at(to);
    const auto cross = [&](double cut, double place, double sun) {
      at.push_back(cut);
      place_km.push_back(place);
      sun_mu_.push_back(sun);
      layer.push_back(static_cast<std::size_t>(k));
    };
    cuts.clear();
    if (spherical && sunbeams && std::min(sun_mu_.back(), sun_above) < kLowSunCosine)
      for (int part = 1; part < kLowSunParts; ++part)
        cuts.push_back(from + (to - from) * part / kLowSunParts);
    for (const double edge : shadow)
      if (edge > from && edge < to) cuts.push_back(edge);
    std::sort(cuts.begin(), cuts.end());
    for (const double cut : cuts) {
      if (cut >= to) break;
      cross(cut, spherical ? radius_at(cut) - kEarthRadius_km : lower + cut * mu, sun_at(cut));
    }
    cross(to, top, sun_above);
  }

  for (const double length : at)
    from_mu_.push_back((looks_up ? 1.0 : -1.0) *
                       (spherical ? (start * mu + length) / radius_at(length) : mu));
  for (std::size_t p = 0; p < layer.size(); ++p) {
    const double top = altitude_km[layer[p]], thickness = top - altitude_km[layer[p] + 1];
    // Between places where the Sun is up it is up.
    bool lit = !spherical || std::min(sun_mu_[p], sun_mu_[p + 1]) >= 0.0;
    if (!lit) {
      const double middle = 0.5 * (at[p] + at[p + 1]), sun = sun_at(middle);
      lit = sun >= 0.0 || radius_at(middle) * std::sqrt(1.0 - sun * sun) >= earth;
    }
    pieces_.push_back({layer[p], (top - place_km[p]) / thickness, (top - place_km[p + 1]) / thickness,
                       (at[p + 1] - at[p]) / thickness, lit});
  }
  if (!looks_up) {
    std::reverse(pieces_.begin(), pieces_.end());
    for (Piece& piece : pieces_) std::swap(piece.near_position, piece.far_position);
    std::reverse(sun_mu_.begin(), sun_mu_.end());
    std::reverse(from_mu_.begin(), from_mu_.end());
    std::reverse(place_km.begin(), place_km.end());
    std::reverse(at.begin(), at.end());
  }
  length_ = std::move(at);
  if (sunbeams) add_beams(place_km);
}

bool ShellLineOfSight::bends() const {
  constexpr double kLow = 0.1;
  return spherical_ && !sun_mu_.empty() && *std::min_element(sun_mu_.begin(), sun_mu_.end()) < kLow;
}

template <class Add>
void ShellLineOfSight::beam_slants(double radius, double mu, const Add& add) const {
  const double place = radius - kEarthRadius_km;
  const double nearest = std::max(radius * std::sqrt(std::max(0.0, 1.0 - mu * mu)),
                                  mu < 0.0 ? kEarthRadius_km + altitude_km_.back() : 0.0);
  const auto chord = [&](double altitude) { return half_chord_km(kEarthRadius_km + altitude, nearest); };
  const double here = half_chord_km(radius, nearest);
  double above = chord(altitude_km_.front());
  for (std::size_t k = 0; k + 1 < altitude_km_.size(); ++k) {
    const double thickness = altitude_km_[k] - altitude_km_[k + 1];
    if (!spherical_) {
      add(k, std::clamp((altitude_km_[k] - place) / thickness, 0.0, 1.0) / mu);
      continue;
    }
    const double below = chord(altitude_km_[k + 1]);
    const double ahead = std::max(0.0, above - (mu < 0.0 ? below : std::max(here, below)));
    const double back = mu < 0.0 ? std::max(0.0, std::min(here, above) - below) : 0.0;
    add(k, (ahead + back) / thickness);
    above = below;
  }
}

void ShellLineOfSight::add_beams(std::span<const double> place_km) {
  const std::size_t layers = altitude_km_.size() - 1, places = place_km.size();
  sun_slant_.assign(layers * places, 0.0);
  if (spherical_ && *std::min_element(sun_mu_.begin(), sun_mu_.end()) >= 0.0) {
    add_beams_from_above(place_km);
    return;
  }
  for (std::size_t e = 0; e < places; ++e)
    beam_slants(kEarthRadius_km + place_km[e], sun_mu_[e],
                [&](std::size_t k, double slant) { sun_slant_[k * places + e] = slant; });
}

/// What beam_slants() says where the Sun is up at every place, shell by shell for all places at once.
void ShellLineOfSight::add_beams_from_above(std::span<const double> place_km) {
  const std::size_t layers = altitude_km_.size() - 1, places = place_km.size();
  std::vector<double> nearest(places), here(places), above(places);
  for (std::size_t e = 0; e < places; ++e) {
    const double radius = kEarthRadius_km + place_km[e];
    nearest[e] = radius * std::sqrt(std::max(0.0, 1.0 - sun_mu_[e] * sun_mu_[e]));
    here[e] = half_chord_km(radius, nearest[e]);
    above[e] = half_chord_km(kEarthRadius_km + altitude_km_.front(), nearest[e]);
  }
  const double* __restrict from = nearest.data(), * __restrict start = here.data();
  double* __restrict upper = above.data();
  crossing_.assign(layers, {0, places});
  const bool rises = place_km.front() < place_km.back();
  for (std::size_t k = 0; k < layers; ++k) {
    if (k > 0) crossing_[k] = crossing_[k - 1];
    auto& [first, last] = crossing_[k];
    if (rises)
      while (last > first && place_km[last - 1] >= altitude_km_[k]) --last;
    else
      while (first < last && place_km[first] >= altitude_km_[k]) ++first;
    const double shell = kEarthRadius_km + altitude_km_[k + 1],
                 thickness = altitude_km_[k] - altitude_km_[k + 1];
    double* __restrict slant = sun_slant_.data() + k * places;
    for (std::size_t e = first; e < last; ++e) {
      // half_chord_km() without a branch
      const double below = std::sqrt(std::max(0.0, (shell - from[e]) * (shell + from[e])));
      slant[e] = std::max(0.0, upper[e] - std::max(start[e], below)) / thickness;
      upper[e] = below;
    }
  }
}

double ShellLineOfSight::beam_depth_within(std::size_t piece, double share,
                                           std::span<const double> depth) const {
  const double length = (1.0 - share) * length_[piece] + share * length_[piece + 1];
  const double radius = spherical_ ? std::sqrt(start_ * start_ + length * (length + 2.0 * start_ * rise_))
                                   : start_ + length * rise_;
  const double mu = spherical_ ? std::clamp((start_ * sun_at_start_ + length * towards_) / radius, -1.0, 1.0)
                               : sun_at_start_;
  double sum = 0.0;
  beam_slants(radius, mu, [&](std::size_t k, double slant) { sum += depth[k] * slant; });
  return sum;
}

std::vector<double> ShellLineOfSight::beam_depths(std::span<const double> depth) const {
  const std::size_t places = sun_mu_.size();
  std::vector<double> sum(places, 0.0);
  for (std::size_t k = 0; k < depth.size(); ++k) {
    const double* __restrict slant = sun_slant_.data() + k * places;
    double* __restrict to = sum.data();
    const Range range = crossing_.empty() ? Range{0, places} : crossing_[k];
    for (std::size_t e = range.first; e < range.last; ++e) to[e] += depth[k] * slant[e];
  }
  return sum;
}

}  // namespace ifov::atmosphere
