#include "render/wings/wing_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "render/tolerance/accuracy_tolerance.h"
#include "render/wings/cut_room.h"
#include "render/wings/wing_cells.h"
#include "render/wings/wing_spots.h"
#include "sampling/footprint_groups.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/pixel_limits.h"
#include "sensor/psf_wings.h"

namespace ifov::render {
namespace {

using sampling::PixelRect;
using sensor::PsfWings;

constexpr double kRounding = 1e-5;

int pixel_of(double x_px) { return static_cast<int>(std::floor(x_px)); }
bool holds(const PixelRect& rect, int x, int y) {
  return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
}

/// What reaches one pixel by way of the wings.
struct Gathered {
  std::vector<double> weight;  // by group: of all cells, of the whole response
  std::vector<double> sum, variance, unsure;
  std::map<std::uint32_t, double> materials;
  double mixed = 0.0;  // variance of shares of materials, at most
};

class Wings {
 public:
  Wings(std::span<const PsfWings* const> wings, const sampling::ColumnFootprints& footprints,
        const sampling::TileProblem& problem, const SpotLight* spots, sampling::Field& field)
      : wings_(wings),
        runs_(wings.size()),
        near_(cells_of(problem, PsfWings::kNear, 1, spots, field)),
        middle_(cells_of(problem, PsfWings::kMiddle, PsfWings::kNear, spots, field)),
        far_(cells_of(problem, PsfWings::kFar, PsfWings::kMiddle, spots, field)),
        columns_(static_cast<std::size_t>(field.columns())) {
    for (std::size_t c = 0; c < columns_; ++c) {
      auto& runs = runs_[footprints.group_of(c)];
      if (runs.empty() || runs.back().second != c) runs.emplace_back(c, c);
      ++runs.back().second;
    }
    beyond_.resize(columns_);
    darkest_.assign(columns_, std::numeric_limits<double>::infinity());
    brightest_.assign(columns_, -std::numeric_limits<double>::infinity());
    for (const WingCells* cells : {&middle_, &far_})
      for (std::size_t cell = 0; cell < cells->count(); ++cell)
        for (std::size_t c = 0; c < columns_; ++c) {
          const double mean = cells->mean(cell, c);
          darkest_[c] = std::min(darkest_[c], mean);
          brightest_[c] = std::max(brightest_[c], mean);
          if (cells == &far_) beyond_[c] += mean / static_cast<double>(far_.count());
        }
    if (spots != nullptr) sort_spots(*spots, problem.tile);
  }

  void gather(int x, int y, Gathered& found) const {
    found.weight.assign(wings_.size(), 0.0);
    found.mixed = 0.0;
    found.sum.assign(columns_, 0.0);
    found.variance.assign(columns_, 0.0);
    found.unsure.assign(columns_, 0.0);
    found.materials.clear();
    const PixelRect pixel{x, y, x + 1, y + 1};
    const PixelRect near = wing_blocks(pixel, PsfWings::kNear),
                    middle = wing_blocks(pixel, PsfWings::kMiddle), far = wing_blocks(pixel, PsfWings::kFar);
    for (int j = near.y0; j < near.y1; ++j)
      for (int i = near.x0; i < near.x1; ++i) {
        for (std::size_t group = 0; group < wings_.size(); ++group) {
          double weight[4];
          for (int quarter = 0; quarter < 4; ++quarter)
            weight[quarter] = wings_[group]->half_cell(2 * (i - x) + quarter % 2, 2 * (j - y) + quarter / 2);
          add(near_, near_.cell_at(i, j), weight, group, found);
        }
      }
    add_squares(middle_, middle, near, x, y, found);
    add_squares(far_, far, middle, x, y, found);
    for (const SpotLight::Spot* spot : spots_) {
      const int i = pixel_of(spot->middle.x_px), j = pixel_of(spot->middle.y_px);
      add_spot(*spot,
               holds(near, i, j)     ? near_
               : holds(middle, i, j) ? middle_
                                     : far_,
               i, j, holds(far, i, j), x, y, found);
    }
    for (std::size_t c = 0; c < farther_.size(); ++c) found.unsure[c] += farther_[c];
  }

