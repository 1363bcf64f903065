#include "radiometry/channel_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "radiometry/gauss_legendre.h"
#include "radiometry/planck.h"
#include "radiometry/spectrum_walk.h"

namespace ifov::radiometry {
namespace {

constexpr double kIntervals = 128.0;   // of the whole range, at least
constexpr double kWidestShare = 0.03;  // of a step, of its wavelength
/// Relative error of a surface's mean from which on its own points are taken in; and the mean below which it is
/// relative to this.
constexpr double kUnresolved = 5e-5, kDarkSurface = 1e-2;
// So dark that no sensor sees it, but keeps the reference from vanishing where there is neither Sun nor heat.
constexpr double kDarkest_w_m2_sr_um = 1e-6;
constexpr double kClosest =
    1e-3;  // of a channel's width: how close points of a surface may be for sums of moments
/// Radiance that is hidden altogether counts this much still: it lights what is seen.
constexpr double kLeastSeen = 1e-3;

double reference_radiance(double wavelength_um, double irradiance) {
  return irradiance / std::numbers::pi + planck_w_m2_sr_um(wavelength_um, 300.0) + kDarkest_w_m2_sr_um;
}

}  // namespace

std::vector<double> integration_steps_um(const std::vector<double>& points_um) {
  const double first = points_um.front(), last = points_um.back();
  const double widest = (last - first) / kIntervals;
  std::vector<double> coarse = points_um;
  if (kWidestShare * first < widest) {
    for (double x = first; kWidestShare * x < widest && x < last; x *= 1.0 + kWidestShare)
      coarse.push_back(x);
    std::sort(coarse.begin(), coarse.end());
    coarse.erase(std::unique(coarse.begin(), coarse.end()), coarse.end());
  }
  std::vector<double> steps{coarse.front()};
  for (std::size_t i = 0; i + 1 < coarse.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil((coarse[i + 1] - coarse[i]) / (last - first) * kIntervals)));
    const double width = (coarse[i + 1] - coarse[i]) / parts;
    for (int part = 1; part < parts; ++part) steps.push_back(coarse[i] + part * width);
    steps.push_back(coarse[i + 1]);
  }
  return steps;
}

void ChannelGrid::place_points(const Channel& channel, std::span<const Spectrum* const> spectra) {
  wavelength_um.clear();
  response.clear();
  const std::vector<double> steps = integration_steps_um(
      merged_wavelengths_um(spectra, channel.response.first_um(), channel.response.last_um()));
  double total = 0.0;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    for (const GaussPoint& gauss : kGauss2) {
      const double x = steps[i] + gauss.position * (steps[i + 1] - steps[i]);
      const double weight = gauss.weight * (steps[i + 1] - steps[i]) * channel.response.at(x);
      if (weight == 0.0) continue;
      wavelength_um.push_back(x);
      response.push_back(weight);
      total += weight;
    }
  for (double& weight : response) weight /= total;
}

/// Whether sums over the points are the integrals of the light that a surface reflects once and twice. Between its own points
/// a surface is linear, so that both follow from moments of response and light, summed up once for all surfaces.
class ChannelGrid::Resolution {
 public:
  Resolution(const ChannelGrid& grid, const Channel& channel, const Spectrum& light)
      : grid_(grid),
        response_(channel.response),
        light_(light),
        first_um_(response_.first_um()),
        last_um_(response_.last_um()),
        middle_um_(0.5 * (first_um_ + last_um_)) {
    const Spectrum* factors[] = {&response_, &light_};
    whole_ = integral_of_product(std::span(factors).first(1), first_um_, last_um_);
    ends_um_ = merged_wavelengths_um(factors, first_um_, last_um_);
    integrals_.emplace_back();
    for (std::size_t i = 0; i + 1 < ends_um_.size(); ++i)
      integrals_.push_back(integrals_.back() + between(ends_um_[i], ends_um_[i + 1]));
    const std::vector<double> lit = grid.sampled(light);
    sums_.emplace_back();
    for (std::size_t q = 0; q < grid.size(); ++q)
      sums_.push_back(sums_.back() +
                      Moments::of(grid.wavelength_um[q] - middle_um_, grid.response[q] * lit[q]));
  }

