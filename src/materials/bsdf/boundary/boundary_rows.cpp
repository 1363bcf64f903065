#include "materials/bsdf/boundary/boundary_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::materials::boundary_rows {
namespace {

using radiometry::Spectrum;

/// Where constants are tabulated that interfere or absorb by wavelength.
constexpr double kFirst_um = 0.1, kLast_um = 1000.0;

/// Numbers of one wavelength and angle.
struct Row {
  std::array<double, kMostNumbers> at{};
  Row(const Numbers& numbers, double um, double cosine) { numbers(um, cosine, at.data()); }
};

bool differs_little(const Numbers& numbers, std::size_t count, double first_um, double last_um) {
  constexpr double kWithin = 2e-4;
  for (const double cosine : {1.0, 0.5, 0.15}) {
    const Row a(numbers, first_um, cosine), b(numbers, last_um, cosine),
        middle(numbers, 0.5 * (first_um + last_um), cosine);
    for (std::size_t k = 0; k < count; ++k)
      if (std::abs(middle.at[k] - 0.5 * (a.at[k] + b.at[k])) > kWithin) return false;
  }
  return true;
}

void halve(const Numbers& numbers, std::size_t count, double first_um, double last_um, int halvings,
           std::vector<double>& um) {
  if (halvings > 0 && !differs_little(numbers, count, first_um, last_um)) {
    const double middle = 0.5 * (first_um + last_um);
    halve(numbers, count, first_um, middle, halvings - 1, um);
    halve(numbers, count, middle, last_um, halvings - 1, um);
  } else {
    um.push_back(last_um);
  }
}

/// Points so close that fringes of this thickness, and the ends of what is opaque, lie between several of them.
std::vector<double> close_enough(const std::vector<double>& given, const Source& source) {
  constexpr double kPerFringe = 16.0, kRatio = 1.5;
  std::vector<double> um{given.front()};
  for (std::size_t k = 1; k < given.size(); ++k) {
    while (um.back() < given[k]) {
      const double here = um.back();
      double next = here * kRatio;
      if (source.interferes) {
        // Of wavenumber: 1 / (2 d) is one fringe.
        const double step = 1.0 / (2.0 * source.thickness_um * kPerFringe), wavenumber = 1.0 / here - step;
        if (wavenumber > 0.0) next = std::min(next, 1.0 / wavenumber);
      }
      um.push_back(next < given[k] * (1.0 - 1e-9) ? next : given[k]);
    }
  }
  return um;
}

}  // namespace

std::vector<Spectrum> tabulated(const Source& source, std::size_t rows, const Shares& shares) {
  return tabulated(source, rows, 2, [&](double um, double cosine, double* values) {
    const BoundaryShares found = shares(um, cosine);
    values[0] = found.reflected, values[1] = found.transmitted;
  });
}

std::vector<Spectrum> tabulated(const Source& source, std::size_t rows, std::size_t count,
                                const Numbers& numbers) {
  constexpr int kHalvings = 6;
  radiometry::CommonWavelengths common = radiometry::common_wavelengths(source.spectra);
  std::vector<Spectrum> table;
  if (common.um.empty() && !(source.thickness_um > 0.0)) {
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t row = 0; row < rows; ++row)
        table.push_back(Spectrum::constant(Row(numbers, 1.0, cosine(row, rows)).at[k]));
    return table;
  }
  std::string name;
  for (const Spectrum* spectrum : source.spectra)
    if (name.empty() && !spectrum->is_constant()) name = spectrum->name();
  if (common.um.empty()) common.um = {kFirst_um, kLast_um};
  const std::vector<double> start =
      source.thickness_um > 0.0 ? close_enough(common.um, source) : std::move(common.um);
  std::vector<double> um{start.front()};
  for (std::size_t k = 1; k < start.size(); ++k) halve(numbers, count, start[k - 1], start[k], kHalvings, um);
  std::vector<std::vector<double>> values(count * rows);
  for (const double at : um)
    for (std::size_t row = 0; row < rows; ++row) {
      const Row found(numbers, at, cosine(row, rows));
      for (std::size_t k = 0; k < count; ++k) values[k * rows + row].push_back(found.at[k]);
    }
  for (std::vector<double>& row : values) table.emplace_back(um, std::move(row), common.outside, name);
  return table;
}

}  // namespace ifov::materials::boundary_rows
