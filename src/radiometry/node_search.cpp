#include "radiometry/node_search.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "radiometry/node_shapes.h"
#include "radiometry/node_trial.h"

namespace ifov::radiometry {
namespace {

using Surfaces = std::vector<std::span<const double>>;

/// Two parts for one, by the sign of a variable at its points: none where all are on one side.
std::optional<std::pair<TrialPart, TrialPart>> divided(const TrialPart& part,
                                                       std::span<const double> variable,
                                                       const NodeShapes& shapes) {
  std::vector<std::uint32_t> low, high;
  for (std::size_t i = 0; i < part.part.points.size(); ++i)
    (variable[i] < 0.0 ? low : high).push_back(part.part.points[i]);
  if (low.empty() || high.empty()) return std::nullopt;
  return std::pair(shapes.analysed(std::move(low)), shapes.analysed(std::move(high)));
}

/// Two nodes for a part that has one; two parts for a part that has two. False where nothing more can be done.
bool refine(std::vector<TrialPart>& parts, std::size_t which, const NodeShapes& shapes) {
  TrialPart& part = parts[which];
  if (!(part.left() > 0.0) || part.part.points.size() < 2) return false;
  if (part.part.order == 1) {
    part.part.order = 2;
    return true;
  }
  auto both = divided(part, part.part.variable, shapes);
  if (!both) return false;
  part = std::move(both->first);
  parts.push_back(std::move(both->second));
  return true;
}

/// Refines the part that leaves most of the spectra's variance.
bool refine_worst(std::vector<TrialPart>& parts, const NodeShapes& shapes) {
  const auto worst = std::max_element(
      parts.begin(), parts.end(), [](const TrialPart& a, const TrialPart& b) { return a.left() < b.left(); });
  return refine(parts, static_cast<std::size_t>(worst - parts.begin()), shapes);
}

NodeRule rule_of(const ChannelGrid& grid, const std::vector<TrialPart>& parts) {
  std::vector<ChannelPart> plain;
  for (const TrialPart& part : parts) plain.push_back(part.part);
  return NodeRule(grid, plain);
}

/// A part with what its node makes of every product.
struct JudgedPart {
  TrialPart part;
  std::vector<double> sums;
};

/// A part with what it can be divided into, worked out once.
struct DividedPart {
  JudgedPart part;
  std::optional<std::vector<std::pair<JudgedPart, JudgedPart>>> halves;
};

/// Behind lines of absorption the measure varies by orders of magnitude, which no line follows: there the parts have one
/// node each, and the best of all that can be divided is. Nodes of one part do not know of the others: what a division makes of
/// every product is worked out once.
class SingleNodes {
 public:
  SingleNodes(const ChannelGrid& grid, const NodeTrial& trial, const NodeShapes& shapes)
      : grid_(grid), trial_(trial), shapes_(shapes) {}

  FoundRule found(std::vector<std::uint32_t> points, const NodeDemands& demands) {
    parts_.push_back({judged(shapes_.analysed(std::move(points))), {}});
    std::vector<double> sums = parts_.front().part.sums;
    NodeTrial::Errors errors = trial_.errors(sums);
    std::size_t judged_radiances = trial_.radiance_count();
    const double tolerance = trial_.tolerance(demands);
    while (errors.worst > tolerance && parts_.size() < demands.most_nodes) {
      const std::pair<JudgedPart, JudgedPart>* best = nullptr;
      std::size_t of_part = 0;
      for (std::size_t k = 0; k < parts_.size(); ++k)
        for (const std::pair<JudgedPart, JudgedPart>& both : halves(parts_[k])) {
          const NodeTrial::Errors finer = trial_.errors(exchanged(sums, parts_[k].part, both));
          judged_radiances += trial_.radiance_count();
          if (best != nullptr && finer.mean >= errors.mean) continue;
          best = &both;
          of_part = k;
          errors = finer;
        }
      if (best == nullptr) break;
      std::pair<JudgedPart, JudgedPart> both = *best;
      sums = exchanged(sums, parts_[of_part].part, both);
      parts_[of_part] = {std::move(both.first), {}};
      parts_.push_back({std::move(both.second), {}});
    }
    std::vector<TrialPart> all;
    for (const DividedPart& part : parts_) all.push_back(part.part.part);
    NodeRule rule = rule_of(grid_, all);
    const double worst = trial_.errors(rule).worst;
    return {std::move(rule), worst, judged_radiances};
  }

 private:
  JudgedPart judged(TrialPart part) const {
    double share = 0.0, whole = 0.0;
    for (const std::uint32_t q : part.part.points) share += grid_.response[q];
    for (const double response : grid_.response) whole += response;
    std::vector<double> sums = trial_.product_sums(NodeRule(grid_, std::span(&part.part, 1)), share / whole);
    return {std::move(part), std::move(sums)};
  }

