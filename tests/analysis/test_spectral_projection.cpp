#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/spectral_projection.h"
#include "sampling/random.h"

namespace ifov::analysis::test_spectral_projection {
namespace {

constexpr int kWidth = 60, kHeight = 50;

double normal(int pixel, int what) {
  const double u = sampling::unit_double(sampling::hash(11, pixel, what, 0)),
               v = sampling::unit_double(sampling::hash(11, pixel, what, 1));
  return std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * 3.14159265358979 * v);
}

CubeView view(const std::vector<float>& values, int columns) { return {values, kWidth, kHeight, columns}; }

double angle_deg(const SpectralAxes& axes, int axis, const std::vector<double>& direction) {
  double dot = 0.0, a = 0.0, b = 0.0;
  for (std::size_t c = 0; c < direction.size(); ++c) {
    const double w = axes.weights[static_cast<std::size_t>(axis) * direction.size() + c];
    dot += w * direction[c];
    a += w * w;
    b += direction[c] * direction[c];
  }
  return std::acos(std::min(1.0, std::abs(dot) / std::sqrt(a * b))) * 180.0 / 3.14159265358979;
}

TEST(SpectralProjection, PrincipalAxesOfTwoChannels) {
  // x = s + d, y = s - d: axes at 45 degrees with variances 2 var(s) and 2 var(d).
  std::vector<float> values;
  double ss = 0.0, dd = 0.0, sd = 0.0, s1 = 0.0, d1 = 0.0;
  const int n = kWidth * kHeight;
  for (int p = 0; p < n; ++p) {
    const double s = 3.0 * normal(p, 0), d = normal(p, 1);
    values.push_back(static_cast<float>(5.0 + s + d));
    values.push_back(static_cast<float>(1.0 + s - d));
    ss += s * s, dd += d * d, sd += s * d, s1 += s, d1 += d;
  }
  ss = ss / n - s1 * s1 / n / n, dd = dd / n - d1 * d1 / n / n, sd = sd / n - s1 * d1 / n / n;
  const SpectralAxes axes = principal_axes(view(values, 2), 2);
  // Eigenvalues of the 2 x 2 covariance in closed form.
  const double a = ss + dd + 2.0 * sd, b = ss + dd - 2.0 * sd, c = ss - dd;
  const double middle = 0.5 * (a + b), half = std::hypot(0.5 * (a - b), c);
  EXPECT_NEAR(axes.strength[0], middle + half, 1e-5 * middle);
  EXPECT_NEAR(axes.strength[1], middle - half, 1e-5 * middle);
  EXPECT_NEAR(axes.mean[0], 5.0 + (s1 + d1) / n, 1e-6);
  EXPECT_LT(angle_deg(axes, 0, {1.0, 1.0}), 2.0);
  // The scores along an axis have its variance.
  const std::vector<float> scores = project(axes, view(values, 2));
  double sum = 0.0;
  for (int p = 0; p < n; ++p)
    sum += double(scores[2 * static_cast<std::size_t>(p)]) * scores[2 * static_cast<std::size_t>(p)];
  EXPECT_NEAR(sum / n, axes.strength[0], 1e-4 * axes.strength[0]);
}

/// Channel 0 carries a weak smooth signal, channel 1 strong noise: principal components prefer the noise.
TEST(SpectralProjection, MinimumNoiseFractionFindsTheSignalThatPrincipalComponentsMiss) {
  std::vector<float> values;
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i) {
      const int p = j * kWidth + i;
      values.push_back(static_cast<float>(std::sin(i * 0.1) + 0.05 * normal(p, 0)));
      values.push_back(static_cast<float>(20.0 * normal(p, 1)));
      values.push_back(static_cast<float>(0.1 * normal(p, 2)));
    }
  EXPECT_LT(angle_deg(principal_axes(view(values, 3), 3), 0, {0.0, 1.0, 0.0}), 2.0);
  const SpectralAxes axes = minimum_noise_axes(view(values, 3), 3);
  EXPECT_GT(axes.strength[0], 50.0);
  for (std::size_t k : {1u, 2u}) {  // white noise: variance and half the variance of differences agree
    EXPECT_NEAR(axes.strength[k], 1.0, 0.1);
  }
  const std::vector<float> scores = project(axes, view(values, 3));
  double same = 0.0, own = 0.0, signal = 0.0;
  for (int p = 0; p < kWidth * kHeight; ++p) {
    const double s = scores[3 * static_cast<std::size_t>(p)],
                 t = values[3 * static_cast<std::size_t>(p)] - axes.mean[0];
    same += s * t, own += s * s, signal += t * t;
  }
  EXPECT_GT(std::abs(same) / std::sqrt(own * signal), 0.99);
}

