#include "studies/sensor/slanted_edge.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.h"

namespace ifov::studies {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBins = 4;  // a pixel

/// Least squares by the normal equations, of powers of x in [-1, 1].
class Polynomial {
 public:
  Polynomial(const std::vector<double>& y, int order) : rows_(static_cast<double>(y.size())) {
    const auto n = static_cast<std::size_t>(order + 1);
    std::vector<std::vector<double>> a(n, std::vector<double>(n + 1, 0.0));
    for (std::size_t k = 0; k < y.size(); ++k) {
      std::vector<double> powers(n, 1.0);
      for (std::size_t p = 1; p < n; ++p) powers[p] = powers[p - 1] * scaled(static_cast<double>(k));
      for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t c = 0; c < n; ++c) a[r][c] += powers[r] * powers[c];
        a[r][n] += powers[r] * y[k];
      }
    }
    for (std::size_t p = 0; p < n; ++p) {
      std::size_t best = p;
      for (std::size_t r = p; r < n; ++r)
        if (std::abs(a[r][p]) > std::abs(a[best][p])) best = r;
      std::swap(a[p], a[best]);
      for (std::size_t r = 0; r < n; ++r) {
        if (r == p) continue;
        const double factor = a[r][p] / a[p][p];
        for (std::size_t c = p; c <= n; ++c) a[r][c] -= factor * a[p][c];
      }
    }
    for (std::size_t p = 0; p < n; ++p) coefficients_.push_back(a[p][n] / a[p][p]);
  }
  double at(double row) const {
    double value = 0.0;
    for (std::size_t p = coefficients_.size(); p-- > 0;) value = value * scaled(row) + coefficients_[p];
    return value;
  }
  double slope() const { return coefficients_.size() > 1 ? coefficients_[1] * 2.0 / rows_ : 0.0; }

 private:
  double scaled(double row) const { return 2.0 * row / rows_ - 1.0; }
  double rows_;
  std::vector<double> coefficients_;
};

double window(bool tukey, double x) {  // x from -1 to 1
  if (std::abs(x) >= 1.0) return tukey ? 0.0 : 0.08;
  if (!tukey) return 0.54 + 0.46 * std::cos(kPi * x);
  constexpr double kFlat = 0.0;  // alpha of 1: a Hann window
  return std::abs(x) <= kFlat ? 1.0 : 0.5 * (1.0 + std::cos(kPi * (std::abs(x) - kFlat) / (1.0 - kFlat)));
}

Polynomial edge_of(const SensorImage& image, int rows, const Polynomial* about, bool tukey, int order) {
  std::vector<double> centroids;
  for (int y = 0; y < rows; ++y) {
    double sum = 0.0, weighted = 0.0;
    const double middle = about ? about->at(y) : 0.5 * image.width - 0.5;
    for (int x = 1; x + 1 < image.width; ++x) {
      const double reach = std::max(middle, image.width - 1.0 - middle);
      const double derivative =
          0.5 * (image.at(x + 1, y) - image.at(x - 1, y)) * window(tukey, (x - middle) / reach);
      sum += derivative, weighted += derivative * x;
    }
    centroids.push_back(weighted / sum);
  }
  return {centroids, order};
}

}  // namespace

double EdgeResponse::at(double frequency_cycles_px) const {
  const auto above = std::lower_bound(cycles_px.begin(), cycles_px.end(), frequency_cycles_px);
  if (above == cycles_px.end()) return std::nan("");
  if (above == cycles_px.begin()) return modulation.front();
  const auto k = static_cast<std::size_t>(above - cycles_px.begin());
  const double share = (frequency_cycles_px - cycles_px[k - 1]) / (cycles_px[k] - cycles_px[k - 1]);
  return modulation[k - 1] + share * (modulation[k] - modulation[k - 1]);
}

EdgeResponse edge_response(const SensorImage& image, const EdgeChoices& choices) {
  const Polynomial first = edge_of(image, image.height, nullptr, choices.tukey, 1);
  const double lean = std::abs(edge_of(image, image.height, &first, choices.tukey, 1).slope());
  const int turns = static_cast<int>(std::floor(image.height * lean));
  if (turns < 1) throw InputError("the edge moves by less than a pixel over the rows of its image");
  const int rows = std::min(image.height, static_cast<int>(std::lround(turns / lean)));
  const Polynomial straight = edge_of(image, rows, &first, choices.tukey, 1);
  const Polynomial edge = edge_of(image, rows, &straight, choices.tukey, choices.order);

  const int bins = image.width * kBins;
  std::vector<double> sum(static_cast<std::size_t>(bins), 0.0), count(sum.size(), 0.0);
  const double top = edge.at(0.5 * rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int bin = static_cast<int>(std::ceil((x - (edge.at(y) - top)) * kBins));
      if (bin < 0 || bin >= bins) continue;
      sum[static_cast<std::size_t>(bin)] += image.at(x, y);
      count[static_cast<std::size_t>(bin)] += 1.0;
    }
  std::vector<double> spread;
  for (int k = 0; k < bins; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (count[at] > 0.0)
      spread.push_back(sum[at] / count[at]);
    else
      spread.push_back(spread.empty() ? image.at(0, rows / 2) : spread.back());
  }
  std::vector<double> line(spread.size(), 0.0);
  double total = 0.0, centre = 0.0;
  for (std::size_t k = 1; k + 1 < spread.size(); ++k) {
    line[k] = 0.5 * (spread[k + 1] - spread[k - 1]);
    total += line[k], centre += line[k] * static_cast<double>(k);
  }
  centre /= total;
  const double reach = std::max(centre, static_cast<double>(bins) - centre);
  for (std::size_t k = 0; k < line.size(); ++k)
    line[k] *= window(choices.tukey, (static_cast<double>(k) - centre) / reach);

  EdgeResponse response;
  response.slope = straight.slope();
  const double cosine = std::cos(std::atan(response.slope));
  double whole = 0.0;
  for (const double value : line) whole += value;
  for (int k = 0; k <= 2 * image.width; ++k) {
    const double across = static_cast<double>(k) / image.width / cosine;  // along a row it is lower
    if (across > choices.highest_cycles_px) break;
    std::complex<double> value = 0.0;
    for (std::size_t n = 0; n < line.size(); ++n)
      value += line[n] * std::polar(1.0, -2.0 * kPi * k * static_cast<double>(n) / bins);
    const double step = 2.0 * kPi * k / bins;  // of the difference over two bins
    double damped = k == 0 ? 1.0 : std::sin(step) / step;
    if (choices.divide_bins && k > 0) damped *= std::sin(0.5 * step) / (0.5 * step);
    response.cycles_px.push_back(across);
    response.modulation.push_back(std::abs(value / whole) / damped);
  }
  return response;
}

}  // namespace ifov::studies
