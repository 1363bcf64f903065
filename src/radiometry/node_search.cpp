#include "radiometry/node_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr int kTemperatures = 5;  // at which emission is checked, from the coldest to the hottest
constexpr std::size_t kMostInPairs =
    16;  // products of different surfaces are checked among the most varied ones
constexpr double kDarkShare = 1e-2;

std::vector<double> temperatures_k(const NodeDemands& demands) {
  std::vector<double> result;
  if (demands.hottest_k <= 0.0) return result;
  for (int i = 0; i < kTemperatures; ++i)
    result.push_back(demands.coldest_k *
                     std::pow(demands.hottest_k / demands.coldest_k, i / (kTemperatures - 1.0)));
  return result;
}

/// One source of light and the surfaces it met on its way, as indices; -1 for none.
struct Product {
  std::size_t source;
  std::array<int, 3> surfaces;
};

/// The products that a rule is judged by, with their channel radiance by full integration.
class Trial {
 public:
  Trial(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces, const NodeDemands& demands)
      : surfaces_(surfaces), seen_(grid.seen), reflections_(demands.reflections) {
    sources_.push_back(grid.irradiance);
    if (!grid.sky.empty()) sources_.push_back(grid.sky);
    for (std::vector<double>& source : sources_)
      for (double& value : source) value /= std::numbers::pi;
    first_thermal_ = sources_.size();
    for (const double temperature : temperatures_k(demands)) {
      std::vector<double> planck(grid.size());
      for (std::size_t q = 0; q < grid.size(); ++q)
        planck[q] = planck_w_m2_sr_um(grid.wavelength_um[q], temperature);
      sources_.push_back(std::move(planck));
    }
    double white = 0.0;
    for (std::size_t q = 0; q < grid.size(); ++q) white += grid.response[q] * grid.reference[q];
    choose_products(grid);
    for (const Product& product : products_) {
      double sum = 0.0, scale = 0.0;
      for (std::size_t q = 0; q < grid.size(); ++q) {
        double value = grid.response[q] * sources_[product.source][q] * (seen_.empty() ? 1.0 : seen_[q]);
        scale += value;
        for (const int surface : product.surfaces)
          if (surface >= 0) value *= surfaces_[static_cast<std::size_t>(surface)][q];
        sum += value;
      }
      // What a surface emits is what it does not reflect: the smaller of the two is what an error hurts.
      const bool thermal = product.source >= first_thermal_;
      const double judged = thermal ? std::min(sum, scale - sum) : sum;
      expected_.push_back(sum);
      scale_.push_back(std::max({judged, kDarkShare * white, thermal ? 0.1 * scale : 0.0, grid.least_radiance}));
    }
  }

  struct Errors {
    double worst = 0.0;
    double mean = 0.0;  ///< of fourth powers: falls where many products get better and the worst does not yet
  };
  Errors errors(const NodeRule& rule) const {
    const std::size_t nodes = rule.node_count();
    std::vector<std::vector<double>> factors(surfaces_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < surfaces_.size(); ++s) rule.project_factor(surfaces_[s], factors[s]);
    std::vector<std::vector<double>> sources(sources_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < sources_.size(); ++s) rule.project_source(sources_[s], sources[s]);
    std::vector<double> seen(nodes, 1.0);
    if (!seen_.empty()) rule.project_seen(seen_, seen);
    Errors result;
    for (std::size_t p = 0; p < products_.size(); ++p) {
      double sum = 0.0;
      for (std::size_t i = 0; i < nodes; ++i) {
        double value = rule.weight(i) * sources[products_[p].source][i] * seen[i];
        for (const int surface : products_[p].surfaces)
          if (surface >= 0) value *= factors[static_cast<std::size_t>(surface)][i];
        sum += value;
      }
      const double error = std::abs(sum - expected_[p]) / scale_[p];
      result.worst = std::max(result.worst, error);
      result.mean += std::pow(error, 4) / static_cast<double>(products_.size());
    }
    return result;
  }

 private:
  void choose_products(const ChannelGrid& grid) {
    if (!seen_.empty())
      for (std::size_t source = 0; source < sources_.size(); ++source) products_.push_back({source, {-1, -1, -1}});
    std::vector<std::pair<double, int>> by_variation;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      double mean = 0.0, square = 0.0;
      for (std::size_t q = 0; q < grid.size(); ++q) {
        mean += grid.response[q] * surfaces_[s][q];
        square += grid.response[q] * surfaces_[s][q] * surfaces_[s][q];
      }
      const double variance = square - mean * mean;
      by_variation.emplace_back(mean > 0.0 ? -variance / (mean * mean) : 0.0, static_cast<int>(s));
    }
    std::sort(by_variation.begin(), by_variation.end());
    for (std::size_t rank = 0; rank < by_variation.size(); ++rank) {
      const int a = by_variation[rank].second;
      for (std::size_t source = 0; source < sources_.size(); ++source)
        products_.push_back({source, {a, -1, -1}});
      add_products(a, a);
      for (std::size_t other = 0; rank < kMostInPairs && other < rank; ++other)
        add_products(a, by_variation[other].second);
    }
  }

  void add_products(int a, int b) {
    if (reflections_ >= 2)
      for (std::size_t source = 0; source < sources_.size(); ++source)
        products_.push_back({source, {a, b, -1}});
    if (reflections_ < 3) return;
    products_.push_back({0, {a, a, b}});
    if (a != b) products_.push_back({0, {a, b, b}});
  }

  std::span<const std::vector<double>> surfaces_;
  std::span<const double> seen_;
  int reflections_;
  std::size_t first_thermal_ = 1;
  std::vector<std::vector<double>> sources_;  // Sun and sky on a white surface, the sky alone, blackbodies
  std::vector<Product> products_;
  std::vector<double> expected_, scale_;
};

