#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "math/angle.h"

namespace ifov::materials::test {

using math::kDegree;

inline math::Vec3 at(double zenith_rad, double azimuth_rad) {
  return {std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
          std::cos(zenith_rad)};
}

/// Zenith angles and azimuth between the two in degrees; azimuth 0: the viewer has the light in the back.
inline BsdfEvent event_of(double out_deg, double in_deg, double azimuth_deg) {
  return {at(out_deg * kDegree, azimuth_deg * kDegree),
          at(in_deg * kDegree, 0.0),
          {0.0, 0.0, 1.0},
          {},
          Side::reflected};
}

/// pi x BRDF of a model whose spectra are constant.
inline double reflectance_factor(const Bsdf& bsdf, const BsdfEvent& event) {
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    values.push_back(static_cast<float>(spectrum.at(1.0)));
  for (const float& value : values) rows.push_back(&value);
  float found = 0.0f;
  bsdf.evaluate(event, rows, 1, &found);
  return std::numbers::pi * static_cast<double>(found);
}

/// Radiances of uvspec (libRadtran) above a surface without air, in units of the Sun's irradiance: per cosine of the
/// view the mean over azimuth and the radiances at the azimuths of the heading. What uvspec prints of the solver before its
/// fluxes, the last line of seven numbers, is skipped.
struct UvspecRow {
  double cosine, mean;
  std::vector<double> radiance;
};
inline std::vector<UvspecRow> read_uvspec(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> lines;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (double value; words >> value;) numbers.push_back(value);
    if (!words.eof()) numbers.clear();  // words among them
    if (numbers.size() == 7) lines.clear();
    lines.push_back(std::move(numbers));
  }
  std::vector<UvspecRow> rows;
  for (std::size_t k = 2; k < lines.size(); ++k)  // after fluxes and azimuths
    if (lines[k].size() > 2)
      rows.push_back({lines[k][0], lines[k][1], {lines[k].begin() + 2, lines[k].end()}});
  return rows;
}

}  // namespace ifov::materials::test
