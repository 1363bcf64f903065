#include "radiometry/node_trial.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <utility>

#include "radiometry/node_rule.h"
#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr std::size_t kMostInPairs =
    16;                          // products of different surfaces are checked among the most varied ones
constexpr double kOfGlow = 0.2;  // of the tolerance, where surfaces glow and are judged by all that they send

}  // namespace

std::vector<double> judged_temperatures_k(const NodeDemands& demands) {
  constexpr int kTemperatures = 5;
  std::vector<double> result;
  if (demands.hottest_k <= 0.0) return result;
  for (int i = 0; i < kTemperatures; ++i)
    result.push_back(demands.coldest_k *
                     std::pow(demands.hottest_k / demands.coldest_k, i / (kTemperatures - 1.0)));
  return result;
}

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

NodeTrial::NodeTrial(const ChannelGrid& grid, std::span<const std::span<const double>> surfaces,
                     const NodeDemands& demands)
    : surfaces_(surfaces), seen_(grid.seen), reflections_(demands.reflections) {
  sources_.push_back(grid.irradiance);
  if (!grid.sky.empty()) sources_.push_back(grid.sky);
  for (std::vector<double>& source : sources_)
    for (double& value : source) value /= std::numbers::pi;
  // What a lamp lights may see nothing else: of a brightness that counts beside what is dark in the Sun.
  for (std::vector<double>& lamp : lamps_at(grid, demands)) sources_.push_back(std::move(lamp));
  first_thermal_ = sources_.size();
  for (const double temperature : judged_temperatures_k(demands)) {
    std::vector<double> planck(grid.size());
    for (std::size_t q = 0; q < grid.size(); ++q)
      planck[q] = planck_w_m2_sr_um(grid.wavelength_um[q], temperature);
    sources_.push_back(std::move(planck));
  }
  choose_products(grid);
  integrate_products(grid);
  for (std::size_t q = 0; q < grid.size(); ++q) dark_ += kDarkShare * grid.response[q] * grid.reference[q];
  dark_ = std::max(dark_, grid.least_radiance);
  if (whole_radiances(demands))
    judge_by_whole_radiances();
  else
    judge_by_products();
}

bool NodeTrial::whole_radiances(const NodeDemands& demands) const {
  return demands.all_glow && !seen_.empty() && sources_.size() > first_thermal_;
}

double NodeTrial::tolerance(const NodeDemands& demands) const {
  // The first products are of the sources alone, where there is something between surfaces and the sensor.
  const bool glows = whole_radiances(demands) && expected_[sources_.size() - 1] > 0.1 * expected_[0];
  return glows ? kOfGlow * demands.tolerance : demands.tolerance;
}

std::vector<double> NodeTrial::product_sums(const NodeRule& rule, double share) const {
  const std::size_t nodes = rule.node_count();
  const std::vector<double> none(nodes, 1.0);
  std::vector<double> factors(surfaces_.size() * nodes), lit(sources_.size() * nodes), seen(nodes, 1.0);
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    rule.project_factor(surfaces_[s], std::span(factors).subspan(s * nodes, nodes));
  if (!seen_.empty()) rule.project_seen(seen_, seen);
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const std::span<double> source = std::span(lit).subspan(s * nodes, nodes);
    rule.project_source(sources_[s], source);
    for (std::size_t i = 0; i < nodes; ++i) source[i] = share * rule.weight(i) * source[i] * seen[i];
  }
  std::vector<double> sums(products_.size());
  for (std::size_t p = 0; p < products_.size(); ++p) {
    const double* met[3];
    for (std::size_t k = 0; k < 3; ++k)
      met[k] = products_[p].surfaces[k] < 0
                   ? none.data()
                   : factors.data() + static_cast<std::size_t>(products_[p].surfaces[k]) * nodes;
    const double* source = lit.data() + products_[p].source * nodes;
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes; ++i) sum += source[i] * met[0][i] * met[1][i] * met[2][i];
    sums[p] = sum;
  }
  return sums;
}

std::vector<double> NodeTrial::radiance_errors(std::span<const double> sums) const {
  std::vector<double> errors;
  errors.reserve(radiances_.size());
  for (const Radiance& radiance : radiances_) {
    double off = 0.0;
    for (std::size_t t = radiance.first_term; t < radiance.first_term + radiance.terms; ++t)
      off += terms_[t].factor * (sums[terms_[t].product] - expected_[terms_[t].product]);
    errors.push_back(std::abs(off) / radiance.scale);
  }
  return errors;
}

NodeTrial::Errors NodeTrial::errors(const NodeRule& rule) const { return errors(product_sums(rule, 1.0)); }

NodeTrial::Errors NodeTrial::errors(std::span<const double> sums) const {
  Errors result;
  for (const double error : radiance_errors(sums)) {
    result.worst = std::max(result.worst, error);
    const double square = error * error;
    result.mean += square * square / static_cast<double>(radiances_.size());
  }
  return result;
}

std::vector<std::size_t> NodeTrial::worst_surfaces(const NodeRule& rule, std::size_t most) const {
  std::vector<double> worst(surfaces_.size(), 0.0);
  const std::vector<double> errors = radiance_errors(product_sums(rule, 1.0));
  for (std::size_t r = 0; r < radiances_.size(); ++r)
    for (std::size_t t = 0; t < radiances_[r].terms; ++t)
      for (const int surface : products_[terms_[radiances_[r].first_term + t].product].surfaces)
        if (surface >= 0) {
          double& of_surface = worst[static_cast<std::size_t>(surface)];
          of_surface = std::max(of_surface, errors[r]);
        }
  std::vector<std::size_t> order(surfaces_.size());
  for (std::size_t s = 0; s < order.size(); ++s) order[s] = s;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return worst[a] > worst[b]; });
  order.resize(std::min(most, order.size()));
  return order;
}