/// A part of the channel with what tells how well its nodes stand for it.
struct TrialPart {
  ChannelPart part;
  double variance = 0.0;  // of the spectra within it, times its measure
  double residual = 0.0;  // what is left of that when they are taken as linear in the part's variable
  double left() const { return part.order == 1 ? variance : residual; }
};

/// Spectra as deviations that matter equally: reflectances by their channel mean (of 0.1 at least, the square
/// root of kDarkShare), blackbodies by the reference radiance.
class Shapes {
 public:
  Shapes(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces, const NodeDemands& demands) {
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
    for (const auto& surface : surfaces)
      add([&](std::size_t q) { return surface[q]; }, std::sqrt(kDarkShare));
    if (!grid.seen.empty()) add([&](std::size_t q) { return grid.seen[q]; }, std::sqrt(kDarkShare));
    if (!grid.sky.empty())
      add([&](std::size_t q) { return grid.sky[q] / (std::numbers::pi * grid.bright[q]); }, std::sqrt(kDarkShare));
    for (const double temperature : temperatures_k(demands))
      add(
          [&](std::size_t q) {
            return planck_w_m2_sr_um(grid.wavelength_um[q], temperature) / grid.bright[q];
          },
          std::sqrt(kDarkShare));
  }

  /// Finds the first principal component of the shapes over the part, which becomes its variable.
  TrialPart analysed(std::vector<std::uint32_t> points) const {
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
    for (int step = 0; step < 12; ++step) {
      double norm = 0.0;
      for (std::size_t i = 0; i < count; ++i) norm += measure_[points[i]] * component[i] * component[i];
      if (!(norm > 0.0)) break;
      for (double& value : component) value /= std::sqrt(norm);
      std::vector<double> next(count, 0.0);
      along = 0.0;
      for (const auto& d : deviation) {
        double amount = 0.0;
        for (std::size_t i = 0; i < count; ++i) amount += measure_[points[i]] * component[i] * d[i];
        along += amount * amount;
        for (std::size_t i = 0; i < count; ++i) next[i] += amount * d[i];
      }
      if (along <= 0.0) break;
      component = std::move(next);
    }
    result.residual = std::max(0.0, result.variance - along);
    result.part = {std::move(points), std::move(component), 1};
    return result;
  }

 private:
  std::vector<double> measure_;
  std::vector<std::vector<double>> shapes_;
};

/// Two nodes for a part that has one, where `pairs` are allowed; two parts for a part that has two. False where nothing
/// more can be done.
bool refine(std::vector<TrialPart>& parts, std::size_t which, bool pairs, const Shapes& shapes) {
  TrialPart& part = parts[which];
  if (!(part.left() > 0.0) || part.part.points.size() < 2) return false;
  if (part.part.order == 1 && pairs) {
    part.part.order = 2;
    return true;
  }
  std::vector<std::uint32_t> low, high;
  for (std::size_t i = 0; i < part.part.points.size(); ++i)
    (part.part.variable[i] < 0.0 ? low : high).push_back(part.part.points[i]);
  if (low.empty() || high.empty()) return false;
  part = shapes.analysed(std::move(low));
  parts.push_back(shapes.analysed(std::move(high)));
  return true;
}

/// Refines the part that leaves most of the spectra's variance.
bool refine_worst(std::vector<TrialPart>& parts, const Shapes& shapes) {
  const auto worst = std::max_element(
      parts.begin(), parts.end(), [](const TrialPart& a, const TrialPart& b) { return a.left() < b.left(); });
  return refine(parts, static_cast<std::size_t>(worst - parts.begin()), true, shapes);
}

NodeRule rule_of(const ChannelGrid& grid, const std::vector<TrialPart>& parts) {
  std::vector<ChannelPart> plain;
  for (const TrialPart& part : parts) plain.push_back(part.part);
  return NodeRule(grid, plain);
}

}  // namespace

FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
                    const NodeDemands& demands) {
  std::vector<std::uint32_t> all(grid.size());
  std::iota(all.begin(), all.end(), 0u);
  if (grid.size() == 1 || (surfaces.empty() && grid.seen.empty())) {
    const ChannelPart whole{std::move(all), {}, 1};
    return {NodeRule(grid, std::span(&whole, 1)), 0.0};
  }
  const Trial trial(grid, surfaces, demands);
  const Shapes shapes(grid, surfaces, demands);
  std::vector<TrialPart> parts{shapes.analysed(std::move(all))};
  NodeRule rule = rule_of(grid, parts);
  Trial::Errors errors = trial.errors(rule);
  // Behind lines of absorption the measure varies by orders of magnitude, which no line follows: there the parts have one
  // node each, and the best of all that can be divided is.
  const bool pairs = grid.seen.empty();
  while (errors.worst > demands.tolerance && rule.node_count() < demands.most_nodes) {
    if (pairs) {
      if (!refine_worst(parts, shapes)) break;
      rule = rule_of(grid, parts);
      errors = trial.errors(rule);
      continue;
    }
    std::optional<std::vector<TrialPart>> best;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::vector<TrialPart> finer = parts;
      if (!refine(finer, k, false, shapes)) continue;
      NodeRule finer_rule = rule_of(grid, finer);
      const Trial::Errors finer_errors = trial.errors(finer_rule);
      if (best && finer_errors.mean >= errors.mean) continue;
      best = std::move(finer);
      rule = std::move(finer_rule);
      errors = finer_errors;
    }
    if (!best) break;
    parts = std::move(*best);
  }
  return {std::move(rule), errors.worst};
}

}  // namespace ifov::radiometry