  bool resolves(const Spectrum& surface) {
    Reflected exact, sum;
    if (surface.first_um() <= first_um_ && surface.last_um() >= last_um_ && place_knots(surface))
      add_by_moments(surface, exact, sum);
    else
      add_by_points(surface, exact, sum);
    const double dark = kDarkSurface * sums_.back().power[0];
    const auto right = [&](double found, double integral) {
      return std::abs(found - integral / whole_) <= kUnresolved * std::max(integral / whole_, dark);
    };
    return right(sum.once, exact.once) && right(sum.twice, exact.twice);
  }

 private:
  /// Of wavelength less the channel's middle, powers 0 to 2.
  struct Moments {
    std::array<double, 3> power{};
    static Moments of(double distance, double weight) {
      return {{weight, weight * distance, weight * distance * distance}};
    }
    Moments operator+(const Moments& other) const { return added(other, 1.0); }
    Moments operator-(const Moments& other) const { return added(other, -1.0); }
    Moments added(const Moments& other, double times) const {
      Moments all = *this;
      for (std::size_t k = 0; k < 3; ++k) all.power[k] += times * other.power[k];
      return all;
    }
  };
  struct Reflected {
    double once = 0.0, twice = 0.0;
    void add(const Moments& of, double at_middle, double slope) {
      once += at_middle * of.power[0] + slope * of.power[1];
      twice += at_middle * at_middle * of.power[0] + 2.0 * at_middle * slope * of.power[1] +
               slope * slope * of.power[2];
    }
  };

  /// Of response times light, both of which are linear between these.
  Moments between(double from_um, double to_um) const {
    Moments sum;
    const double width = to_um - from_um;
    for (const GaussPoint& gauss : kGauss4) {
      const double um = from_um + gauss.position * width;
      sum = sum + Moments::of(um - middle_um_, gauss.weight * width * response_.at(um) * light_.at(um));
    }
    return sum;
  }

  void add_by_moments(const Spectrum& surface, Reflected& exact, Reflected& sum) const {
    SpectrumWalk reflectance(surface);
    double value = reflectance.at(knots_um_.front());
    for (std::size_t k = 0; k + 1 < knots_um_.size(); ++k) {
      const double next = reflectance.at(knots_um_[k + 1]);
      const double slope = (next - value) / (knots_um_[k + 1] - knots_um_[k]);
      const double at_middle = value - slope * (knots_um_[k] - middle_um_);
      exact.add(integrals_at_[k + 1] - integrals_at_[k], at_middle, slope);
      sum.add(sums_at_[k + 1] - sums_at_[k], at_middle, slope);
      value = next;
    }
  }

  /// The same of a spectrum that ends within the channel, or whose points are too close for differences of sums.
  void add_by_points(const Spectrum& surface, Reflected& exact, Reflected& sum) const {
    const std::vector<double> at_points = grid_.sampled(surface);
    for (std::size_t q = 0; q < at_points.size(); ++q) sum.add(sums_[q + 1] - sums_[q], at_points[q], 0.0);
    const Spectrum* factors[] = {&response_, &light_, &surface, &surface};
    exact.once = integral_of_product(std::span(factors).first(3), first_um_, last_um_);
    exact.twice = integral_of_product(factors, first_um_, last_um_);
  }

