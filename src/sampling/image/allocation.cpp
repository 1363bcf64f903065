#include "sampling/image/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ifov::sampling {

namespace {

constexpr int kSteps = 5, kBisections = 22, kWeightRounds = 2, kPoolingSteps = 4, kPriceSteps = 4;
/// By what the price falls until no column is above its limit, how often at most, and how often the step is halved then.
constexpr double kFall = 0.25;
constexpr int kFalls = 12, kHalvings = 8, kFallRounds = 3;
constexpr double kNeighbours = 3.0;
/// Share of the columns' weights that all have alike. Multipliers alone leave what no limit asks for to chance: a tree whose near infrared
/// is noisy gets no value while another column is the dearest.
constexpr double kEven = 0.5;
constexpr double kPilotCount = Allocation::kPilotAcross * Allocation::kPilotDown;

constexpr double kNotPooled = std::numeric_limits<double>::infinity();

double square(double x) { return x * x; }

/// In lanes, which the compiler may take together.
double dot(const double* a, const double* b, std::size_t count) {
  constexpr std::size_t kLanes = 8;
  double lanes[kLanes] = {};
  std::size_t c = 0;
  for (; c + kLanes <= count; c += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += a[c + k] * b[c + k];
  double sum = 0.0;
  for (; c < count; ++c) sum += a[c] * b[c];
  for (const double lane : lanes) sum += lane;
  return sum;
}

/// What pooling leaves of a mean's variance `own`, as LikePixels::shrink() weighs it, where the others say as much as
/// kNeighbours pixels and differ by `between`; and the derivative of what it leaves.
double pooled_share(double own, double between) {
  if (between == kNotPooled) return 1.0;
  const double others = between + own / kNeighbours;
  return others / (own + others);
}
double pooled_slope(double own, double between) {
  const double others = between + own / kNeighbours, both = own + others;
  return (others * others + own * own / kNeighbours) / (both * both);
}

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
  std::vector<Sizes> chosen_by(pixels.size()), judged_by(pixels.size());
  std::vector<double> shares;
  for (const SurveyedPixel& pixel : pixels)
    shares.push_back(pixel.share > 0.0 ? pixel.share : 1.0 / static_cast<double>(pixels.size()));
  std::vector<double> error(judged.size());  // by judged column, over its limit

  // By judged column and over its limit.
  const std::size_t count = judged.size();
  std::vector<double> direct(pixels.size() * count), rest(direct.size()), between(direct.size(), kNotPooled);
  for (std::size_t p = 0; p < pixels.size(); ++p)
    for (std::size_t k = 0; k < count; ++k) {
      const LevelVariances& of = pixels[p].judged_by;
      const double over = 1.0 / limit[judged[k]];
      direct[p * count + k] = of.direct[judged[k]] * over;
      rest[p * count + k] = of.rest[judged[k]] * over;
      if (!of.between.empty()) between[p * count + k] = of.between[judged[k]] * over;
    }

  const auto take_sizes = [&] {
    const double even = kEven / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k)
      column_weight_[judged[k]] = (even + (1.0 - kEven) * multiplier[k]) / limit[judged[k]];
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      chosen_by[p] = sizes(pixels[p].chosen_by);
      judged_by[p] = sizes(pixels[p].judged_by);
    }
  };
  // At the price that stands.
  const auto take_errors = [&] {
    std::fill(error.begin(), error.end(), 0.0);
    planned_direct_ = planned_rest_ = 0.0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const Numbers n = numbers(chosen_by[p]);
      const double share = shares[p];
      planned_direct_ += share * n.direct;
      planned_rest_ += share * n.rest;
      const double of_direct = direct_left(share, n.direct), of_rest = rest_left(1.0, kNotPooled, n.rest);
      const double *d = &direct[p * count], *r = &rest[p * count], *b = &between[p * count];
      if (pixels[p].judged_by.between.empty()) {
        for (std::size_t k = 0; k < count; ++k) error[k] += d[k] * of_direct + share * of_rest * r[k];
      } else {
        constexpr double kLeast = 1e-300;  // instead of nothing over nothing
        for (std::size_t k = 0; k < count; ++k) {
          const double own = of_rest * r[k], others = b[k] + own / kNeighbours;
          error[k] += d[k] * of_direct + share * own * others / (own + others + kLeast);
        }
      }
    }
  };
  const auto left = [&](std::size_t p) {
    const Numbers n = numbers(chosen_by[p]);
    return direct_left(judged_by[p].direct, n.direct) +
           rest_left(judged_by[p].rest, judged_by[p].between, n.rest);
  };
  // At which no pixel gets more than the least: beyond it errors do not change.
  const auto dearest = [&] {
    double price = 0.0;
    for (const Sizes& of : chosen_by) price = std::max(price, price_of_least(of));
    return price > 0.0 ? price : 1.0;
  };
  // The weights say how columns share, and add up to 1; the price is scanned on what they come to together.
  const auto take_price = [&] {
    const auto over = [&] {
      double sum = 0.0;
      for (std::size_t p = 0; p < pixels.size(); ++p) sum += shares[p] * left(p);
      return sum;
    };
    if (price_ == 1.0) {
      double low = -60.0, high = std::log(dearest());
      for (int k = 0; k < kBisections; ++k) {
        price_ = std::exp(0.5 * (low + high));
        (over() > 1.0 ? high : low) = std::log(price_);
      }
      return;
    }
    // Near where it was: the error goes about with the root of the price.
    for (int k = 0; k < kPriceSteps; ++k) {
      const double now = over();
      if (!(now > 0.0)) return;
      price_ = std::min(price_ / (now * now), dearest());
    }
  };
  // Of the pilot, which leave least, numbers being what they are.
  const auto take_weights = [&] {
    double main_direct = 0.0, main_rest = 0.0, of_direct = 0.0, of_rest = 0.0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
      const Numbers n = numbers(chosen_by[p]);
      const double share = shares[p];
      main_direct += share * judged_by[p].direct * std::pow(kPilotCount, kExponent - 1.0) *
                     std::pow(n.direct, -kExponent);
      main_rest += share * judged_by[p].rest / n.rest;
      of_direct += share * judged_by[p].direct / kPilotCount;
      of_rest += share * judged_by[p].rest / kPilotWhole;
    }
    pilot_direct_weight_ = main_direct + of_direct > 0.0 ? main_direct / (main_direct + of_direct) : 0.0;
    pilot_rest_weight_ = main_rest + of_rest > 0.0 ? main_rest / (main_rest + of_rest) : 0.0;
  };
  for (int round = 0; round < kWeightRounds && !judged.empty(); ++round) {
    for (int step = 0; step < kSteps; ++step) {
      take_sizes();
      take_price();
      take_errors();
      double sum = 0.0;
      for (std::size_t k = 0; k < judged.size(); ++k) sum += multiplier[k] *= error[k];
      if (!(sum > 0.0)) break;
      for (double& m : multiplier) m /= sum;
    }
    take_weights();
  }
  if (judged.empty()) return;
  take_sizes();
  take_price();
  take_errors();
  // No column above its limit, and below it by the standard error that what is planned has from so few pixels: what is over is taken
  // from the price, which moves all columns alike to first order.
  double sum = 0.0, squares = 0.0;
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    const double of_pixel = shares[p] * left(p);
    sum += of_pixel;
    squares += of_pixel * of_pixel;
  }
  constexpr double kMostMargin = 0.25;
  const double margin =
      sum > 0.0
          ? std::min(kMostMargin,
                     std::sqrt(std::max(0.0, squares - sum * sum / static_cast<double>(pixels.size()))) / sum)
          : 0.0;
  const auto is_within = [&](double price) {
    price_ = price;
    take_errors();
    return *std::max_element(error.begin(), error.end()) <= 1.001 * (1.0 - margin);
  };
  // Where the price falls, numbers grow, and pilots are to count for less.
  const double start = price_;
  for (int round = 0; round < kFallRounds; ++round) {
    double within = start, beyond = start;
    for (int k = 0; k < kFalls && !is_within(within); ++k) {
      beyond = within;
      within *= kFall;
    }
    for (int k = 0; k < kHalvings && beyond > within; ++k) {
      const double middle = std::sqrt(within * beyond);
      (is_within(middle) ? within : beyond) = middle;
    }
    price_ = within;
    take_errors();
    if (beyond == within) break;
    if (round + 1 < kFallRounds) take_weights();
  }
  for (std::size_t k = 0; k < count; ++k) planned_[judged[k]] = error[k];
  planned_direct_ += kPilotCount;
  planned_rest_ += kPilotWhole;
}