void NodeTrial::choose_products(const ChannelGrid& grid) {
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
    by_variation_.push_back(static_cast<std::size_t>(a));
    for (std::size_t source = 0; source < sources_.size(); ++source)
      products_.push_back({source, {a, -1, -1}});
    add_products(a, a);
    for (std::size_t other = 0; rank < kMostInPairs && other < rank; ++other)
      add_products(a, by_variation[other].second);
  }
}

void NodeTrial::add_products(int a, int b) {
  if (reflections_ >= 2)
    for (std::size_t source = 0; source < sources_.size(); ++source)
      products_.push_back({source, {a, b, -1}});
  if (reflections_ < 3) return;
  products_.push_back({0, {a, a, b}});
  if (a != b) products_.push_back({0, {a, b, b}});
}

void NodeTrial::integrate_products(const ChannelGrid& grid) {
  const std::vector<double> none(grid.size(), 1.0);
  std::vector<std::vector<double>> seen_light;
  std::vector<double> whole;
  for (const std::vector<double>& source : sources_) {
    std::vector<double>& light = seen_light.emplace_back(grid.size());
    double& scale = whole.emplace_back(0.0);
    for (std::size_t q = 0; q < grid.size(); ++q)
      scale += light[q] = grid.response[q] * source[q] * (seen_.empty() ? 1.0 : seen_[q]);
  }
  // A few sums side by side, for each waits for itself.
  constexpr std::size_t kSums = 4;
  expected_.resize(products_.size());
  for (const Product& product : products_) whole_.push_back(whole[product.source]);
  for (std::size_t first = 0; first < products_.size(); first += kSums) {
    std::array<std::array<const double*, 4>, kSums> rows;
    for (std::size_t k = 0; k < kSums; ++k) {
      const Product& product = products_[std::min(first + k, products_.size() - 1)];
      rows[k][0] = seen_light[product.source].data();
      for (std::size_t i = 0; i < 3; ++i)
        rows[k][i + 1] = product.surfaces[i] < 0
                             ? none.data()
                             : surfaces_[static_cast<std::size_t>(product.surfaces[i])].data();
    }
    std::array<double, kSums> sum{};
    for (std::size_t q = 0; q < grid.size(); ++q)
      for (std::size_t k = 0; k < kSums; ++k)
        sum[k] += rows[k][0][q] * rows[k][1][q] * rows[k][2][q] * rows[k][3][q];
    for (std::size_t k = 0; k < kSums && first + k < products_.size(); ++k) expected_[first + k] = sum[k];
  }
}

/// Each product by itself: a surface may show nothing else.
void NodeTrial::judge_by_products() {
  for (std::size_t p = 0; p < products_.size(); ++p) {
    // What a surface emits is what it does not reflect: the smaller of the two is what an error hurts.
    const bool thermal = products_[p].source >= first_thermal_;
    double judged = expected_[p];
    if (thermal && products_[p].surfaces[0] >= 0)
      judged = std::max(std::min(judged, whole_[p] - judged), 0.1 * whole_[p]);
    radiances_.push_back({terms_.size(), 1, expected_[p], std::max(judged, dark_)});
    terms_.push_back({p, 1.0});
  }
}

/// What a surface sends, in the open and facing another: what it emits, what it reflects of the Sun and the sky or of
/// the sky alone, and what the other sends onto it. Sunlight that more surfaces met stands beside what is emitted.
void NodeTrial::judge_by_whole_radiances() {
  const std::size_t coldest = first_thermal_, hottest = sources_.size() - 1;
  // Where products of a source and at most two surfaces stand: without one, with one, twice with it, with two.
  const std::size_t sources = sources_.size();
  std::vector<std::size_t> alone(sources), once(sources * surfaces_.size()), twice(once.size());
  std::map<std::array<std::size_t, 3>, std::size_t> pairs;
  for (std::size_t p = 0; p < products_.size(); ++p) {
    const Product& of = products_[p];
    if (of.surfaces[2] >= 0) continue;
    if (of.surfaces[0] < 0) {
      alone[of.source] = p;
      continue;
    }
    const auto a = static_cast<std::size_t>(of.surfaces[0]), b = static_cast<std::size_t>(of.surfaces[1]);
    if (of.surfaces[1] < 0)
      once[a * sources + of.source] = p;
    else if (a == b)
      twice[a * sources + of.source] = p;
    else
      pairs[{of.source, a, b}] = p;
  }
  const auto product = [&](std::size_t source, int first, int second = -1) {
    if (first < 0) return alone[source];
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    if (second < 0) return once[a * sources + source];
    return a == b ? twice[a * sources + source] : pairs.at({source, a, b});
  };
  const auto add = [&](std::initializer_list<Radiance::Term> terms) {
    Radiance radiance{terms_.size(), terms.size()};
    for (const Radiance::Term& term : terms) radiance.expected += term.factor * expected_[term.product];
    radiance.scale = std::max(radiance.expected, dark_);
    terms_.insert(terms_.end(), terms);
    radiances_.push_back(radiance);
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

}  // namespace ifov::radiometry
