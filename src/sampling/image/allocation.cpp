#include "sampling/image/allocation.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

namespace {

constexpr int kSteps = 10, kBisections = 26, kWeightRounds = 2;
constexpr double kPilotCount = Allocation::kPilotAcross * Allocation::kPilotDown;

double square(double x) { return x * x; }

/// Even numbers whose product is next to a number of strata, above or below it by its logarithm.
void set_sides(double count, PixelPlan& plan) {
  plan.across = plan.down = 2;
  double nearest = std::abs(std::log(count / 4.0));
  for (int down = 2; down <= Allocation::kMostSide; down += 2)
    for (int across = down; across <= down + 2 && across <= Allocation::kMostSide; across += 2) {
      const double distance = std::abs(std::log(count / (across * down)));
      if (distance >= nearest) continue;
      nearest = distance;
      plan.across = across;
      plan.down = down;
    }
}

}  // namespace

Allocation::Allocation(std::span<const SurveyedPixel> pixels, std::vector<double> limit, double rest_cost,
                       std::uint32_t most)
    : rest_cost_(rest_cost), most_(most) {
  const std::size_t columns = limit.size();
  std::vector<std::size_t> judged;
  for (std::size_t c = 0; c < columns; ++c)
    if (std::isfinite(limit[c]) && limit[c] > 0.0) judged.push_back(c);
  column_weight_.assign(columns, 0.0);
  planned_.assign(columns, 0.0);
  std::vector<double> multiplier(judged.size(),
                                 1.0 / static_cast<double>(std::max<std::size_t>(1, judged.size())));
  std::vector<double> direct_size(pixels.size()), rest_size(pixels.size()), true_direct(pixels.size()),
      true_rest(pixels.size());
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, pixels.size()));
  // In units of the limit: what the pilot leaves whatever comes after it, and the rest, by column.
  std::vector<double> pilot_direct(columns, 0.0), pilot_rest(columns, 0.0), error(columns);
  for (const SurveyedPixel& pixel : pixels)
    for (const std::size_t c : judged) {
      pilot_direct[c] += share * pixel.judged_by.direct[c] / kPilotCount / limit[c];
      pilot_rest[c] += share * pixel.judged_by.rest[c] / kPilotWhole / limit[c];
    }

  const auto take_sizes = [&] {
    for (std::size_t k = 0; k < judged.size(); ++k)
      column_weight_[judged[k]] = multiplier[k] / limit[judged[k]];
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      direct_size[p] = this->direct_size(pixels[p].chosen_by.direct);
      rest_size[p] = this->rest_size(pixels[p].chosen_by.rest);
      true_direct[p] = this->direct_size(pixels[p].judged_by.direct);
      true_rest[p] = this->rest_size(pixels[p].judged_by.rest);
    }
  };
  // By column, over the limit, at the price that stands.
  const auto take_errors = [&] {
    std::fill(error.begin(), error.end(), 0.0);
    planned_direct_ = planned_rest_ = 0.0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const Numbers n = numbers(direct_size[p], rest_size[p]);
      planned_direct_ += share * n.direct;
      planned_rest_ += share * n.rest;
      const double of_direct = share * square(1.0 - pilot_direct_weight_) *
                               std::pow(kPilotCount, kExponent - 1.0) * std::pow(n.direct, -kExponent),
                   of_rest = share * square(1.0 - pilot_rest_weight_) / n.rest;
      for (const std::size_t c : judged)
        error[c] +=
            (pixels[p].judged_by.direct[c] * of_direct + pixels[p].judged_by.rest[c] * of_rest) / limit[c];
    }
    for (const std::size_t c : judged)
      error[c] += square(pilot_direct_weight_) * pilot_direct[c] + square(pilot_rest_weight_) * pilot_rest[c];
  };
  // The multipliers say how columns share; the price is scanned on what they come to together.
  const auto take_price = [&] {
    double low = -60.0, high = 60.0;
    for (int k = 0; k < kBisections; ++k) {
      price_ = std::exp(0.5 * (low + high));
      double sum = 0.0;
      for (std::size_t p = 0; p < pixels.size(); ++p) {
        const Numbers n = numbers(direct_size[p], rest_size[p]);
        sum += share * (true_direct[p] * square(1.0 - pilot_direct_weight_) *
                            std::pow(kPilotCount, kExponent - 1.0) * std::pow(n.direct, -kExponent) +
                        true_rest[p] * square(1.0 - pilot_rest_weight_) / n.rest);
      }
      double of_pilot = 0.0, all = 0.0;
      for (std::size_t k2 = 0; k2 < judged.size(); ++k2) {
        of_pilot += multiplier[k2] * (square(pilot_direct_weight_) * pilot_direct[judged[k2]] +
                                      square(pilot_rest_weight_) * pilot_rest[judged[k2]]);
        all += multiplier[k2];
      }
      (sum + of_pilot > all ? high : low) = std::log(price_);
    }
  };
  for (int round = 0; round < kWeightRounds && !judged.empty(); ++round) {
    for (int step = 0; step < kSteps; ++step) {
      take_sizes();
      take_price();
      take_errors();
      double sum = 0.0;
      for (std::size_t k = 0; k < judged.size(); ++k) sum += multiplier[k] *= error[judged[k]];
      if (!(sum > 0.0)) break;
      for (double& m : multiplier) m /= sum;
    }
    // The weight of the pilot that leaves least, numbers being what they are.
    double main_direct = 0.0, main_rest = 0.0, of_direct = 0.0, of_rest = 0.0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const Numbers n = numbers(direct_size[p], rest_size[p]);
      main_direct += true_direct[p] * std::pow(kPilotCount, kExponent - 1.0) * std::pow(n.direct, -kExponent);
      main_rest += true_rest[p] / n.rest;
      of_direct += true_direct[p] / kPilotCount;
      of_rest += true_rest[p] / kPilotWhole;
    }
    pilot_direct_weight_ = main_direct + of_direct > 0.0 ? main_direct / (main_direct + of_direct) : 0.0;
    pilot_rest_weight_ = main_rest + of_rest > 0.0 ? main_rest / (main_rest + of_rest) : 0.0;
  }
  if (judged.empty()) return;
  take_sizes();
  take_price();
  take_errors();
  // No column above its limit, and below it by the standard error that what is planned has from so few pixels: what is over is taken
  // from the price, which moves all columns alike to first order.
  double sum = 0.0, squares = 0.0;
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    const Numbers n = numbers(direct_size[p], rest_size[p]);
    const double of_pixel =
        true_direct[p] * std::pow(kPilotCount, kExponent - 1.0) * std::pow(n.direct, -kExponent) +
        true_rest[p] / n.rest;
    sum += of_pixel;
    squares += of_pixel * of_pixel;
  }
  constexpr double kMostMargin = 0.25;
  const double margin =
      sum > 0.0 ? std::min(kMostMargin, std::sqrt(std::max(0.0, squares - sum * sum * share)) / sum) : 0.0;
  for (int k = 0; k < 8; ++k) {
    double worst = 0.0;
    for (const std::size_t c : judged) worst = std::max(worst, error[c] / (1.0 - margin));
    if (worst <= 1.001 || worst == 0.0) break;
    price_ /= std::pow(worst, 2.0);
    take_errors();
  }
  for (const std::size_t c : judged) planned_[c] = error[c];
  planned_direct_ += kPilotCount;
  planned_rest_ += kPilotWhole;
}

