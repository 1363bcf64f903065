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
constexpr double kOfGlow = 0.2;  // of the tolerance, where surfaces glow and are judged by all that they send

std::vector<double> temperatures_k(const NodeDemands& demands) {
  std::vector<double> result;
  if (demands.hottest_k <= 0.0) return result;
  for (int i = 0; i < kTemperatures; ++i)
    result.push_back(demands.coldest_k *
                     std::pow(demands.hottest_k / demands.coldest_k, i / (kTemperatures - 1.0)));
  return result;
}

/// Light of lamps at a grid's points, as bright in the mean as the grid's reference; those that the channel does not see are
/// left out.
std::vector<std::vector<double>> lamps_at(const ChannelGrid& grid, const NodeDemands& demands) {
  std::vector<std::vector<double>> result;
  for (const Spectrum& lamp : demands.lamps) {
    std::vector<double> light = grid.sampled(lamp);
    double mean = 0.0, bright = 0.0;
    for (std::size_t q = 0; q < grid.size(); ++q) {
      mean += grid.response[q] * light[q];
      bright += grid.response[q] * grid.bright[q];
    }
    if (!(mean > 0.0)) continue;
    for (double& value : light) value *= bright / mean;
    result.push_back(std::move(light));
  }
  return result;
}

/// One source of light and the surfaces it met on its way, as indices; -1 for none.
struct Product {
  std::size_t source;
  std::array<int, 3> surfaces;
};

/// A radiance that the scene can show, as a sum of products, and by what its error is judged.
struct Radiance {
  struct Term {
    std::size_t product;
    double factor;
  };
  std::vector<Term> terms;
  double expected = 0.0, scale = 0.0;
};

