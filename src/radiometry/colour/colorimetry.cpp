#include "radiometry/colour/colorimetry.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace ifov::data {
extern const std::string_view colorimetry_csv;
}

namespace ifov::radiometry {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix inverse(const Matrix& m) {
  const auto cofactor = [&](std::size_t r, std::size_t c) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix result{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) result[c][r] = cofactor(r, c) / determinant;
  return result;
}

std::array<double, 3> product(const Matrix& m, const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (std::size_t r = 0; r < 3; ++r) result[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
  return result;
}

struct Tables {
  std::vector<double> um;
  std::array<std::array<double, kColourPoints>, 3>
      xyz{};  ///< factors that make a reflectance's tristimulus values
  Tristimulus white{};
  Matrix xyz_from_rgb{}, rgb_from_xyz{};
  std::array<std::array<double, kColourPoints>, 3> rgb{};

  Tables() {
    std::string_view text = data::colorimetry_csv;
    std::vector<std::array<double, 5>> rows;
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      if (line.empty() || line[0] < '0' || line[0] > '9') continue;
      std::array<double, 5>& row = rows.emplace_back();
      const char* at = line.data();
      for (double& value : row) at = std::from_chars(at, line.data() + line.size(), value).ptr + 1;
    }
    double whole = 0.0;
    for (const auto& row : rows) whole += row[2] * row[4];
    for (std::size_t k = 0; k < kColourPoints; ++k) {
      um.push_back(rows[k][0]);
      for (std::size_t c = 0; c < 3; ++c) {
        xyz[c][k] = rows[k][1 + c] * rows[k][4] / whole;
        white[c] += xyz[c][k];
      }
    }
    // Chromaticities x, y of red, green and blue (IEC 61966-2-1, as ITU-R BT.709); they are scaled so that 1, 1, 1 is the white.
    constexpr double kPrimaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    Matrix unscaled{};
    for (std::size_t p = 0; p < 3; ++p) {
      const double x = kPrimaries[p][0], y = kPrimaries[p][1];
      unscaled[0][p] = x / y, unscaled[1][p] = 1.0, unscaled[2][p] = (1.0 - x - y) / y;
    }
    const std::array<double, 3> scale = product(inverse(unscaled), white);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t p = 0; p < 3; ++p) xyz_from_rgb[r][p] = unscaled[r][p] * scale[p];
    rgb_from_xyz = inverse(xyz_from_rgb);
    for (std::size_t k = 0; k < kColourPoints; ++k) {
      const std::array<double, 3> of = product(rgb_from_xyz, {xyz[0][k], xyz[1][k], xyz[2][k]});
      for (std::size_t c = 0; c < 3; ++c) rgb[c][k] = of[c];
    }
  }
};

const Tables& tables() {
  static const Tables known;
  return known;
}

}  // namespace

double srgb_decoded(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double srgb_coded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::span<const double> colour_wavelengths_um() { return tables().um; }

Tristimulus tristimulus_under_d65(const Spectrum& reflectance) {
  Tristimulus sum{};
  for (std::size_t k = 0; k < kColourPoints; ++k) {
    const double r = reflectance.at(tables().um[k]);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += tables().xyz[c][k] * r;
  }
  return sum;
}

LinearRgb linear_srgb(const Tristimulus& xyz) { return product(tables().rgb_from_xyz, xyz); }
Tristimulus tristimulus_of(const LinearRgb& rgb) { return product(tables().xyz_from_rgb, rgb); }
const std::array<std::array<double, kColourPoints>, 3>& srgb_weights() { return tables().rgb; }

std::array<double, 3> cielab(const Tristimulus& xyz) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Tristimulus& white = tables().white;
  const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double colour_difference(const LinearRgb& a, const LinearRgb& b) {
  const std::array<double, 3> p = cielab(tristimulus_of(a)), q = cielab(tristimulus_of(b));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace ifov::radiometry
