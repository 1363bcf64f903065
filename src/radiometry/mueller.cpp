#include "radiometry/mueller.h"

namespace ifov::radiometry {
namespace {

using Complex = std::complex<double>;

/// Product of two matrices, row by row.
std::array<Complex, 4> product(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2],
          a[2] * b[1] + a[3] * b[3]};
}

}  // namespace

MuellerMatrix MuellerMatrix::diagonal(double i, double q, double u, double v) {
  return MuellerMatrix({i, 0, 0, 0, 0, q, 0, 0, 0, 0, u, 0, 0, 0, 0, v});
}

MuellerMatrix MuellerMatrix::of_fields(const JonesMatrix& fields) {
  // The coherency matrix E E* is (I s0 + Q s1 + U s2 + V s3) / 2 with these.
  constexpr Complex i{0.0, 1.0};
  const std::array<std::array<Complex, 4>, 4> sigma{
      {{1.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, -1.0}, {0.0, 1.0, 1.0, 0.0}, {0.0, -i, i, 0.0}}};
  const std::array<Complex, 4> jones{fields.xx, fields.xy, fields.yx, fields.yy},
      adjoint{std::conj(fields.xx), std::conj(fields.yx), std::conj(fields.xy), std::conj(fields.yy)};
  std::array<double, 16> values{};
  for (std::size_t column = 0; column < 4; ++column) {
    const std::array<Complex, 4> after = product(product(jones, sigma[column]), adjoint);
    for (std::size_t row = 0; row < 4; ++row) {
      const std::array<Complex, 4> seen = product(sigma[row], after);
      values[4 * row + column] = 0.5 * (seen[0] + seen[3]).real();
    }
  }
  return MuellerMatrix(values);
}

MuellerMatrix MuellerMatrix::turned_frame(double cosine, double sine) {
  const double square = cosine * cosine + sine * sine;
  const double c = (cosine * cosine - sine * sine) / square, s = 2.0 * cosine * sine / square;
  return MuellerMatrix({1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, 0, 0, 1});
}

MuellerMatrix MuellerMatrix::linear_diattenuator(double most, double least, double axis_rad) {
  const double sum = 0.5 * (most + least), difference = 0.5 * (most - least), both = std::sqrt(most * least);
  const MuellerMatrix along({sum, difference, 0, 0, difference, sum, 0, 0, 0, 0, both, 0, 0, 0, 0, both});
  return turned_frame(-axis_rad) * along * turned_frame(axis_rad);
}

MuellerMatrix MuellerMatrix::linear_retarder(double retardance_rad, double axis_rad) {
  const double c = std::cos(retardance_rad), s = std::sin(retardance_rad);
  const MuellerMatrix along({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, c, s, 0, 0, -s, c});
  return turned_frame(-axis_rad) * along * turned_frame(axis_rad);
}

StokesVector operator*(const MuellerMatrix& m, const StokesVector& s) {
  const auto row = [&](std::size_t r) {
    return m(r, 0) * s.i + m(r, 1) * s.q + m(r, 2) * s.u + m(r, 3) * s.v;
  };
  return {row(0), row(1), row(2), row(3)};
}

MuellerMatrix operator*(const MuellerMatrix& a, const MuellerMatrix& b) {
  std::array<double, 16> values{};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      for (std::size_t k = 0; k < 4; ++k) values[4 * row + column] += a(row, k) * b(k, column);
  return MuellerMatrix(values);
}

MuellerMatrix operator*(double factor, const MuellerMatrix& m) {
  std::array<double, 16> values = m.values_;
  for (double& value : values) value *= factor;
  return MuellerMatrix(values);
}

MuellerMatrix operator+(const MuellerMatrix& a, const MuellerMatrix& b) {
  std::array<double, 16> values = a.values_;
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += b.values_[k];
  return MuellerMatrix(values);
}

MuellerMatrix MuellerMatrix::transposed() const {
  std::array<double, 16> values;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) values[4 * row + column] = (*this)(column, row);
  return MuellerMatrix(values);
}

MuellerMatrix MuellerMatrix::reversed() const {
  const MuellerMatrix mirror = diagonal(1.0, 1.0, -1.0, 1.0);
  return mirror * transposed() * mirror;
}

}  // namespace ifov::radiometry
