#include "materials/bsdf/leaf/prospect.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ifov::data {
extern const std::string_view leaf_prospect;
}

namespace ifov::materials {

using radiometry::Spectrum;

namespace {

struct Coefficients {
  double um;
  double index_5, chlorophyll_5, carotenoids_5;
  double index, chlorophyll, carotenoids, anthocyanins;
  double brown, water, dry_matter, proteins, carbon;
};

const std::vector<Coefficients>& coefficients() {
  static const std::vector<Coefficients> table = [] {
    std::vector<Coefficients> rows;
    std::istringstream lines{std::string(data::leaf_prospect)};
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      Coefficients c{};
      double nm = 0.0;
      if (!(words >> nm >> c.index_5 >> c.chlorophyll_5 >> c.carotenoids_5 >> c.index >> c.chlorophyll >>
            c.carotenoids >> c.anthocyanins >> c.brown >> c.water >> c.dry_matter >> c.proteins >> c.carbon))
        continue;
      c.um = nm * 1e-3;
      rows.push_back(c);
    }
    return rows;
  }();
  return table;
}

/// Transmittance of an absorbing plate for light from all sides: (1 - k) exp(-k) + k^2 E1(k).
double diffuse_transmittance(double k) {
  return k > 1e-12 ? (1.0 - k) * std::exp(-k) - k * k * std::expint(-k) : 1.0;
}

}  // namespace

double cone_transmittance(double index, double half_angle_rad) {
  const double sine = std::sin(half_angle_rad), s2 = sine * sine;
  const double n2 = index * index, p = n2 + 1.0, q = n2 - 1.0;
  const double a = 0.5 * (index + 1.0) * (index + 1.0), k = -0.25 * q * q, half = s2 - 0.5 * p;
  const double b = std::sqrt(std::max(0.0, half * half + k)) - half;
  const auto across = [&](double x) { return k * k / (6.0 * x * x * x) + k / x - 0.5 * x; };
  const double along_a = 2.0 * p * a - q * q, along_b = 2.0 * p * b - q * q;
  const double within = -2.0 * n2 * (b - a) / (p * p) - 2.0 * n2 * p * std::log(b / a) / (q * q) +
                        0.5 * n2 * (1.0 / b - 1.0 / a) +
                        16.0 * n2 * n2 * (n2 * n2 + 1.0) * std::log(along_b / along_a) / (p * p * p * q * q) +
                        16.0 * n2 * n2 * n2 * (1.0 / along_b - 1.0 / along_a) / (p * p * p);
  return (across(b) - across(a) + within) / (2.0 * s2);
}

PlateOptics plates(double index, double depth, double layers, double half_angle_rad) {
  const double tau = diffuse_transmittance(depth);
  const double into = cone_transmittance(index, 0.5 * std::numbers::pi),
               from_cone = cone_transmittance(index, half_angle_rad);
  const double out = into / (index * index), kept = 1.0 - out, between = 1.0 - kept * kept * tau * tau;
  // The first plate, lit from the cone, then one that is lit from all sides.
  const double first_t = from_cone * tau * out / between, first_r = 1.0 - from_cone + kept * tau * first_t;
  const double t = into * tau * out / between, r = 1.0 - into + kept * tau * t;
  // Stokes 1862: layers - 1 of the latter.
  double more_r = 0.0, more_t = 1.0;
  const double whole = r + t;
  if (layers > 1.0 && whole < 1.0 - 1e-12) {
    const double d = std::sqrt((1.0 + whole) * (1.0 + r - t) * (1.0 - r + t) * (1.0 - whole));
    const double x = (1.0 + r * r - t * t + d) / (2.0 * r), y = (1.0 - r * r + t * t + d) / (2.0 * t);
    // In powers of 1 / y, which does not overflow where next to nothing passes.
    const double z = std::pow(y, 1.0 - layers), below = x * x - z * z;
    more_r = x * (1.0 - z * z) / below;
    more_t = z * (x * x - 1.0) / below;
  } else if (layers > 1.0) {
    more_t = t / (t + (1.0 - t) * (layers - 1.0));
    more_r = 1.0 - more_t;
  }
  const double to_and_fro = 1.0 - more_r * r;
  return {first_r + first_t * more_r * t / to_and_fro, first_t * more_t / to_and_fro, 1.0 - from_cone};
}

LeafOptics prospect(ProspectVersion version, const LeafContents& leaf) {
  constexpr double kCone = 40.0 * std::numbers::pi / 180.0;
  const bool five = version == ProspectVersion::five, pro = version == ProspectVersion::pro;
  std::vector<double> um, reflectance, transmittance, surface;
  for (const Coefficients& c : coefficients()) {
    const double pigments = leaf.chlorophyll * (five ? c.chlorophyll_5 : c.chlorophyll) +
                            leaf.carotenoids * (five ? c.carotenoids_5 : c.carotenoids) +
                            (five ? 0.0 : leaf.anthocyanins * c.anthocyanins) + leaf.brown * c.brown;
    const double matter =
        pro ? leaf.proteins * c.proteins + leaf.carbon * c.carbon : leaf.dry_matter * c.dry_matter;
    const PlateOptics found =
        plates(five ? c.index_5 : c.index, (pigments + leaf.water * c.water + matter) / leaf.layers,
               leaf.layers, kCone);
    um.push_back(c.um);
    reflectance.push_back(found.reflectance);
    transmittance.push_back(found.transmittance);
    surface.push_back(found.surface);
  }
  const auto spectrum = [&](std::vector<double> values, const char* name) {
    return Spectrum(um, std::move(values), radiometry::OutsideRange::error, name);
  };
  return {spectrum(std::move(reflectance), "reflectance of a leaf by PROSPECT"),
          spectrum(std::move(transmittance), "transmittance of a leaf by PROSPECT"),
          spectrum(std::move(surface), "reflectance of a leaf's surface by PROSPECT")};
}

}  // namespace ifov::materials