double Allocation::direct_size(std::span<const double> variance) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < column_weight_.size(); ++c)
    if (column_weight_[c] > 0.0) sum += column_weight_[c] * variance[c];
  return sum;
}

double Allocation::rest_size(std::span<const double> variance) const { return direct_size(variance); }

Allocation::Numbers Allocation::numbers(double direct_size, double rest_size) const {
  const double least = 4.0, most = static_cast<double>(most_);
  const double scale = std::pow(kPilotCount, kExponent - 1.0) * square(1.0 - pilot_direct_weight_);
  const double direct = std::pow(kExponent * direct_size * scale / price_, 1.0 / (1.0 + kExponent));
  const double rest = std::sqrt(rest_size * square(1.0 - pilot_rest_weight_) / (price_ * rest_cost_));
  Numbers n{std::clamp(direct, least, most), std::clamp(rest, double{kLeastWhole}, most)};
  n.direct = std::max(n.direct, n.rest);
  return n;
}

bool Allocation::is_cut(double direct_size, double rest_size) const {
  return numbers(direct_size, rest_size).direct >= static_cast<double>(most_);
}

PixelPlan Allocation::plan(double direct_size, double rest_size) const {
  const Numbers n = numbers(direct_size, rest_size);
  PixelPlan plan;
  set_sides(n.direct, plan);
  plan.whole = std::min(plan.count(), static_cast<std::uint32_t>(std::lround(n.rest)));
  return plan;
}

double Allocation::direct_variance(double of_pilot, double of_main, std::uint32_t count) const {
  return square(pilot_direct_weight_) * of_pilot / kPilotCount +
         square(1.0 - pilot_direct_weight_) * of_main / count;
}

double Allocation::rest_variance(double of_pilot, double of_main, std::uint32_t whole) const {
  return square(pilot_rest_weight_) * of_pilot / kPilotWhole +
         square(1.0 - pilot_rest_weight_) * of_main / whole;
}

}  // namespace ifov::sampling