/// The radiances that a rule is judged by, with their values by full integration.
class Trial {
 public:
  Trial(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces, const NodeDemands& demands)
      : surfaces_(surfaces), seen_(grid.seen), reflections_(demands.reflections) {
    sources_.push_back(grid.irradiance);
    if (!grid.sky.empty()) sources_.push_back(grid.sky);
    for (std::vector<double>& source : sources_)
      for (double& value : source) value /= std::numbers::pi;
    // What a lamp lights may see nothing else: of a brightness that counts beside what is dark in the Sun.
    for (std::vector<double>& lamp : lamps_at(grid, demands)) sources_.push_back(std::move(lamp));
    first_thermal_ = sources_.size();
    for (const double temperature : temperatures_k(demands)) {
      std::vector<double> planck(grid.size());
      for (std::size_t q = 0; q < grid.size(); ++q)
        planck[q] = planck_w_m2_sr_um(grid.wavelength_um[q], temperature);
      sources_.push_back(std::move(planck));
    }
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
      expected_.push_back(sum);
      whole_.push_back(scale);
    }
    for (std::size_t q = 0; q < grid.size(); ++q) dark_ += kDarkShare * grid.response[q] * grid.reference[q];
    dark_ = std::max(dark_, grid.least_radiance);
    if (demands.all_glow && !seen_.empty() && sources_.size() > first_thermal_)
      judge_by_whole_radiances();
    else
      judge_by_products();
  }

  /// What surfaces emit varies little beside what they reflect: a share of it is asked for more strictly.
  double tolerance(const NodeDemands& demands) const {
    const bool glows = demands.all_glow && !seen_.empty() && sources_.size() > first_thermal_ &&
                       expected_[product(sources_.size() - 1, -1)] > 0.1 * expected_[product(0, -1)];
    return glows ? kOfGlow * demands.tolerance : demands.tolerance;
  }

  struct Errors {
    double worst = 0.0;
    /// Of fourth powers: falls where many radiances get better and the worst does not yet.
    double mean = 0.0;
  };
  Errors errors(const NodeRule& rule) const {
    const std::size_t nodes = rule.node_count();
    std::vector<std::vector<double>> factors(surfaces_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < surfaces_.size(); ++s) rule.project_factor(surfaces_[s], factors[s]);
    std::vector<std::vector<double>> sources(sources_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < sources_.size(); ++s) rule.project_source(sources_[s], sources[s]);
    std::vector<double> seen(nodes, 1.0);
    if (!seen_.empty()) rule.project_seen(seen_, seen);
    std::vector<double> difference(products_.size());
    for (std::size_t p = 0; p < products_.size(); ++p) {
      double sum = 0.0;
      for (std::size_t i = 0; i < nodes; ++i) {
        double value = rule.weight(i) * sources[products_[p].source][i] * seen[i];
        for (const int surface : products_[p].surfaces)
          if (surface >= 0) value *= factors[static_cast<std::size_t>(surface)][i];
        sum += value;
      }
      difference[p] = sum - expected_[p];
    }
    Errors result;
    for (const Radiance& radiance : radiances_) {
      double off = 0.0;
      for (const Radiance::Term& term : radiance.terms) off += term.factor * difference[term.product];
      const double error = std::abs(off) / radiance.scale;
      result.worst = std::max(result.worst, error);
      result.mean += std::pow(error, 4) / static_cast<double>(radiances_.size());
    }
    return result;
  }

 private:
  void choose_products(const ChannelGrid& grid) {
    if (!seen_.empty())
      for (std::size_t source = 0; source < sources_.size(); ++source)
        products_.push_back({source, {-1, -1, -1}});
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

  std::size_t product(std::size_t source, int a, int b = -1) const {
    return static_cast<std::size_t>(std::find_if(products_.begin(), products_.end(),
                                                 [&](const Product& p) {
                                                   return p.source == source && p.surfaces[0] == a &&
                                                          p.surfaces[1] == b && p.surfaces[2] == -1;
                                                 }) -
                                    products_.begin());
  }

  /// Each product by itself: a surface may show nothing else.
  void judge_by_products() {
    for (std::size_t p = 0; p < products_.size(); ++p) {
      // What a surface emits is what it does not reflect: the smaller of the two is what an error hurts.
      const bool thermal = products_[p].source >= first_thermal_;
      double judged = expected_[p];
      if (thermal && products_[p].surfaces[0] >= 0)
        judged = std::max(std::min(judged, whole_[p] - judged), 0.1 * whole_[p]);
      radiances_.push_back({{{p, 1.0}}, expected_[p], std::max(judged, dark_)});
    }
  }

  /// What a surface sends, in the open and facing another: what it emits, what it reflects of the Sun and the sky or of
  /// the sky alone, and what the other sends onto it. Sunlight that more surfaces met stands beside what is emitted.
  void judge_by_whole_radiances() {
    const std::size_t coldest = first_thermal_, hottest = sources_.size() - 1;
    const auto add = [&](std::vector<Radiance::Term> terms) {
      Radiance radiance{std::move(terms)};
      for (const Radiance::Term& term : radiance.terms)
        radiance.expected += term.factor * expected_[term.product];
      radiance.scale = std::max(radiance.expected, dark_);
      radiances_.push_back(std::move(radiance));
    };
    for (std::size_t p = 0; p < products_.size(); ++p) {
      const Product& given = products_[p];
      if (given.source >= first_thermal_) continue;
      const int a = given.surfaces[0], b = given.surfaces[1];
      if (given.surfaces[2] >= 0) {
        add({{product(coldest, -1), 1.0}, {product(coldest, a), -1.0}, {p, 1.0}});
      } else if (a >= 0 && b < 0) {
        for (std::size_t warm = coldest; warm <= hottest; ++warm)
          add({{product(warm, -1), 1.0}, {product(warm, a), -1.0}, {p, 1.0}});
      } else if (b >= 0) {
        for (const auto& [own, other] :
             {std::pair(coldest, coldest), {hottest, hottest}, {coldest, hottest}, {hottest, coldest}})
          for (const auto& [near, far] : {std::pair(a, b), {b, a}})
            add({{product(own, -1), 1.0},
                 {product(own, near), -1.0},
                 {product(other, near), 1.0},
                 {product(other, a, b), -1.0},
                 {p, 1.0}});
      }
    }
  }

  std::span<const std::vector<double>> surfaces_;
  std::span<const double> seen_;
  int reflections_;
  std::size_t first_thermal_ = 1;
  std::vector<std::vector<double>>
      sources_;  // Sun and sky on a white surface, the sky alone, lamps, blackbodies
  std::vector<Product> products_;
  std::vector<double> expected_, whole_;  // by product: with its surfaces, and with white ones
  double dark_ = 0.0;                     // radiances below it are not told apart from it
  std::vector<Radiance> radiances_;
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
    first_of_air_ = shapes_.size();
    if (!grid.seen.empty()) add([&](std::size_t q) { return grid.seen[q]; }, std::sqrt(kDarkShare));
    if (!grid.sky.empty())
      add([&](std::size_t q) { return grid.sky[q] / (std::numbers::pi * grid.bright[q]); },
          std::sqrt(kDarkShare));
    for (const std::vector<double>& lamp : lamps_at(grid, demands)) {
      ++emissions_;
      add([&](std::size_t q) { return lamp[q] / grid.bright[q]; }, std::sqrt(kDarkShare));
    }
    for (const double temperature : temperatures_k(demands)) {
      ++emissions_;
      add(
          [&](std::size_t q) {
            return planck_w_m2_sr_um(grid.wavelength_um[q], temperature) / grid.bright[q];
          },
          std::sqrt(kDarkShare));
    }
  }

  /// Variables at a part's points, each with both signs: the part's own, and what the air passes and sends.
  std::vector<std::vector<double>> ways_to_divide(const TrialPart& part) const {
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
  std::vector<std::vector<double>> shapes_;  // surfaces, what the air passes, the sky, what glows
  std::size_t first_of_air_ = 0, emissions_ = 0;
};

