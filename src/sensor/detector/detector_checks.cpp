#include "sensor/detector/detector_checks.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "math/fft.h"
#include "sensor/detector/detector_signal.h"

namespace ifov::sensor {

Moments moments(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  Moments m{std::accumulate(values.begin(), values.end(), 0.0) / n, 0.0};
  for (const double value : values) m.variance += (value - m.mean) * (value - m.mean) / (n - 1.0);
  return m;
}

SignalImage signal_image(const Detector& detector, double radiance_w_m2_sr_um, int lines, int columns,
                         std::uint64_t seed) {
  SignalImage result{lines, columns, {}};
  const DetectorSignal signal(detector, seed, 0, columns);
  const std::vector<float> even(static_cast<std::size_t>(columns), static_cast<float>(radiance_w_m2_sr_um));
  std::vector<double> line(even.size());
  for (int y = 0; y < lines; ++y) {
    signal.draw(y, even, {}, line);
    result.values.insert(result.values.end(), line.begin(), line.end());
  }
  return result;
}

PatternSpreads pattern_spreads(const SignalImage& image) {
  const auto rows = static_cast<std::size_t>(image.lines), columns = static_cast<std::size_t>(image.columns);
  std::vector<double> row(rows, 0.0), column(columns, 0.0);
  double mean = 0.0;
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const double value = image.values[y * columns + x];
      row[y] += value / static_cast<double>(columns);
      column[x] += value / static_cast<double>(rows);
      mean += value / static_cast<double>(rows * columns);
    }
  const auto variance = [&](const std::vector<double>& means) {
    double sum = 0.0;
    for (const double one : means) sum += (one - mean) * (one - mean);
    return sum / static_cast<double>(means.size() - 1);
  };
  double left = 0.0;
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      left += std::pow(image.values[y * columns + x] - row[y] - column[x] + mean, 2);
  left /= static_cast<double>((rows - 1) * (columns - 1));
  return {std::sqrt(left), std::sqrt(variance(row) - left / static_cast<double>(columns)),
          std::sqrt(variance(column) - left / static_cast<double>(rows))};
}

PhotonTransfer photon_transfer(const Detector& detector, const std::function<double(double count)>& altered) {
  constexpr int kTransferLines = 400, kTransferColumns = 1000;
  const auto measured = [&](double electrons) {
    std::vector<double> values =
        signal_image(detector, electrons / detector.electrons_per_radiance, kTransferLines, kTransferColumns)
            .values;
    for (double& value : values) {
      value = detector.count(value);
      if (altered) value = altered(value);
    }
    return moments(values);
  };
  PhotonTransfer result;
  result.darkness = measured(0.0);
  double weights = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (double electrons = 8.0; electrons < 0.9 * detector.full_well; electrons *= std::sqrt(10.0)) {
    const Moments m = measured(electrons);
    const double mean = m.mean - result.darkness.mean, variance = m.variance - result.darkness.variance;
    result.mean.push_back(mean), result.variance.push_back(variance);
    // The variance of a variance is 2 variance^2 / n, and there are two.
    const double relative = std::hypot(m.variance, result.darkness.variance) / variance;
    const double weight = 1.0 / (relative * relative);
    weights += weight, x += weight * std::log(mean), y += weight * std::log(variance);
    xx += weight * std::log(mean) * std::log(mean), xy += weight * std::log(mean) * std::log(variance);
  }
  result.slope = (weights * xy - x * y) / (weights * xx - x * x);
  result.gain = std::exp((x - y) / weights);
  return result;
}

std::vector<double> column_spectrum(std::span<const float> series, int lines) {
  const auto rows = static_cast<std::size_t>(lines), columns = series.size() / rows;
  const math::Fft fft(rows);
  std::vector<double> power(rows / 2, 0.0), window;
  double norm = 0.0;
  for (int n = 0; n < lines; ++n) {
    window.push_back(1.0 - std::cos(2.0 * std::numbers::pi * n / lines));
    norm += window.back() * window.back();
  }
  std::vector<std::complex<double>> values(rows);
  for (std::size_t x = 0; x < columns; ++x) {
    for (std::size_t y = 0; y < rows; ++y)
      values[y] = window[y] * static_cast<double>(series[y * columns + x]);
    fft.transform(values);
    for (std::size_t k = 0; k < power.size(); ++k)
      power[k] += std::norm(values[k]) / (norm * static_cast<double>(columns));
  }
  return power;
}

}  // namespace ifov::sensor