/// Texture from pixel to pixel is noise to neighbours' differences, and is none to those who know the errors.
TEST(SpectralProjection, KnownNoiseTellsTextureFromNoise) {
  const double error[] = {0.1, 2.0};
  std::vector<float> values;
  double variance[2] = {}, covariance = 0.0, mean[2] = {};
  const int n = kWidth * kHeight;
  for (int p = 0; p < n; ++p) {
    const double texture = normal(p, 0);
    const double v[] = {texture + error[0] * normal(p, 1), 3.0 + error[1] * normal(p, 2)};
    for (int c = 0; c < 2; ++c) {
      values.push_back(static_cast<float>(v[c]));
      mean[c] += v[c] / n, variance[c] += v[c] * v[c] / n;
    }
    covariance += v[0] * v[1] / n;
  }
  for (int c = 0; c < 2; ++c) variance[c] -= mean[c] * mean[c];
  covariance -= mean[0] * mean[1];
  const std::vector<double> noise = {error[0] * error[0], error[1] * error[1]};
  const SpectralAxes axes = minimum_noise_axes(view(values, 2), noise, 2);
  // det(S - l N) = 0 in closed form.
  const double a = variance[0] / noise[0], b = variance[1] / noise[1],
               c = covariance * covariance / (noise[0] * noise[1]);
  const double half = std::sqrt(0.25 * (a - b) * (a - b) + c);
  EXPECT_NEAR(axes.strength[0], 0.5 * (a + b) + half, 1e-4 * a);
  EXPECT_NEAR(axes.strength[1], 0.5 * (a + b) - half, 1e-4);
  EXPECT_NEAR(axes.strength[0], 101.0, 8.0);
  EXPECT_LT(angle_deg(axes, 0, {1.0, 0.0}), 2.0);
  // Without knowing, the texture cannot be told from noise.
  EXPECT_LT(minimum_noise_axes(view(values, 2), 2).strength[0], 1.2);
}

TEST(SpectralProjection, KnownNoiseMustFitTheChannels) {
  const std::vector<float> values(2 * static_cast<std::size_t>(kWidth * kHeight), 1.0f);
  EXPECT_THROW(minimum_noise_axes(view(values, 2), std::vector<double>{1.0}, 2), std::invalid_argument);
  EXPECT_THROW(minimum_noise_axes(view(values, 2), std::vector<double>{0.0, 0.0}, 2), std::invalid_argument);
}

TEST(SpectralProjection, ChannelsThatAddNothingDoNoHarm) {
  std::vector<float> values;
  for (int p = 0; p < kWidth * kHeight; ++p) {
    const float v = static_cast<float>(normal(p, 0));
    for (float factor : {1.0f, 2.0f, 0.0f}) values.push_back(factor * v);
  }
  const SpectralAxes axes = minimum_noise_axes(view(values, 3), 3);
  for (double w : axes.weights) EXPECT_TRUE(std::isfinite(w));
  for (double s : axes.strength) EXPECT_TRUE(std::isfinite(s));
}

}  // namespace
}  // namespace ifov::analysis::test_spectral_projection