  const std::vector<std::pair<JudgedPart, JudgedPart>>& halves(DividedPart& part) const {
    if (!part.halves) {
      part.halves.emplace();
      // Many surfaces outvote the air in the first component of all shapes.
      for (const std::vector<double>& variable : shapes_.ways_to_divide(part.part.part))
        if (auto both = divided(part.part.part, variable, shapes_))
          part.halves->emplace_back(judged(std::move(both->first)), judged(std::move(both->second)));
    }
    return *part.halves;
  }

  static std::vector<double> exchanged(std::vector<double> sums, const JudgedPart& part,
                                       const std::pair<JudgedPart, JudgedPart>& both) {
    for (std::size_t p = 0; p < sums.size(); ++p)
      sums[p] += both.first.sums[p] + both.second.sums[p] - part.sums[p];
    return sums;
  }

  const ChannelGrid& grid_;
  const NodeTrial& trial_;
  const NodeShapes& shapes_;
  std::vector<DividedPart> parts_;
};

FoundRule rule_of_pairs(const ChannelGrid& grid, const NodeTrial& trial, const NodeShapes& shapes,
                        std::vector<std::uint32_t> points, const NodeDemands& demands) {
  std::vector<TrialPart> parts{shapes.analysed(std::move(points))};
  NodeRule rule = rule_of(grid, parts);
  NodeTrial::Errors errors = trial.errors(rule);
  std::size_t judged = trial.radiance_count();
  const double tolerance = trial.tolerance(demands);
  while (errors.worst > tolerance && rule.node_count() < demands.most_nodes) {
    if (!refine_worst(parts, shapes)) break;
    rule = rule_of(grid, parts);
    errors = trial.errors(rule);
    judged += trial.radiance_count();
  }
  return {std::move(rule), errors.worst, judged};
}

FoundRule rule_judged_by(const ChannelGrid& grid, const NodeTrial& trial, const Surfaces& surfaces,
                         const NodeDemands& demands) {
  const NodeShapes shapes(grid, surfaces, demands);
  std::vector<std::uint32_t> all(grid.size());
  std::iota(all.begin(), all.end(), 0u);
  return grid.seen.empty() ? rule_of_pairs(grid, trial, shapes, std::move(all), demands)
                           : SingleNodes(grid, trial, shapes).found(std::move(all), demands);
}

/// As kMostJudgedTogether says. The rule is judged by all surfaces before it is taken.
FoundRule rule_of_many(const ChannelGrid& grid, const NodeTrial& all, const Surfaces& surfaces,
                       const NodeDemands& demands) {
  constexpr std::size_t kMostVaried = 16, kSpread = 48, kMore = 16, kRounds = 8;
  std::vector<bool> taken(surfaces.size(), false);
  const std::span<const std::size_t> order = all.by_variation();
  for (std::size_t k = 0; k < kMostVaried; ++k) taken[order[k]] = true;
  for (std::size_t k = 0; k < kSpread; ++k)
    taken[order[kMostVaried + k * (surfaces.size() - kMostVaried) / kSpread]] = true;
  std::size_t judged = 0;
  for (std::size_t round = 0;; ++round) {
    Surfaces some;
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (taken[s] || round == kRounds) some.push_back(surfaces[s]);
    const NodeTrial trial(grid, some, demands);
    FoundRule found = rule_judged_by(grid, trial, some, demands);
    found.worst_error = all.errors(found.rule).worst;
    judged = found.judged += judged + all.radiance_count();
    if (!(found.worst_error > all.tolerance(demands)) || found.rule.node_count() >= demands.most_nodes ||
        round == kRounds)
      return found;
    bool more = false;
    for (const std::size_t s : all.worst_surfaces(found.rule, kMore)) {
      more = more || !taken[s];
      taken[s] = true;
    }
    if (!more) round = kRounds - 1;
  }
}

FoundRule searched(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
                   const NodeDemands& demands) {
  if (grid.size() == 1 || (surfaces.empty() && grid.seen.empty())) {
    std::vector<std::uint32_t> all(grid.size());
    std::iota(all.begin(), all.end(), 0u);
    const ChannelPart whole{std::move(all), {}, 1};
    return {NodeRule(grid, std::span(&whole, 1))};
  }
  const Surfaces all(surfaces.begin(), surfaces.end());
  const NodeTrial trial(grid, all, demands);
  return surfaces.size() <= kMostJudgedTogether ? rule_judged_by(grid, trial, all, demands)
                                                : rule_of_many(grid, trial, all, demands);
}

}  // namespace

FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
                    const NodeDemands& demands) {
  FoundRule found = searched(grid, surfaces, demands);
  found.rule.choose_planck_points();
  return found;
}

}  // namespace ifov::radiometry