double Allocation::size(std::span<const double> variance) const {
  return dot(column_weight_.data(), variance.data(), column_weight_.size());
}

Allocation::Sizes Allocation::sizes(const LevelVariances& pixel) const {
  return {size(pixel.direct), size(pixel.rest), pixel.between.empty() ? kNotPooled : size(pixel.between)};
}

double Allocation::direct_left(double variance, double direct) const {
  return variance * (square(pilot_direct_weight_) / kPilotCount + square(1.0 - pilot_direct_weight_) *
                                                                      std::pow(kPilotCount, kExponent - 1.0) *
                                                                      std::pow(direct, -kExponent));
}

double Allocation::rest_left(double variance, double between, double rest) const {
  const double own =
      variance * (square(pilot_rest_weight_) / kPilotWhole + square(1.0 - pilot_rest_weight_) / rest);
  return own > 0.0 ? own * pooled_share(own, between) : 0.0;
}

Allocation::Numbers Allocation::numbers(const Sizes& sizes) const {
  const double least = 4.0, most = static_cast<double>(most_),
               least_rest = std::min<double>(most, sizes.between == kNotPooled ? kLeastWhole : kLeastPooled);
  const double scale = std::pow(kPilotCount, kExponent - 1.0) * square(1.0 - pilot_direct_weight_);
  const double direct = std::pow(kExponent * sizes.direct * scale / price_, 1.0 / (1.0 + kExponent));
  // Where what rest_left() leaves falls by the price of a value: at first as if nothing were pooled, then by what that lowers.
  const double main = 1.0 - pilot_rest_weight_,
               unpooled = std::sqrt(sizes.rest / (price_ * rest_cost_)) * main;
  double rest = std::clamp(unpooled, least_rest, most);
  for (int k = 0; k < kPoolingSteps && sizes.between != kNotPooled && sizes.rest > 0.0; ++k) {
    const double own = sizes.rest * (square(pilot_rest_weight_) / kPilotWhole + square(main) / rest);
    rest = std::clamp(unpooled * std::sqrt(pooled_slope(own, sizes.between)), least_rest, most);
  }
  Numbers n{std::clamp(direct, least, most), rest};
  n.direct = std::max(n.direct, n.rest);
  return n;
}

double Allocation::price_of_least(const Sizes& sizes) const {
  const double least = 4.0, least_rest = sizes.between == kNotPooled ? kLeastWhole : kLeastPooled,
               scale = std::pow(kPilotCount, kExponent - 1.0) * square(1.0 - pilot_direct_weight_);
  return std::max(kExponent * sizes.direct * scale * std::pow(least, -1.0 - kExponent),
                  sizes.rest / rest_cost_ * square((1.0 - pilot_rest_weight_) / least_rest));
}

bool Allocation::is_cut(const Sizes& sizes) const {
  return numbers(sizes).direct >= static_cast<double>(most_);
}

PixelPlan Allocation::plan(const Sizes& sizes) const {
  const Numbers n = numbers(sizes);
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
