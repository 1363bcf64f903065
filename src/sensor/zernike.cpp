#include "sensor/zernike.h"

#include <cmath>

namespace ifov::sensor {

ZernikeOrder noll_order(int j) {
  ZernikeOrder order;
  while ((order.n + 1) * (order.n + 2) / 2 < j) ++order.n;
  const int k = j - order.n * (order.n + 1) / 2;  // 1 to n + 1
  order.m = order.n % 2 == 0 ? k / 2 * 2 : (k - 1) / 2 * 2 + 1;
  order.sine = order.m > 0 && j % 2 == 1;
  return order;
}

double zernike(int j, double x, double y) {
  const auto [n, m, sine] = noll_order(j);
  const double r2 = x * x + y * y;
  // R = r^m times a polynomial in r^2: (-1)^s (n - s)! / (s! ((n + m) / 2 - s)! ((n - m) / 2 - s)!) r^(n - 2s), highest power first.
  const int terms = (n - m) / 2;
  double factor = 1.0;  // of s = 0: n! / (((n + m) / 2)! ((n - m) / 2)!)
  for (int k = 1; k <= terms; ++k) factor *= static_cast<double>((n + m) / 2 + k) / k;
  double radial = factor;
  for (int s = 0; s < terms; ++s) {
    factor *= -static_cast<double>((n + m) / 2 - s) * (terms - s) / (static_cast<double>(s + 1) * (n - s));
    radial = radial * r2 + factor;
  }
  if (m == 0) return std::sqrt(n + 1.0) * radial;
  // r^m exp(i m theta) = (x + i y)^m.
  double real = 1.0, imaginary = 0.0;
  for (int k = 0; k < m; ++k) {
    const double turned = real * x - imaginary * y;
    imaginary = real * y + imaginary * x;
    real = turned;
  }
  return std::sqrt(2.0 * (n + 1.0)) * radial * (sine ? imaginary : real);
}

}  // namespace ifov::sensor
