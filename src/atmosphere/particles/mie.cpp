#include "atmosphere/particles/mie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace ifov::atmosphere {
namespace {

using Complex = std::complex<double>;

/// A number of each of four spheres: each waits for every step of its own recursions, and none for another's.
constexpr std::size_t kLanes = MieSphere::kAtOnce;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

Lanes all(double value) { return Lanes{value, value, value, value}; }

struct ComplexLanes {
  Lanes re, im;
};
ComplexLanes operator+(const ComplexLanes& a, const Lanes& b) { return {a.re + b, a.im}; }
ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b) { return {a.re + b.re, a.im + b.im}; }
ComplexLanes operator-(const ComplexLanes& a, const Lanes& b) { return {a.re - b, a.im}; }
ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b) { return {a.re - b.re, a.im - b.im}; }
ComplexLanes operator*(const ComplexLanes& a, const Lanes& b) { return {a.re * b, a.im * b}; }
ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
ComplexLanes inverse(const ComplexLanes& a) {
  const Lanes scale = 1.0 / (a.re * a.re + a.im * a.im);
  return {a.re * scale, -a.im * scale};
}
Lanes inverse(const Lanes& a) { return 1.0 / a; }
Lanes real_product(const ComplexLanes& a, const ComplexLanes& b) {
  return a.re * b.re + a.im * b.im;
}  // a times b conjugated

std::size_t term_count(double x) { return static_cast<std::size_t>(x + 4.05 * std::cbrt(x) + 2.0) + 1; }

/// From where downward recursions to order `last` are right at it, whatever they start with, for arguments up to |z|: below |z| nothing
/// would be forgotten, and above it that takes some |z|^(1/3).
std::size_t start_of(double size, std::size_t last) {
  return std::max(last, static_cast<std::size_t>(size + 8.0 * std::cbrt(size))) + 16;
}

/// psi'(z)/psi(z) of Riccati and Bessel's functions of order 0 to `last`, downward from `start`.
template <class Number>
std::vector<Number> logarithmic_derivatives(const Number& inverse_size, std::size_t start, std::size_t last) {
  std::vector<Number> result(last + 1);
  Number d{};
  for (std::size_t n = start; n > 0; --n) {
    const Number ratio = inverse_size * all(static_cast<double>(n));
    d = ratio - inverse(d + ratio);
    if (n - 1 <= last) result[n - 1] = d;
  }
  return result;
}

}  // namespace

/// Four spheres of one index.
class MieSphere::Four {
 public:
  Four(const std::array<double, kLanes>& sizes, Complex index);
  MieSphere spheres[kLanes];
};

MieSphere::Four::Four(const std::array<double, kLanes>& sizes, Complex index) {
  std::array<std::size_t, kLanes> terms;
  Lanes x, sine, cosine, terms_in;
  for (std::size_t l = 0; l < kLanes; ++l) {
    terms[l] = term_count(sizes[l]);
    x[l] = sizes[l], sine[l] = std::sin(sizes[l]), cosine[l] = std::cos(sizes[l]);
    terms_in[l] = static_cast<double>(terms[l]);
    spheres[l].a_.reserve(terms[l]), spheres[l].b_.reserve(terms[l]);
  }
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const std::size_t last = term_count(largest);
  const ComplexLanes m{all(index.real()), all(index.imag())}, inverse_m = inverse(m);
  const Lanes inverse_x = 1.0 / x;
  const std::vector<ComplexLanes> inside =
      logarithmic_derivatives(inverse(m * x), start_of(std::abs(index) * largest, last), last);
  const std::vector<Lanes> beyond = logarithmic_derivatives(inverse_x, start_of(largest, last), last);

  // psi from below as far as that is stable, and from ratios beyond; chi grows and needs no care.
  Lanes psi = sine, psi_before = cosine, chi = cosine, chi_before = -sine;
  Lanes extinction{}, scattering{}, asymmetry{};
  ComplexLanes a_before{}, b_before{};
  for (std::size_t n = 1; n <= last; ++n) {
    const double order = static_cast<double>(n);
    const Lanes over_x = all(order) / x, step = all(2.0 * order - 1.0) / x;
    const Lanes psi_now = all(order) <= x ? step * psi - psi_before : psi / (over_x + beyond[n]);
    const Lanes chi_now = step * chi - chi_before;
    psi_before = psi, psi = psi_now, chi_before = chi, chi = chi_now;

    const ComplexLanes xi{psi, -chi}, xi_before{psi_before, -chi_before};
    const ComplexLanes electric = inside[n] * inverse_m + over_x, magnetic = inside[n] * m + over_x;
    const ComplexLanes a = (electric * psi - psi_before) * inverse(electric * xi - xi_before),
                       b = (magnetic * psi - psi_before) * inverse(magnetic * xi - xi_before);
    const Lanes more_extinction = (2.0 * order + 1.0) * (a.re + b.re),
                more_scattering = (2.0 * order + 1.0) * (real_product(a, a) + real_product(b, b)),
                more_asymmetry = (2.0 * order + 1.0) / (order * (order + 1.0)) * real_product(a, b) +
                                 (order - 1.0) * (order + 1.0) / order *
                                     (real_product(a_before, a) + real_product(b_before, b));
    // A smaller sphere ends before the others.
    const auto within = all(order) <= terms_in;
    extinction += within ? more_extinction : Lanes{};
    scattering += within ? more_scattering : Lanes{};
    asymmetry += within ? more_asymmetry : Lanes{};
    for (std::size_t l = 0; l < kLanes; ++l) {
      if (n > terms[l]) continue;
      spheres[l].a_.emplace_back(a.re[l], a.im[l]);
      spheres[l].b_.emplace_back(b.re[l], b.im[l]);
    }
    a_before = a, b_before = b;
  }
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double scale = 2.0 / (sizes[l] * sizes[l]);
    spheres[l].asymmetry_ = scattering[l] > 0.0 ? 2.0 * asymmetry[l] / scattering[l] : 0.0;
    spheres[l].extinction_ = extinction[l] * scale;
    spheres[l].scattering_ = scattering[l] * scale;
  }
}

MieSphere::MieSphere(double x, Complex index) : MieSphere(of({&x, 1}, index).front()) {}

std::vector<MieSphere> MieSphere::of(std::span<const double> sizes, Complex index) {
  for (const double x : sizes)
    if (!(x > 0.0 && x <= kLargest && index.real() > 0.0 && index.imag() >= 0.0))
      throw std::invalid_argument(
          "a sphere has a size parameter above 0, up to 50000, and an index n + ik, n > 0, k >= 0");
  std::vector<MieSphere> result;
  for (std::size_t first = 0; first < sizes.size(); first += kLanes) {
    std::array<double, kLanes> x;
    for (std::size_t l = 0; l < kLanes; ++l) x[l] = sizes[std::min(first + l, sizes.size() - 1)];
    Four four(x, index);
    for (std::size_t l = 0; l < kLanes && first + l < sizes.size(); ++l)
      result.push_back(std::move(four.spheres[l]));
  }
  return result;
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
  std::vector<double> x;
  for (const double radius : sizes.radius_um) x.push_back(wavenumber * radius);
  std::vector<MieSphere> some;
  for (std::size_t r = 0; r < sizes.radius_um.size(); ++r) {
    const double radius = sizes.radius_um[r], number = sizes.number[r];
    if (r % MieSphere::kAtOnce == 0)
      some = MieSphere::of(std::span(x).subspan(r, std::min(MieSphere::kAtOnce, x.size() - r)), index);
    const MieSphere& sphere = some[r % MieSphere::kAtOnce];
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
