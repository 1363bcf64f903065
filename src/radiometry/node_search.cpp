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

/// A part with what it can be divided into, worked out once.
struct DividedPart {
  TrialPart part;
  std::optional<std::vector<std::pair<TrialPart, TrialPart>>> halves;

  const std::vector<std::pair<TrialPart, TrialPart>>& all_halves(const NodeShapes& shapes) {
    if (!halves) {
      halves.emplace();
      // Many surfaces outvote the air in the first component of all shapes.
      for (const std::vector<double>& variable : shapes.ways_to_divide(part))
        if (auto both = divided(part, variable, shapes)) halves->push_back(std::move(*both));
    }
    return *halves;
  }
};

/// Behind lines of absorption the measure varies by orders of magnitude, which no line follows: there the parts have one
/// node each, and the best of all that can be divided is.
FoundRule rule_of_single_nodes(const ChannelGrid& grid, const NodeTrial& trial, const NodeShapes& shapes,
                               std::vector<std::uint32_t> points, const NodeDemands& demands) {
  std::vector<DividedPart> parts{{shapes.analysed(std::move(points)), {}}};
  const auto plain = [&] {
    std::vector<ChannelPart> all;
    for (const DividedPart& part : parts) all.push_back(part.part.part);
    return all;
  };
  NodeRule rule(grid, plain());
  NodeTrial::Errors errors = trial.errors(rule);
  std::size_t judged = trial.radiance_count();
  const double tolerance = trial.tolerance(demands);
  while (errors.worst > tolerance && rule.node_count() < demands.most_nodes) {
    const std::pair<TrialPart, TrialPart>* best = nullptr;
    std::size_t of_part = 0;
    std::vector<ChannelPart> finer = plain();
    finer.emplace_back();
    for (std::size_t k = 0; k < parts.size(); ++k) {
      for (const std::pair<TrialPart, TrialPart>& both : parts[k].all_halves(shapes)) {
        finer[k] = both.first.part;
        finer.back() = both.second.part;
        NodeRule finer_rule(grid, finer);
        const NodeTrial::Errors finer_errors = trial.errors(finer_rule);
        judged += trial.radiance_count();
        if (best != nullptr && finer_errors.mean >= errors.mean) continue;
        best = &both;
        of_part = k;
        rule = std::move(finer_rule);
        errors = finer_errors;
      }
      finer[k] = parts[k].part.part;
    }
    if (best == nullptr) break;
    std::pair<TrialPart, TrialPart> both = *best;
    parts[of_part] = {std::move(both.first), {}};
    parts.push_back({std::move(both.second), {}});
  }
  return {std::move(rule), errors.worst, judged};
}

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
                           : rule_of_single_nodes(grid, trial, shapes, std::move(all), demands);
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

}  // namespace

FoundRule find_rule(const ChannelGrid& grid, std::span<const std::vector<double>> surfaces,
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

}  // namespace ifov::radiometry