  double beyond(std::size_t column) const { return beyond_[column]; }
  double spread(std::size_t column) const {
    return std::max(brightest_[column] - beyond_[column], beyond_[column] - darkest_[column]);
  }
  /// Paths in pixels of the tile, and others.
  std::size_t paths() const { return 4 * (near_.count() + middle_.count() + far_.count()); }

 private:
  void add_squares(const WingCells& cells, PixelRect in, PixelRect without, int x, int y,
                   Gathered& found) const {
    const int side = cells.side();
    for (int j = in.y0; j < in.y1; j += side)
      for (int i = in.x0; i < in.x1; i += side) {
        if (i >= without.x0 && i < without.x1 && j >= without.y0 && j < without.y1) continue;
        for (std::size_t group = 0; group < wings_.size(); ++group) {
          double weight[4];
          std::fill_n(weight, 4, 0.25 * wings_[group]->square(i - x, j - y, side));
          add(cells, cells.cell_at(i, j), weight, group, found);
        }
      }
  }

  static WingCells cells_of(const sampling::TileProblem& problem, int block, int side, const SpotLight* spots,
                            sampling::Field& field) {
    return {wing_blocks(problem.tile, block),
            side,
            problem.seed,
            problem.cancel,
            spots != nullptr ? &spots->where() : nullptr,
            field};
  }

  /// Those that pixels of the tile may be near to, and what all others may send at most.
  void sort_spots(const SpotLight& light, const PixelRect& tile) {
    const PixelRect region = wing_blocks(tile, PsfWings::kFar);
    farther_.assign(columns_, 0.0);
    for (const SpotLight::Spot& spot : light.spots()) {
      if (holds(region, pixel_of(spot.middle.x_px), pixel_of(spot.middle.y_px))) {
        spots_.push_back(&spot);
        continue;
      }
      const double dx = spot.middle.x_px - std::clamp(spot.middle.x_px, tile.x0 + 0.5, tile.x1 - 0.5),
                   dy = spot.middle.y_px - std::clamp(spot.middle.y_px, tile.y0 + 0.5, tile.y1 - 0.5);
      for (std::size_t group = 0; group < wings_.size(); ++group) {
        const auto [density, unsure] = wings_[group]->density(dx, dy);
        for (const auto& [first, last] : runs_[group])
          for (std::size_t c = first; c < last; ++c)
            farther_[c] +=
                (density + unsure) * (std::abs(spot.light[c] - spot.area_px2 * beyond_[c]) +
                                      (spot.unmet.empty() ? 0.0 : static_cast<double>(spot.unmet[c])));
      }
    }
  }

  /// A spot in the pixel (i, j), over what the cells say of its place; into the half-width where it is farther than they reach.
  void add_spot(const SpotLight::Spot& spot, const WingCells& cells, int i, int j, bool within, int x, int y,
                Gathered& found) const {
    const std::size_t cell = cells.cell_at(i, j);
    for (std::size_t group = 0; group < wings_.size(); ++group) {
      const auto [density, unsure] =
          wings_[group]->density(spot.middle.x_px - (x + 0.5), spot.middle.y_px - (y + 0.5));
      if (!(density > 0.0) && !(unsure > 0.0)) continue;
      for (const auto& [first, last] : runs_[group])
        for (std::size_t c = first; c < last; ++c) {
          const double more = spot.light[c] - spot.area_px2 * cells.mean(cell, c);
          if (within) {
            found.sum[c] += density * more;
            found.variance[c] += density * density * spot.variance[c];
          }
          found.unsure[c] += (within ? unsure : unsure + density) * std::abs(more);
          if (!spot.unmet.empty()) found.unsure[c] += (density + unsure) * static_cast<double>(spot.unmet[c]);
        }
    }
  }

