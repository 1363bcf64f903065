#include "radiometry/node_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "radiometry/planck.h"

namespace ifov::radiometry {
namespace {

constexpr std::array kTemperatures_k{200.0, 300.0, 450.0, 700.0, 1000.0};
constexpr std::size_t kMostInPairs = 16;  // products of different surfaces are checked among the most varied ones
constexpr double kDarkShare = 1e-3;       // of a white surface's radiance: below it errors count as of it

/// One source of light and the surfaces it met on its way, as indices; -1 for none.
struct Product {
  std::size_t source;
  std::array<int, 3> surfaces;
};

/// The products that a rule is judged by, with their channel radiance by full integration.
class Trial {
 public:
  Trial(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces) : surfaces_(surfaces) {
    sources_.push_back(grid.irradiance);
    for (double& value : sources_[0]) value /= std::numbers::pi;
    for (const double temperature : kTemperatures_k) {
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
        double value = grid.response[q] * sources_[product.source][q];
        scale += value;
        for (const int surface : product.surfaces)
          if (surface >= 0) value *= surfaces_[static_cast<std::size_t>(surface)][q];
        sum += value;
      }
      // What a surface emits is what it does not reflect: the smaller of the two is what an error hurts.
      const bool thermal = product.source > 0;
      const double judged = thermal ? std::min(sum, scale - sum) : sum;
      expected_.push_back(sum);
      scale_.push_back(std::max(judged, kDarkShare * std::max(white, thermal ? scale : 0.0)));
    }
  }

  double worst_error(const NodeRule& rule) const {
    const std::size_t nodes = rule.node_count();
    std::vector<std::vector<double>> factors(surfaces_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < surfaces_.size(); ++s) rule.project_factor(surfaces_[s], factors[s]);
    std::vector<std::vector<double>> sources(sources_.size(), std::vector<double>(nodes));
    for (std::size_t s = 0; s < sources_.size(); ++s) rule.project_source(sources_[s], sources[s]);
    double worst = 0.0;
    for (std::size_t p = 0; p < products_.size(); ++p) {
      double sum = 0.0;
      for (std::size_t i = 0; i < nodes; ++i) {
        double value = rule.weight(i) * sources[products_[p].source][i];
        for (const int surface : products_[p].surfaces)
          if (surface >= 0) value *= factors[static_cast<std::size_t>(surface)][i];
        sum += value;
      }
      worst = std::max(worst, std::abs(sum - expected_[p]) / scale_[p]);
    }
    return worst;
  }

 private:
  void choose_products(const ChannelGrid& grid) {
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
      for (std::size_t source = 0; source < sources_.size(); ++source) {
        products_.push_back({source, {a, -1, -1}});
        products_.push_back({source, {a, a, -1}});
      }
      products_.push_back({0, {a, a, a}});
      for (std::size_t other = 0; rank < kMostInPairs && other < rank; ++other) {
        const int b = by_variation[other].second;
        for (std::size_t source = 0; source < sources_.size(); ++source) products_.push_back({source, {a, b, -1}});
        products_.push_back({0, {a, a, b}});
        products_.push_back({0, {a, b, b}});
      }
    }
  }

  std::span<const std::vector<double>> surfaces_;
  std::vector<std::vector<double>> sources_;  // the Sun on a white surface, then blackbodies
  std::vector<Product> products_;
  std::vector<double> expected_, scale_;
};

}  // namespace

FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces, double tolerance) {
  NodeRule rule(grid, 1, 1);
  if (grid.size() == 1 || surfaces.empty()) return {std::move(rule), 0.0};
  const Trial trial(grid, surfaces);
  double worst = trial.worst_error(rule);
  for (int parts = 1; worst > tolerance && parts <= kMostParts; ++parts) {
    rule = NodeRule(grid, parts, 2);
    worst = trial.worst_error(rule);
  }
  return {std::move(rule), worst};
}

}  // namespace ifov::radiometry
