#include "radiometry/node_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiometry/node_trial.h"
#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr std::size_t kAtOnce = 4;  // sums side by side, for each waits for itself

/// Sums of products with a row each.
std::array<double, kAtOnce> amounts_of(std::span<const double> weighted,
                                       std::span<const std::vector<double>> rows) {
  std::array<double, kAtOnce> sum{};
  std::array<const double*, kAtOnce> row;
  for (std::size_t k = 0; k < kAtOnce; ++k) row[k] = rows[std::min(k, rows.size() - 1)].data();
  for (std::size_t i = 0; i < weighted.size(); ++i)
    for (std::size_t k = 0; k < kAtOnce; ++k) sum[k] += weighted[i] * row[k][i];
  return sum;
}

}  // namespace

NodeShapes::NodeShapes(const ChannelGrid& grid, std::span<const std::span<const double>> surfaces,
                       const NodeDemands& demands) {
  measure_.resize(grid.size());
  for (std::size_t q = 0; q < grid.size(); ++q) measure_[q] = grid.response[q] * grid.reference[q];
  const auto add = [&](auto value, double least) {
    std::vector<double> shape(grid.size());
    double mean = 0.0, total = 0.0;
    for (std::size_t q = 0; q < grid.size(); ++q) {
      shape[q] = value(q);
      mean += measure_[q] * shape[q];
      total += measure_[q];
    }
    for (double& v : shape) v /= std::max(mean / total, least);
    shapes_.push_back(std::move(shape));
  };
  for (const std::span<const double> surface : surfaces)
    add([&](std::size_t q) { return surface[q]; }, std::sqrt(kDarkShare));
  first_of_air_ = shapes_.size();
  if (!grid.seen.empty()) add([&](std::size_t q) { return grid.seen[q]; }, std::sqrt(kDarkShare));
  if (!grid.sky.empty())
    add([&](std::size_t q) { return grid.sky[q] / (std::numbers::pi * grid.bright[q]); },
        std::sqrt(kDarkShare));
  for (const std::vector<double>& lamp : lamps_at(grid, demands)) {
    ++emissions_;
    add([&](std::size_t q) { return lamp[q] / grid.bright[q]; }, std::sqrt(kDarkShare));
  }
  for (const double temperature : judged_temperatures_k(demands)) {
    ++emissions_;
    add([&](std::size_t q) { return planck_w_m2_sr_um(grid.wavelength_um[q], temperature) / grid.bright[q]; },
        std::sqrt(kDarkShare));
  }
}

std::vector<std::vector<double>> NodeShapes::ways_to_divide(const TrialPart& part) const {
  const std::vector<std::uint32_t>& points = part.part.points;
  if (!(part.variance > 0.0) || points.size() < 2) return {};
  std::vector<std::vector<double>> ways{part.part.variable};
  for (std::size_t s = first_of_air_; s < shapes_.size() - emissions_; ++s) {
    double mean = 0.0, total = 0.0;
    for (const std::uint32_t q : points) mean += measure_[q] * shapes_[s][q], total += measure_[q];
    std::vector<double>& way = ways.emplace_back();
    for (const std::uint32_t q : points) way.push_back(shapes_[s][q] - mean / total);
  }
  return ways;
}

TrialPart NodeShapes::analysed(std::vector<std::uint32_t> points) const {
  const std::size_t count = points.size();
  double total = 0.0;
  for (const std::uint32_t q : points) total += measure_[q];
  std::vector<std::vector<double>> deviation;
  TrialPart result;
  for (const auto& shape : shapes_) {
    double mean = 0.0;
    for (const std::uint32_t q : points) mean += measure_[q] / total * shape[q];
    auto& d = deviation.emplace_back(count);
    for (std::size_t i = 0; i < count; ++i) {
      d[i] = shape[points[i]] - mean;
      result.variance += measure_[points[i]] * d[i] * d[i];
    }
  }
  // Power iteration, from the sum of all deviations' squares as a start that no component is orthogonal to.
  std::vector<double> component(count);
  for (std::size_t i = 0; i < count; ++i)
    component[i] = static_cast<double>(i) - 0.5 * static_cast<double>(count - 1);
  double along = 0.0;
  std::vector<double> weighted(count);
  for (int step = 0; step < 12; ++step) {
    double norm = 0.0;
    for (std::size_t i = 0; i < count; ++i) norm += measure_[points[i]] * component[i] * component[i];
    if (!(norm > 0.0)) break;
    for (double& value : component) value /= std::sqrt(norm);
    std::vector<double> next(count, 0.0);
    along = 0.0;
    for (std::size_t i = 0; i < count; ++i) weighted[i] = measure_[points[i]] * component[i];
    for (std::size_t first = 0; first < deviation.size(); first += kAtOnce) {
      const std::size_t some = std::min(kAtOnce, deviation.size() - first);
      const std::array<double, kAtOnce> amounts =
          amounts_of(weighted, std::span(deviation).subspan(first, some));
      for (std::size_t k = 0; k < some; ++k) {
        const std::vector<double>& d = deviation[first + k];
        along += amounts[k] * amounts[k];
        for (std::size_t i = 0; i < count; ++i) next[i] += amounts[k] * d[i];
      }
    }
    if (along <= 0.0) break;
    component = std::move(next);
  }
  result.residual = std::max(0.0, result.variance - along);
  result.part = {std::move(points), std::move(component), 1};
  return result;
}

}  // namespace ifov::radiometry