/// Two parts for one, by the sign of a variable at its points. False where all are on one side.
bool divide(std::vector<TrialPart>& parts, std::size_t which, std::span<const double> variable,
            const Shapes& shapes) {
  TrialPart& part = parts[which];
  std::vector<std::uint32_t> low, high;
  for (std::size_t i = 0; i < part.part.points.size(); ++i)
    (variable[i] < 0.0 ? low : high).push_back(part.part.points[i]);
  if (low.empty() || high.empty()) return false;
  part = shapes.analysed(std::move(low));
  parts.push_back(shapes.analysed(std::move(high)));
  return true;
}

/// Two nodes for a part that has one; two parts for a part that has two. False where nothing more can be done.
bool refine(std::vector<TrialPart>& parts, std::size_t which, const Shapes& shapes) {
  TrialPart& part = parts[which];
  if (!(part.left() > 0.0) || part.part.points.size() < 2) return false;
  if (part.part.order == 1) {
    part.part.order = 2;
    return true;
  }
  return divide(parts, which, std::vector<double>(part.part.variable), shapes);
}

/// Refines the part that leaves most of the spectra's variance.
bool refine_worst(std::vector<TrialPart>& parts, const Shapes& shapes) {
  const auto worst = std::max_element(
      parts.begin(), parts.end(), [](const TrialPart& a, const TrialPart& b) { return a.left() < b.left(); });
  return refine(parts, static_cast<std::size_t>(worst - parts.begin()), shapes);
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
  const double tolerance = trial.tolerance(demands);
  while (errors.worst > tolerance && rule.node_count() < demands.most_nodes) {
    if (pairs) {
      if (!refine_worst(parts, shapes)) break;
      rule = rule_of(grid, parts);
      errors = trial.errors(rule);
      continue;
    }
    std::optional<std::vector<TrialPart>> best;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      // Many surfaces outvote the air in the first component of all shapes.
      for (const std::vector<double>& variable : shapes.ways_to_divide(parts[k])) {
        std::vector<TrialPart> finer = parts;
        if (!divide(finer, k, variable, shapes)) continue;
        NodeRule finer_rule = rule_of(grid, finer);
        const Trial::Errors finer_errors = trial.errors(finer_rule);
        if (best && finer_errors.mean >= errors.mean) continue;
        best = std::move(finer);
        rule = std::move(finer_rule);
        errors = finer_errors;
      }
    }
    if (!best) break;
    parts = std::move(*best);
  }
  return {std::move(rule), errors.worst};
}

}  // namespace ifov::radiometry
