#include "radiometry/spectrum.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "radiometry/gauss_legendre.h"
#include "radiometry/spectrum_walk.h"

namespace ifov::radiometry {
namespace {

std::string subject(const std::string& name) {
  return name.empty() ? std::string("a spectrum") : format("the spectrum '{}'", name);
}

}  // namespace

Spectrum Spectrum::constant(double value) {
  Spectrum spectrum;
  spectrum.values_[0] = value;
  return spectrum;
}

Spectrum::Spectrum(std::vector<double> wavelength_um, std::vector<double> values, OutsideRange outside,
                   std::string name)
    : wavelength_um_(std::move(wavelength_um)),
      values_(std::move(values)),
      outside_(outside),
      name_(std::move(name)) {
  if (wavelength_um_.empty() || wavelength_um_.size() != values_.size())
    throw InputError(
        format("{} needs as many values as wavelengths, at least one: found {} wavelengths and {} values",
               subject(name_), wavelength_um_.size(), values_.size()));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!std::isfinite(values_[i]) || !std::isfinite(wavelength_um_[i]) || wavelength_um_[i] <= 0.0)
      throw InputError(format("{} has an unusable point {}: wavelength {} um, value {}", subject(name_),
                              i + 1, wavelength_um_[i], values_[i]));
    if (i > 0 && wavelength_um_[i] <= wavelength_um_[i - 1])
      throw InputError(format("wavelengths of {} must increase: {} um is followed by {} um", subject(name_),
                              wavelength_um_[i - 1], wavelength_um_[i]));
  }
}

double Spectrum::at(double wavelength_um) const {
  if (is_constant()) return values_[0];
  const double first = wavelength_um_.front(), last = wavelength_um_.back();
  if (wavelength_um < first || wavelength_um > last) {
    if (outside_ == OutsideRange::zero) return 0.0;
    // A billionth of slack, so that an end which went through a change of units still belongs to the range.
    constexpr double kSlack = 1e-9;
    if (outside_ == OutsideRange::error &&
        (wavelength_um < first * (1.0 - kSlack) || wavelength_um > last * (1.0 + kSlack)))
      throw InputError(format("{} is given from {:g} to {:g} um and is needed at {:g} um", subject(name_),
                              first, last, wavelength_um));
    return wavelength_um < first ? values_.front() : values_.back();
  }
  const auto upper = std::upper_bound(wavelength_um_.begin(), wavelength_um_.end(), wavelength_um);
  if (upper == wavelength_um_.end()) return values_.back();
  const std::size_t i = static_cast<std::size_t>(upper - wavelength_um_.begin());
  const double share = (wavelength_um - wavelength_um_[i - 1]) / (wavelength_um_[i] - wavelength_um_[i - 1]);
  return values_[i - 1] + share * (values_[i] - values_[i - 1]);
}

double Spectrum::first_um() const {
  return is_constant() ? -std::numeric_limits<double>::infinity() : wavelength_um_.front();
}

double Spectrum::last_um() const {
  return is_constant() ? std::numeric_limits<double>::infinity() : wavelength_um_.back();
}

double Spectrum::maximum() const { return *std::max_element(values_.begin(), values_.end()); }
double Spectrum::minimum() const { return *std::min_element(values_.begin(), values_.end()); }

Spectrum Spectrum::mapped(const std::function<double(double)>& f) const {
  Spectrum result = *this;
  for (double& value : result.values_) value = f(value);
  return result;
}

Spectrum Spectrum::scaled(double factor) const {
  return mapped([factor](double value) { return factor * value; });
}

Spectrum Spectrum::complement() const {
  return mapped([](double value) { return 1.0 - value; });
}

Spectrum continued(const Spectrum& within, const Spectrum& beyond) {
  constexpr double kNext_um = 1e-6;
  const double first = within.first_um() - kNext_um, last = within.last_um() + kNext_um;
  std::vector<double> um, values;
  const auto add = [&](double at) {
    um.push_back(at);
    values.push_back(beyond.at(at));
  };
  const auto knows = [&](double at) {
    return beyond.is_constant() || beyond.outside() != radiometry::OutsideRange::error ||
           (beyond.first_um() <= at && at <= beyond.last_um());
  };
  for (const double at : beyond.wavelength_um())
    if (at < first) add(at);
  if (knows(first)) add(first);
  um.insert(um.end(), within.wavelength_um().begin(), within.wavelength_um().end());
  values.insert(values.end(), within.values().begin(), within.values().end());
  if (knows(last)) add(last);
  for (const double at : beyond.wavelength_um())
    if (at > last) add(at);
  return {std::move(um), std::move(values),
          beyond.is_constant() ? radiometry::OutsideRange::extend : beyond.outside(), within.name()};
}

