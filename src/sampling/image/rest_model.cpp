#include "sampling/image/rest_model.h"

#include <cmath>
#include <numeric>

namespace ifov::sampling {

namespace {

/// Of each regressor's mean square, added to it: rare materials tell little.
constexpr double kRidge = 0.01;

/// Solves a x = b for a symmetric positive definite a, whose lower half is replaced by its Cholesky factor.
void solve(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

}  // namespace

RestModel::RestModel(std::span<const Pixel> pixels, std::span<const std::size_t> leaders)
    : leaders_(leaders.begin(), leaders.end()) {
  const std::size_t columns = pixels.front().rest.size();
  if (leaders_.empty()) {
    leaders_.resize(columns);
    std::iota(leaders_.begin(), leaders_.end(), std::size_t{0});
  }
  const double share = 1.0 / static_cast<double>(pixels.size());
  mean_direct_.assign(columns, 0.0);
  mean_rest_.assign(columns, 0.0);
  of_direct_.assign(columns, 0.0);
  for (const Pixel& pixel : pixels) {
    for (const auto& [material, of] : pixel.shares) materials_.emplace(material, materials_.size());
    for (std::size_t c = 0; c < columns; ++c) {
      mean_direct_[c] += share * pixel.direct[c];
      mean_rest_[c] += share * pixel.rest[c];
    }
  }
  // Regressors: the shares, and the first level in units of its own spread.
  const std::size_t materials = materials_.size(), count = materials + 1;
  of_share_.assign(materials * columns, 0.0);
  std::vector<double> of_pixel(pixels.size() * materials, 0.0), products(materials * materials, 0.0);
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    for (const auto& [material, of] : pixels[p].shares)
      of_pixel[p * materials + materials_.at(material)] = of;
    for (std::size_t m = 0; m < materials; ++m)
      for (std::size_t k = 0; k < materials; ++k)
        products[m * materials + k] += share * of_pixel[p * materials + m] * of_pixel[p * materials + k];
  }
  std::vector<double> a(count * count), b(count);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t leader = leaders_[c];
    double spread = 0.0;
    for (const Pixel& pixel : pixels) {
      const double d = pixel.direct[leader] - mean_direct_[leader];
      spread += share * d * d;
    }
    const double unit = spread > 0.0 ? 1.0 / std::sqrt(spread) : 0.0;
    std::fill(a.begin(), a.end(), 0.0);
    std::fill(b.begin(), b.end(), 0.0);
    for (std::size_t m = 0; m < materials; ++m)
      for (std::size_t k = 0; k < materials; ++k) a[m * count + k] = products[m * materials + k];
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const double direct = unit * (pixels[p].direct[leader] - mean_direct_[leader]),
                   rest = pixels[p].rest[c] - mean_rest_[c];
      for (std::size_t m = 0; m < materials; ++m) {
        a[materials * count + m] += share * direct * of_pixel[p * materials + m];
        b[m] += share * rest * of_pixel[p * materials + m];
      }
      a[materials * count + materials] += share * direct * direct;
      b[materials] += share * rest * direct;
    }
    for (std::size_t m = 0; m < count; ++m) {
      double& own = a[m * count + m];
      own = own > 0.0 ? own * (1.0 + kRidge) : 1.0;
    }
    solve(a, b);
    for (std::size_t m = 0; m < materials; ++m) of_share_[m * columns + c] = b[m];
    of_direct_[c] = unit * b[materials];
  }
}

}  // namespace ifov::sampling
