#include "sampling/accuracy/accuracy_sampler.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/call_scope.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/footprint_draws.h"
#include "sampling/accuracy/parts.h"
#include "sampling/accuracy/tile_work.h"
#include "sampling/pixel_footprint.h"

namespace ifov::sampling {

// Lattice::edge_key() has 29 bits for a position and 4 for a level.
static_assert(kMaxLevel <= 15 && AccuracySampler::kMostCells <= 1 << (29 - kMaxLevel));

AccuracySampler::AccuracySampler(AccuracyOptions options) : options_(options) {
  if (options.lattice < 1 || options.lattice > kMostLattice)
    throw std::invalid_argument("lattice must be 1 to 32 cells per pixel");
  if (options.probes_per_side < 0 || options.probes_per_side > 16)
    throw std::invalid_argument("probes per side must be 0 to 16");
  if (!(options.initial_bracket_px > 0.0 && options.thinnest_px > 0.0))
    throw std::invalid_argument("bracket and thinnest width must be positive");
}

const AccuracyParts& AccuracySampler::parts() const {
  static const AccuracyParts kParts;
  return kParts;
}

void AccuracySampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  if (problem.tolerance == nullptr || problem.footprint == nullptr || problem.steering_channels.empty())
    throw std::invalid_argument("the accuracy sampler needs a tolerance, a footprint and steering channels");
  const double side_px = std::max(problem.tile.width(), problem.tile.height()) +
                         2.0 * std::ceil(problem.footprint->half_width_px() + 1.0);
  if (side_px * options_.lattice > kMostCells)
    throw std::invalid_argument("the tile has too many cells of the lattice");
  // What is worked out between rays ends with the run, too.
  const Call& call = current_call();
  const Call ending{call.inputs, problem.cancel != nullptr ? problem.cancel : call.cancel};
  const CallScope scope(ending);
  if (!options_.footprint_by_model) {
    draw_from_footprint(problem, field, options_.max_samples_per_pixel, result);
    return;
  }
  TileWork work(problem, field, options_, parts(), result);
  work.trace();
  work.estimate();
  work.report();
}

}  // namespace ifov::sampling