  void add(const WingCells& cells, std::size_t cell, const double (&weight)[4], std::size_t group,
           Gathered& found) const {
    const double all = weight[0] + weight[1] + weight[2] + weight[3];
    if (!(all > 0.0)) return;
    found.weight[group] += all;
    double squares = 0.0;
    bool one_material = true;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double w = weight[quarter];
      squares += w * w;
      const float* value = cells.value(cell, quarter);
      for (const auto& [first, last] : runs_[group])
        for (std::size_t c = first; c < last; ++c) found.sum[c] += w * value[c];
      one_material = one_material && cells.material(cell, quarter) == cells.material(cell, 0);
    }
    for (const auto& [first, last] : runs_[group])
      for (std::size_t c = first; c < last; ++c) found.variance[c] += squares * cells.variance(cell, c);
    if (group != kReference) return;
    if (one_material) {
      found.materials[cells.material(cell, 0)] += all;
    } else {
      found.mixed += 0.25 * squares;
      for (int quarter = 0; quarter < 4; ++quarter)
        found.materials[cells.material(cell, quarter)] += weight[quarter];
    }
  }

  static constexpr std::size_t kReference = 0;  // the group whose footprint shares of materials hold for

  std::span<const PsfWings* const> wings_;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> runs_;  // [first, last) of columns, by group
  WingCells near_, middle_, far_;
  std::size_t columns_;
  std::vector<double> beyond_, darkest_, brightest_;  // by column
  std::vector<const SpotLight::Spot*> spots_;
  std::vector<double> farther_;  // by column: what spots that lie farther may send at most
};

/// Judges a pixel by what was asked for; what the cut adds to what the sampler left is at fault where that is too much.
void judge(const AccuracyTolerance& tolerance, const sampling::LaterLight* later, std::size_t p,
           std::vector<double>& mean, std::vector<double>& limit, sampling::TileResult& tile) {
  const std::size_t columns = static_cast<std::size_t>(tile.columns);
  for (std::size_t c = 0; c < columns; ++c) mean[c] = tile.mean[p * columns + c];
  if (later != nullptr) later->join(p, mean);
  tolerance.asked(mean, limit);
  double worst = 0.0;
  for (std::size_t c = 0; c < columns; ++c) {
    const double ratio = tile.joined(p * columns + c, tolerance.joint()) / limit[c];
    worst = std::max(worst, std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
  }
  tile.worst_ratio[p] = static_cast<float>(worst);
  // Where it was too wide before, something else is at fault.
  if (worst > 1.0 + kRounding && tile.converged(p)) tile.set(p, sampling::Reason::psf_cut);
}

/// The pixel's abundances within the cut, scaled, and what the wings show.
void add_materials(const Gathered& found, double kept, double scale, double rest, double normal,
                   std::uint32_t pixel, std::span<const sampling::Abundance> before,
                   std::vector<sampling::Abundance>& after) {
  std::map<std::uint32_t, sampling::Abundance> of_pixel;
  const float wings = static_cast<float>(normal * std::sqrt(found.mixed) * scale + rest);
  for (const auto& [material, share] : found.materials)
    of_pixel[material] = {pixel, material, static_cast<float>(share * scale), wings};
  for (const sampling::Abundance& a : before) {
    const auto [entry, is_new] =
        of_pixel.try_emplace(a.material, sampling::Abundance{pixel, a.material, 0.0f, wings});
    entry->second.fraction += static_cast<float>(kept * scale) * a.fraction;
    entry->second.half_width =
        std::min(1.0f, entry->second.half_width + static_cast<float>(kept * scale) * a.half_width);
  }
  for (const auto& entry : of_pixel) after.push_back(entry.second);
}

}  // namespace

void add_wings(std::span<const PsfWings* const> wings, const sampling::TileProblem& problem,
               const AccuracyTolerance* tolerance, const SpotLight* spots, sampling::Field& field,
               sampling::TileResult& tile) {
  const sampling::ColumnFootprints footprints = problem.footprints(field);
  const Wings around_tile(wings, footprints, problem, spots, field);
  const std::size_t columns = static_cast<std::size_t>(tile.columns);
  const double normal = sampling::two_sided_normal(tolerance != nullptr ? tolerance->confidence() : 0.95);
  struct Shares {
    double rest, scale, core;
  };
  std::vector<Shares> shares(wings.size());  // by group
  Gathered found;
  std::vector<double> mean(columns), limit(columns);
  std::vector<sampling::Abundance> abundances;
  std::size_t next = 0;
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    if (problem.cancel != nullptr && p % 64 == 0 && problem.cancel->cancelled()) throw Cancelled();
    const int width = tile.tile.width();
    const int x = tile.tile.x0 + static_cast<int>(p) % width, y = tile.tile.y0 + static_cast<int>(p) / width;
    around_tile.gather(x, y, found);
    for (std::size_t group = 0; group < wings.size(); ++group) {
      const double kept = wings[group]->kept(), weight = found.weight[group];
      // Numerical integration of the wings is right within 1e-4; all shares add up to 1.
      const double rest = std::max(0.0, 1.0 - kept - weight), scale = 1.0 / (kept + weight + rest);
      shares[group] = {rest, scale, kept * scale};
    }
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t at = p * columns + c;
      const auto [rest, scale, core] = shares[footprints.group_of(c)];
      tile.mean[at] =
          static_cast<float>(core * tile.mean[at] + scale * (found.sum[c] + rest * around_tile.beyond(c)));
      if (!tile.has_errors()) continue;
      const double variance = scale * scale * found.variance[c];
      tile.variance_geometry[at] *= static_cast<float>(core * core);
      tile.variance_path[at] = static_cast<float>(core * core * tile.variance_path[at] + variance);
      tile.half_width[at] =
          static_cast<float>(std::hypot(core * tile.half_width[at], normal * std::sqrt(variance)));
      tile.add_bound(at, scale * (rest * around_tile.spread(c) + found.unsure[c]));
    }
    if (tile.has_errors() && tolerance != nullptr) judge(*tolerance, problem.later, p, mean, limit, tile);
    const std::size_t first = next;
    while (next < tile.abundances.size() && tile.abundances[next].pixel == p) ++next;
    add_materials(found, wings.front()->kept(), shares.front().scale, shares.front().rest, normal,
                  static_cast<std::uint32_t>(p), std::span(tile.abundances).subspan(first, next - first),
                  abundances);
    tile.samples[p] += 4;
    tile.radiance_evaluations[p] += 4;
  }
  tile.abundances = std::move(abundances);
  tile.halo_samples += around_tile.paths() - 4 * tile.samples.size();
}

bool leaves_out(std::span<const double> left_out) {
  return std::any_of(left_out.begin(), left_out.end(), [](double share) { return share > 0.0; });
}

void widen_by_cut(std::span<const double> left_out, const CutRange& about, const sampling::LaterLight* later,
                  const AccuracyTolerance* tolerance, sampling::TileResult& tile) {
  if (!leaves_out(left_out) || !tile.has_errors()) return;
  const std::size_t columns = static_cast<std::size_t>(tile.columns), pixels = tile.samples.size();
  std::vector<double> darkest = about.darkest, brightest = about.brightest;
  for (std::size_t at = 0; at < pixels * columns; ++at) {
    darkest[at % columns] = std::min<double>(darkest[at % columns], tile.mean[at]);
    brightest[at % columns] = std::max<double>(brightest[at % columns], tile.mean[at]);
  }
  std::vector<double> mean(columns), limit(columns);
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t at = p * columns + c;
      tile.add_bound(at, left_out[c] * std::max(brightest[c] - tile.mean[at],
                                                static_cast<double>(tile.mean[at]) - darkest[c]));
    }
    if (tolerance != nullptr) judge(*tolerance, later, p, mean, limit, tile);
  }
}

}  // namespace ifov::render