  /// Neighbours are often spectra at the same wavelengths: reflectances of one model by angle. False: they are too close.
  bool place_knots(const Spectrum& surface) {
    const Spectrum* const alone = &surface;
    std::vector<double> knots_um = merged_wavelengths_um({&alone, 1}, first_um_, last_um_);
    if (knots_um == knots_um_) return apart_;
    knots_um_ = std::move(knots_um);
    apart_ = true;
    for (std::size_t k = 0; k + 1 < knots_um_.size(); ++k)
      apart_ = apart_ && knots_um_[k + 1] - knots_um_[k] > kClosest * (last_um_ - first_um_);
    integrals_at_.clear();
    sums_at_.clear();
    for (const double um : knots_um_) {
      const auto end = std::upper_bound(ends_um_.begin(), ends_um_.end(), um) - 1;
      const auto below = static_cast<std::size_t>(end - ends_um_.begin());
      integrals_at_.push_back(integrals_[below] + between(*end, um));
      sums_at_.push_back(sums_[static_cast<std::size_t>(
          std::lower_bound(grid_.wavelength_um.begin(), grid_.wavelength_um.end(), um) -
          grid_.wavelength_um.begin())]);
    }
    return apart_;
  }

  const ChannelGrid& grid_;
  const Spectrum &response_, &light_;
  double first_um_, last_um_, middle_um_, whole_ = 0.0;
  std::vector<double> ends_um_;     // between which response and light are linear
  std::vector<Moments> integrals_;  // up to each of these
  std::vector<Moments> sums_;       // over the points before each
  std::vector<double> knots_um_;    // of the surface that was asked for last
  std::vector<Moments> integrals_at_, sums_at_;
  bool apart_ = true;
};

ChannelGrid::ChannelGrid(const Channel& channel, const Spectrum& solar_irradiance,
                         std::span<const Spectrum> surfaces, const Spectrum* sky_radiance,
                         std::span<const Spectrum> lamps) {
  if (channel.is_monochromatic()) {
    wavelength_um = {channel.centre_um};
    response = {1.0};
  } else {
    std::vector<const Spectrum*> spectra{&channel.response, &solar_irradiance};
    if (sky_radiance != nullptr) spectra.push_back(sky_radiance);
    for (const Spectrum& lamp : lamps) spectra.push_back(&lamp);
    place_points(channel, spectra);
    const std::size_t lights = spectra.size();
    const Spectrum even = Spectrum::constant(1.0);
    std::vector<Resolution> under{{*this, channel, even}, {*this, channel, solar_irradiance}};
    if (sky_radiance != nullptr) under.emplace_back(*this, channel, *sky_radiance);
    for (const Spectrum& lamp : lamps) under.emplace_back(*this, channel, lamp);
    for (const Spectrum& surface : surfaces) {
      if (surface.is_constant()) continue;
      if (!std::all_of(under.begin(), under.end(),
                       [&](Resolution& light) { return light.resolves(surface); }))
        spectra.push_back(&surface);
    }
    if (spectra.size() > lights) place_points(channel, spectra);
  }
  irradiance = sampled(solar_irradiance);
  if (sky_radiance != nullptr) {
    sky = sampled(*sky_radiance);
    for (std::size_t q = 0; q < size(); ++q) irradiance[q] += sky[q] *= std::numbers::pi;
  }
  for (std::size_t q = 0; q < size(); ++q)
    bright.push_back(reference_radiance(wavelength_um[q], irradiance[q]));
  reference = bright;
}

ChannelGrid::ChannelGrid(std::vector<double> wavelengths_um, std::vector<double> shares,
                         std::vector<double> irradiances, std::vector<double> skies,
                         std::vector<double> transmittances, double least)
    : wavelength_um(std::move(wavelengths_um)),
      response(std::move(shares)),
      irradiance(std::move(irradiances)),
      sky(std::move(skies)),
      least_radiance(least),
      seen(std::move(transmittances)) {
  const double total = std::accumulate(response.begin(), response.end(), 0.0);
  for (double& weight : response) weight /= total;
  for (std::size_t q = 0; q < size(); ++q) {
    bright.push_back(reference_radiance(wavelength_um[q], irradiance[q]));
    reference.push_back(std::max(kLeastSeen, seen[q]) * bright[q]);
  }
}

std::vector<double> ChannelGrid::sampled(const Spectrum& spectrum) const {
  std::vector<double> values(size());
  sample(spectrum, wavelength_um, values);
  return values;
}

}  // namespace ifov::radiometry
