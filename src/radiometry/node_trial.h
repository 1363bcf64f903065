#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "radiometry/channel_grid.h"
#include "radiometry/node_demands.h"

namespace ifov::radiometry {

class NodeRule;

inline constexpr double kDarkShare =
    1e-2;  ///< of a white surface: what is darker is judged as if it were not

/// Temperatures at which emission is judged, from the coldest to the hottest; none where nothing emits.
std::vector<double> judged_temperatures_k(const NodeDemands& demands);

/// Light of lamps at a grid's points, as bright in the mean as the grid's reference; those that the channel does not see are
/// left out.
std::vector<std::vector<double>> lamps_at(const ChannelGrid& grid, const NodeDemands& demands);

/// The radiances that a rule of nodes is judged by, as products of a source and the surfaces that its light met, with their
/// values by full integration: every surface alone, and pairs and threes among the most varied of them.
class NodeTrial {
 public:
  /// `surfaces`, which outlive it: reflectances at the points of the grid.
  NodeTrial(const ChannelGrid& grid, std::span<const std::span<const double>> surfaces,
            const NodeDemands& demands);

  /// What surfaces emit varies little beside what they reflect: a share of the tolerance is asked for more strictly.
  double tolerance(const NodeDemands& demands) const;

  struct Errors {
    double worst = 0.0;
    /// Of fourth powers: falls where many radiances get better and the worst does not yet.
    double mean = 0.0;
  };
  Errors errors(const NodeRule& rule) const;
  /// The same by parts of a rule: of every product the sum over the nodes of a part that stands for this share of the channel,
  /// and what all of them together are off by.
  std::vector<double> product_sums(const NodeRule& part, double share) const;
  Errors errors(std::span<const double> product_sums) const;
  /// Surfaces of the radiances that a rule keeps least, each once, at most `most`.
  std::vector<std::size_t> worst_surfaces(const NodeRule& rule, std::size_t most) const;
  /// Surfaces from that which varies most downwards.
  std::span<const std::size_t> by_variation() const { return by_variation_; }
  std::size_t radiance_count() const { return radiances_.size(); }

 private:
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
    std::size_t first_term, terms;
    double expected = 0.0, scale = 0.0;
  };

  void choose_products(const ChannelGrid& grid);
  void add_products(int a, int b);
  void integrate_products(const ChannelGrid& grid);
  void judge_by_products();
  void judge_by_whole_radiances();
  std::vector<double> radiance_errors(std::span<const double> product_sums) const;
  bool whole_radiances(const NodeDemands& demands) const;

  std::span<const std::span<const double>> surfaces_;
  std::span<const double> seen_;
  int reflections_;
  std::size_t first_thermal_ = 1;
  std::vector<std::vector<double>>
      sources_;  // Sun and sky on a white surface, the sky alone, lamps, blackbodies
  std::vector<std::size_t> by_variation_;
  std::vector<Product> products_;
  std::vector<double> expected_, whole_;  // by product: with its surfaces, and with white ones
  double dark_ = 0.0;                     // radiances below it are not told apart from it
  std::vector<Radiance> radiances_;
  std::vector<Radiance::Term> terms_;
};

}  // namespace ifov::radiometry
