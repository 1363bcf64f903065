#include "atmosphere/particles/mie.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ifov::atmosphere {
namespace {

using Complex = std::complex<double>;

/// Without what std::complex does for infinities, which are not met: six times as fast.
Complex product(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
Complex inverse(Complex a) {
  const double scale = 1.0 / (a.real() * a.real() + a.imag() * a.imag());
  return {a.real() * scale, -a.imag() * scale};
}
double inverse(double a) { return 1.0 / a; }

std::size_t term_count(double x) { return static_cast<std::size_t>(x + 4.05 * std::cbrt(x) + 2.0) + 1; }

/// psi'(z)/psi(z) of Riccati and Bessel's functions of order 0 to `last`, downward from where what it starts with is forgotten:
/// below |z| nothing would be, and above it takes some |z|^(1/3).
template <class Number>
std::vector<Number> logarithmic_derivatives(Number z, std::size_t last) {
  const double size = std::abs(z);
  const std::size_t start = std::max(last, static_cast<std::size_t>(size + 8.0 * std::cbrt(size))) + 16;
  std::vector<Number> result(last + 1);
  Number d{};
  const Number inverse_size = inverse(z);
  for (std::size_t n = start; n > 0; --n) {
    const Number ratio = static_cast<double>(n) * inverse_size;
    d = ratio - inverse(d + ratio);
    if (n - 1 <= last) result[n - 1] = d;
  }
  return result;
}

/// psi_0 .. psi_last of a real argument.
std::vector<double> psi(double x, std::size_t last) {
  const std::vector<double> d = logarithmic_derivatives(x, last);
  std::vector<double> result(last + 1);
  result[0] = std::sin(x);
  double before = std::cos(x);  // psi_-1
  for (std::size_t n = 1; n <= last; ++n) {
    const double order = static_cast<double>(n);
    result[n] =
        order <= x ? (2.0 * order - 1.0) / x * result[n - 1] - before : result[n - 1] / (order / x + d[n]);
    before = result[n - 1];
  }
  return result;
}

/// chi_0 .. chi_last, which grow and need no care.
std::vector<double> chi(double x, std::size_t last) {
  std::vector<double> result(last + 1);
  result[0] = std::cos(x);
  double before = -std::sin(x);  // chi_-1
  for (std::size_t n = 1; n <= last; ++n) {
    result[n] = (2.0 * static_cast<double>(n) - 1.0) / x * result[n - 1] - before;
    before = result[n - 1];
  }
  return result;
}

}  // namespace

MieSphere::MieSphere(double x, Complex index) {
  if (!(x > 0.0 && x <= kLargest && index.real() > 0.0 && index.imag() >= 0.0))
    throw std::invalid_argument(
        "a sphere has a size parameter above 0, up to 50000, and an index n + ik, n > 0, k >= 0");
  const std::size_t last = term_count(x);
  const std::vector<Complex> inside = logarithmic_derivatives(index * x, last);
  const std::vector<double> p = psi(x, last), c = chi(x, last);
  a_.reserve(last), b_.reserve(last);
  Complex a_before, b_before;
  const Complex inverse_index = inverse(index);
  double asymmetry = 0.0;
  for (std::size_t n = 1; n <= last; ++n) {
    const double order = static_cast<double>(n);
    const Complex xi{p[n], -c[n]}, xi_before{p[n - 1], -c[n - 1]};
    const Complex electric = product(inside[n], inverse_index) + order / x,
                  magnetic = product(inside[n], index) + order / x;
    const Complex a = product(electric * p[n] - p[n - 1], inverse(product(electric, xi) - xi_before)),
                  b = product(magnetic * p[n] - p[n - 1], inverse(product(magnetic, xi) - xi_before));
    extinction_ += (2.0 * order + 1.0) * (a + b).real();
    scattering_ += (2.0 * order + 1.0) * (std::norm(a) + std::norm(b));
    asymmetry += (2.0 * order + 1.0) / (order * (order + 1.0)) * (a.real() * b.real() + a.imag() * b.imag());
    if (n > 1)
      asymmetry += (order - 1.0) * (order + 1.0) / order *
                   (a_before.real() * a.real() + a_before.imag() * a.imag() + b_before.real() * b.real() +
                    b_before.imag() * b.imag());
    a_.push_back(a), b_.push_back(b);
    a_before = a, b_before = b;
  }
  const double scale = 2.0 / (x * x);
  asymmetry_ = scattering_ > 0.0 ? 2.0 * asymmetry / scattering_ : 0.0;
  extinction_ *= scale;
  scattering_ *= scale;
}

void MieSphere::amplitudes(std::span<const double> cosine, std::span<Complex> s1,
                           std::span<Complex> s2) const {
  const std::size_t count = cosine.size();
  // Sums and differences of S1 and S2 share their terms: (a + b)(pi + tau) and (a - b)(pi - tau).
  std::vector<double> work(6 * count, 0.0), before(count, 0.0), now(count, 1.0);
  double* __restrict plus_re = work.data(), * __restrict plus_im = plus_re + count, * __restrict minus_re = plus_im + count, * __restrict minus_im = minus_re + count;
  double* __restrict earlier = before.data(), * __restrict current = now.data();
  const double* __restrict mu = cosine.data();
  for (std::size_t n = 1; n <= a_.size(); ++n) {
    const double order = static_cast<double>(n), factor = (2.0 * order + 1.0) / (order * (order + 1.0));
    const Complex sum = factor * (a_[n - 1] + b_[n - 1]), difference = factor * (a_[n - 1] - b_[n - 1]);
    const double sr = sum.real(), si = sum.imag(), dr = difference.real(), di = difference.imag();
    const double next_current = (2.0 * order + 1.0) / order, next_earlier = (order + 1.0) / order;
    for (std::size_t k = 0; k < count; ++k) {
      const double pi = current[k], tau = order * mu[k] * pi - (order + 1.0) * earlier[k];
      plus_re[k] += sr * (pi + tau), plus_im[k] += si * (pi + tau);
      minus_re[k] += dr * (pi - tau), minus_im[k] += di * (pi - tau);
      current[k] = next_current * mu[k] * pi - next_earlier * earlier[k];
      earlier[k] = pi;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Complex plus{plus_re[k], plus_im[k]}, minus{minus_re[k], minus_im[k]};
    s1[k] = 0.5 * (plus + minus);
    s2[k] = 0.5 * (plus - minus);
  }
}

MieMixture mie_mixture(const SizeDistribution& sizes, double wavelength_um, Complex index,
                       std::span<const double> cosine) {
  const std::size_t count = cosine.size();
  MieMixture result;
  result.a1.assign(count, 0.0), result.a3.assign(count, 0.0), result.b1.assign(count, 0.0);
  std::vector<Complex> s1(count), s2(count);
  double spheres = 0.0, forward = 0.0;
  const double wavenumber = 2.0 * std::numbers::pi / wavelength_um;
  for (std::size_t r = 0; r < sizes.radius_um.size(); ++r) {
    const double radius = sizes.radius_um[r], number = sizes.number[r];
    const MieSphere sphere(wavenumber * radius, index);
    const double area = number * std::numbers::pi * radius * radius;
    spheres += number;
    result.extinction += area * sphere.extinction();
    result.scattering += area * sphere.scattering();
    result.volume += area * radius * 4.0 / 3.0;
    forward += area * sphere.scattering() * sphere.asymmetry();
    if (count == 0) continue;
    sphere.amplitudes(cosine, s1, s2);
    for (std::size_t k = 0; k < count; ++k) {
      const double across = std::norm(s1[k]), along = std::norm(s2[k]);
      result.a1[k] += number * 0.5 * (across + along);
      result.b1[k] += number * 0.5 * (along - across);
      result.a3[k] += number * (s1[k].real() * s2[k].real() + s1[k].imag() * s2[k].imag());
    }
  }
  result.asymmetry = forward / result.scattering;
  // dC/dOmega = (|S1|^2 + |S2|^2) / (2 k^2), and a1 = 4 pi dC/dOmega / C.
  const double scale = 4.0 * std::numbers::pi / (wavenumber * wavenumber * result.scattering);
  for (std::vector<double>* element : {&result.a1, &result.a3, &result.b1})
    for (double& value : *element) value *= scale;
  for (double* of_one : {&result.extinction, &result.scattering, &result.volume}) *of_one /= spheres;
  return result;
}

}  // namespace ifov::atmosphere