Spectrum sum(const Spectrum& a, const Spectrum& b) {
  if (a.is_constant()) return b.mapped([&](double value) { return value + a.values().front(); });
  if (b.is_constant()) return sum(b, a);
  const Spectrum* const both[] = {&a, &b};
  CommonWavelengths common = common_wavelengths(both);
  if (common.um.empty()) return a;
  std::vector<double> values;
  for (const double um : common.um) values.push_back(a.at(um) + b.at(um));
  return {std::move(common.um), std::move(values), common.outside, a.name()};
}

CommonWavelengths common_wavelengths(std::span<const Spectrum* const> spectra) {
  CommonWavelengths common;
  double first_um = std::numeric_limits<double>::infinity(), last_um = -first_um, bound_first_um = last_um,
         bound_last_um = first_um;
  bool any = false, bounded = false;
  for (const Spectrum* s : spectra) {
    if (s->is_constant()) continue;
    if (!any) common.outside = s->outside();
    any = true;
    first_um = std::min(first_um, s->first_um());
    last_um = std::max(last_um, s->last_um());
    if (s->outside() != OutsideRange::error) continue;
    bounded = true;
    bound_first_um = std::max(bound_first_um, s->first_um());
    bound_last_um = std::min(bound_last_um, s->last_um());
  }
  if (bounded) {
    first_um = bound_first_um, last_um = bound_last_um;
    common.outside = OutsideRange::error;
  }
  if (any && first_um <= last_um) common.um = merged_wavelengths_um(spectra, first_um, last_um);
  return common;
}

Spectrum Spectrum::with_outside(OutsideRange outside) const {
  Spectrum result = *this;
  result.outside_ = outside;
  return result;
}

Spectrum Spectrum::with_name(std::string name) const {
  Spectrum result = *this;
  result.name_ = std::move(name);
  return result;
}

std::vector<double> merged_wavelengths_um(std::span<const Spectrum* const> spectra, double first_um,
                                          double last_um) {
  std::vector<double> merged{first_um, last_um};
  for (const Spectrum* spectrum : spectra) {
    const std::span<const double> um = spectrum->wavelength_um();
    const auto from = std::upper_bound(um.begin(), um.end(), first_um);
    merged.insert(merged.end(), from, std::lower_bound(from, um.end(), last_um));
  }
  std::sort(merged.begin(), merged.end());
  merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
  return merged;
}

double integral_of_product(std::span<const Spectrum* const> factors, double first_um, double last_um) {
  const std::vector<double> points = merged_wavelengths_um(factors, first_um, last_um);
  std::vector<SpectrumWalk> walks;
  for (const Spectrum* factor : factors) walks.emplace_back(*factor);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double width = points[i + 1] - points[i];
    for (const GaussPoint& gauss : kGauss4) {
      double product = gauss.weight * width;
      for (SpectrumWalk& walk : walks) product *= walk.at(points[i] + gauss.position * width);
      sum += product;
    }
  }
  return sum;
}

double integral(const Spectrum& spectrum, double first_um, double last_um) {
  const Spectrum* factors[] = {&spectrum};
  return integral_of_product(factors, first_um, last_um);
}

double weighted_mean(const Spectrum& spectrum, const Spectrum& weight) {
  const double total = weight.is_constant() ? 0.0 : integral(weight, weight.first_um(), weight.last_um());
  if (!(total > 0.0))
    throw InputError(
        format("{} cannot weigh a mean: it needs a range and a positive integral", subject(weight.name())));
  const Spectrum* factors[] = {&spectrum, &weight};
  return integral_of_product(factors, weight.first_um(), weight.last_um()) / total;
}

}  // namespace ifov::radiometry
