#include "sampling/random_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/format.h"

namespace ifov::sampling {
namespace {

enum class Purpose { time, east, north, thinning, further };

constexpr double kJammedCoverage = 0.547;
constexpr double kFullest =
    0.9;  ///< share of the jammed coverage; the last tenth would take proposals without end
constexpr double kMostProposals = 1 << 25;
constexpr double kMargin =
    6.0;  ///< minimum distances beyond the area, where what is dropped depends on neighbours
constexpr std::int32_t kNone = -1;

double disk_m2(double distance_m) { return 0.25 * std::numbers::pi * distance_m * distance_m; }

struct Proposal {
  Point2 at_m;
  double time = 0.0;
  std::uint64_t key = 0;
  std::int32_t column = 0, row = 0;
};

/// At least the minimum distance, with one proposal or more in the mean.
double cell_side_m(double minimum_distance_m, double proposals_m2) {
  double side_m = minimum_distance_m > 0.0 ? minimum_distance_m : 1.0;
  while (side_m * side_m * proposals_m2 < 1.0) side_m *= 2.0;
  while (minimum_distance_m == 0.0 && side_m * side_m * proposals_m2 > 4.0) side_m *= 0.5;
  return side_m;
}

/// Cells that are counted from the origin of coordinates, so that they stay where they are in another area.
struct Cells {
  double side_m = 1.0;
  std::int64_t first_column = 0, first_row = 0;
  std::int64_t columns = 0, rows = 0;

  Cells(const PlacementPlan& plan, double cell_m) : side_m(cell_m) {
    const double margin_m = kMargin * plan.minimum_distance_m;
    first_column = std::llround(std::floor((plan.area.west_m - margin_m) / side_m));
    first_row = std::llround(std::floor((plan.area.south_m - margin_m) / side_m));
    columns = std::llround(std::floor((plan.area.east_m + margin_m) / side_m)) - first_column + 1;
    rows = std::llround(std::floor((plan.area.north_m + margin_m) / side_m)) - first_row + 1;
  }
  std::size_t index(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Those of a Poisson process in time and place, cell by cell.
std::vector<Proposal> proposals_of(const PlacementPlan& plan, const Cells& cells, double proposals_m2) {
  std::vector<Proposal> proposals;
  const double per_cell = proposals_m2 * cells.side_m * cells.side_m;
  for (std::int32_t row = 0; row < cells.rows; ++row)
    for (std::int32_t column = 0; column < cells.columns; ++column) {
      const std::int64_t x = cells.first_column + column, y = cells.first_row + row;
      double time = 0.0;
      for (int k = 0;; ++k) {
        const std::uint64_t key = hash(plan.seed, x, y, k);
        time -= std::log1p(-unit_double(extend(key, Purpose::time)));
        if (time >= per_cell) break;
        const Point2 at_m{(static_cast<double>(x) + unit_double(extend(key, Purpose::east))) * cells.side_m,
                          (static_cast<double>(y) + unit_double(extend(key, Purpose::north))) * cells.side_m};
        proposals.push_back({at_m, time, key, column, row});
      }
    }
  return proposals;
}

/// Which proposals stay: each, in the order of time, that none before it stands in the way of.
std::vector<bool> staying(const std::vector<Proposal>& proposals, const Cells& cells, double distance_m) {
  std::vector<bool> stays(proposals.size(), true);
  if (distance_m == 0.0) return stays;
  std::vector<std::uint32_t> order(proposals.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return proposals[a].time != proposals[b].time ? proposals[a].time < proposals[b].time : a < b;
  });
  std::vector<std::int32_t> latest(static_cast<std::size_t>(cells.columns * cells.rows), kNone);
  std::vector<std::int32_t> before(proposals.size(), kNone);
  const auto free = [&](const Proposal& p) {
    for (std::int32_t row = std::max(0, p.row - 1); row <= p.row + 1 && row < cells.rows; ++row)
      for (std::int32_t column = std::max(0, p.column - 1); column <= p.column + 1 && column < cells.columns;
           ++column)
        for (std::int32_t k = latest[cells.index(column, row)]; k != kNone;
             k = before[static_cast<std::size_t>(k)]) {
          const Point2 other = proposals[static_cast<std::size_t>(k)].at_m;
          if (std::hypot(other.x - p.at_m.x, other.y - p.at_m.y) < distance_m) return false;
        }
    return true;
  };
  for (const std::uint32_t k : order) {
    const Proposal& p = proposals[k];
    stays[k] = free(p);
    if (!stays[k]) continue;
    std::int32_t& head = latest[cells.index(p.column, p.row)];
    before[k] = head;
    head = static_cast<std::int32_t>(k);
  }
  return stays;
}

}  // namespace

double largest_placement_density(double minimum_distance_m) {
  if (minimum_distance_m == 0.0) return std::numeric_limits<double>::infinity();
  return kFullest * kJammedCoverage / disk_m2(minimum_distance_m);
}

double placement_proposals(double density_m2, double minimum_distance_m) {
  if (minimum_distance_m == 0.0) return density_m2;
  const double disk = disk_m2(minimum_distance_m);
  const double filled = std::min(kFullest, density_m2 * disk / kJammedCoverage);
  constexpr int kSteps = 1000;  // Simpson's rule
  const auto slowness = [](double x) {
    const double room = 1.0 - x;
    return 1.0 / ((1.0 + x * (0.812 + x * (0.426 + x * 0.0717))) * room * room * room);
  };
  double sum = slowness(0.0) + slowness(filled);
  for (int k = 1; k < kSteps; ++k) sum += (k % 2 == 1 ? 4.0 : 2.0) * slowness(filled * k / kSteps);
  return sum * filled / (3.0 * kSteps) * kJammedCoverage / disk;
}

std::vector<RandomPosition> random_positions(const PlacementPlan& plan) {
  std::vector<RandomPosition> positions;
  if (!(plan.peak_density_m2 > 0.0)) return positions;
  const double peak_m2 = std::min(plan.peak_density_m2, largest_placement_density(plan.minimum_distance_m));
  const double proposals_m2 = placement_proposals(peak_m2, plan.minimum_distance_m);
  const double side_m = cell_side_m(plan.minimum_distance_m, proposals_m2);
  const double beyond_m = 2.0 * (kMargin * plan.minimum_distance_m + side_m);
  const double count = proposals_m2 * (plan.area.east_m - plan.area.west_m + beyond_m) *
                       (plan.area.north_m - plan.area.south_m + beyond_m);
  if (!(count <= kMostProposals))
    throw InputError(
        format("{:.3g} places on {:.3g} m2 take {:.3g} proposals, more than the {:.3g} that are possible; "
               "use several smaller areas, or a lower density",
               peak_m2 * plan.area.square_metres(), plan.area.square_metres(), count, kMostProposals));
  const Cells cells(plan, side_m);
  const std::vector<Proposal> proposals = proposals_of(plan, cells, proposals_m2);
  const std::vector<bool> stays = staying(proposals, cells, plan.minimum_distance_m);
  for (std::size_t k = 0; k < proposals.size(); ++k) {
    const Proposal& p = proposals[k];
    if (!stays[k] || !plan.area.holds(p.at_m)) continue;
    const double wanted_m2 = plan.density_m2 ? std::min(plan.density_m2(p.at_m), peak_m2) : peak_m2;
    if (unit_double(extend(p.key, Purpose::thinning)) * peak_m2 < wanted_m2)
      positions.push_back({p.at_m, extend(p.key, Purpose::further)});
  }
  return positions;
}

}  // namespace ifov::sampling
