#include "materials/bsdf/microfacet/fresnel_rows.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "radiometry/fresnel.h"

namespace ifov::materials {
namespace {

using radiometry::Spectrum;

/// What is told at the angles: an element of Fresnel's matrix.
using Element = double (*)(const radiometry::FresnelAmplitudes& r);

double unpolarized(const radiometry::FresnelAmplitudes& r) { return 0.5 * (std::norm(r.p) + std::norm(r.s)); }
constexpr Element kUnpolarized[] = {unpolarized};
constexpr Element kPolarization[] = {
    [](const radiometry::FresnelAmplitudes& r) { return 0.5 * (std::norm(r.p) - std::norm(r.s)); },
    [](const radiometry::FresnelAmplitudes& r) { return (r.p * std::conj(r.s)).real(); },
    [](const radiometry::FresnelAmplitudes& r) { return (r.p * std::conj(r.s)).imag(); }};

struct Index {
  const Spectrum &n, &k;
  std::complex<double> at(double um) const { return {n.at(um), k.at(um)}; }
};

bool is_straight(const Index& index, std::span<const Element> elements, double first_um, double last_um) {
  constexpr double kWithin = 2e-4;
  for (const double cosine : {1.0, 0.5, 0.15}) {
    const auto at = [&](double um) {
      return radiometry::fresnel_reflection_amplitudes(index.at(um), cosine);
    };
    const auto middle = at(0.5 * (first_um + last_um)), first = at(first_um), last = at(last_um);
    for (const Element element : elements)
      if (std::abs(element(middle) - 0.5 * (element(first) + element(last))) > kWithin) return false;
  }
  return true;
}

/// Adds what lies between the two, but not their first.
void add_between(const Index& index, std::span<const Element> elements, double first_um, double last_um,
                 int halvings, std::vector<double>& um) {
  if (halvings > 0 && !is_straight(index, elements, first_um, last_um)) {
    const double middle = 0.5 * (first_um + last_um);
    add_between(index, elements, first_um, middle, halvings - 1, um);
    add_between(index, elements, middle, last_um, halvings - 1, um);
  } else {
    um.push_back(last_um);
  }
}

/// FresnelRows::kCount rows of each element.
std::vector<Spectrum> rows_of_index(const Spectrum& n, const Spectrum& k, std::span<const Element> elements) {
  constexpr int kHalvings = 6;
  const Index index{n, k};
  const Spectrum* const both[] = {&n, &k};
  const radiometry::CommonWavelengths common = radiometry::common_wavelengths(both);
  std::vector<double> um;
  if (!common.um.empty()) um.push_back(common.um.front());
  for (std::size_t i = 1; i < common.um.size(); ++i)
    add_between(index, elements, common.um[i - 1], common.um[i], kHalvings, um);
  const std::string& name = n.is_constant() ? k.name() : n.name();
  std::vector<Spectrum> rows;
  for (const Element element : elements)
    for (std::size_t row = 0; row < FresnelRows::kCount; ++row) {
      const auto at = [&](std::complex<double> m) {
        return element(radiometry::fresnel_reflection_amplitudes(m, FresnelRows::cosine(row)));
      };
      if (um.empty()) {
        rows.push_back(Spectrum::constant(at({n.values()[0], k.values()[0]})));
        continue;
      }
      std::vector<double> values;
      for (const double wavelength : um) values.push_back(at(index.at(wavelength)));
      rows.emplace_back(um, std::move(values), common.outside, name);
    }
  return rows;
}

}  // namespace

double FresnelRows::cosine(std::size_t row) {
  const double t = static_cast<double>(row) / static_cast<double>(kCount - 1);
  return t * t * t;
}

std::vector<Spectrum> FresnelRows::of_index(const Spectrum& n, const Spectrum& k) {
  return rows_of_index(n, k, kUnpolarized);
}

std::vector<Spectrum> FresnelRows::polarization_of_index(const Spectrum& n, const Spectrum& k) {
  return rows_of_index(n, k, kPolarization);
}

Spectrum combined(std::span<const Spectrum> spectra,
                  const std::function<double(std::span<const double>)>& f) {
  std::vector<const Spectrum*> pointers;
  for (const Spectrum& spectrum : spectra) pointers.push_back(&spectrum);
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(pointers);
  std::vector<double> values(spectra.size()), found;
  const auto add = [&](double um) {
    for (std::size_t k = 0; k < spectra.size(); ++k) values[k] = spectra[k].at(um);
    found.push_back(f(values));
  };
  if (common.um.empty()) {
    add(1.0);
    return Spectrum::constant(found[0]);
  }
  for (const double um : common.um) add(um);
  return {std::move(common.um), std::move(found), common.outside, spectra.front().name()};
}

RowWeights FresnelRows::at(double cosine) {
  return cubic_weights(std::cbrt(std::clamp(cosine, 0.0, 1.0)) * static_cast<double>(kCount - 1), kCount);
}

const std::array<double, FresnelRows::kCount>& FresnelRows::mean_weights() {
  // Simpson's rule in t = cbrt cos, 2 cos d cos = 6 t^5 dt, scaled so that they sum to 1.
  static const std::array<double, kCount> weights = [] {
    std::array<double, kCount> found{};
    double sum = 0.0;
    for (std::size_t row = 0; row < kCount; ++row) {
      const double t = static_cast<double>(row) / static_cast<double>(kCount - 1);
      const double simpson = row == 0 || row == kCount - 1 ? 1.0 : row % 2 == 1 ? 4.0 : 2.0;
      sum += found[row] = simpson * t * t * t * t * t;
    }
    for (double& weight : found) weight /= sum;
    return found;
  }();
  return weights;
}

}  // namespace ifov::materials
