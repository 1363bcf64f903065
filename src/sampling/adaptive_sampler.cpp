#include "sampling/adaptive_sampler.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "sampling/footprint_groups.h"
#include "sampling/intervals/quantiles.h"
#include "sampling/pixel_writer.h"
#include "sampling/refined_lattice.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

/// A pixel as the weighted sum of its sub-elements, by the weights of each group of columns.
class PixelSums {
 public:
  /// Keeps references.
  PixelSums(const SubElementLattices& lattices, const ColumnFootprints& footprints,
            const RefinedLattice& refined, Field& field)
      : footprints_(footprints) {
    for (std::size_t group = 0; group < lattices.groups(); ++group)
      sums_.emplace_back(lattices, group, refined, field);
  }

  const PixelEstimate& estimate(int i, int j, StudentTable& student) {
    if (sums_.size() == 1) return sums_.front().estimate(i, j, student);
    estimate_ = sums_.front().estimate(i, j, student);
    for (std::size_t group = 1; group < sums_.size(); ++group) {
      const PixelEstimate& own = sums_[group].estimate(i, j, student);
      for (std::size_t c = 0; c < own.mean.size(); ++c) {
        if (footprints_.group_of(c) != group) continue;
        estimate_.mean[c] = own.mean[c];
        estimate_.variance_geometry[c] = own.variance_geometry[c];
        estimate_.variance_path[c] = own.variance_path[c];
      }
      estimate_.quantile = std::max(estimate_.quantile, own.quantile);
      estimate_.spent = estimate_.spent || own.spent;
    }
    return estimate_;
  }

 private:
  /// Of one group.
  class PixelSum {
   public:
    PixelSum(const SubElementLattices& lattices, std::size_t group, const RefinedLattice& refined,
             Field& field)
        : lattices_(lattices), group_(group), refined_(refined), field_(field) {}

    const PixelEstimate& estimate(int i, int j, StudentTable& student) {
      const std::size_t columns = static_cast<std::size_t>(field_.columns());
      PixelEstimate& e = estimate_;
      e.mean.assign(columns, 0.0);
      e.variance_geometry.assign(columns, 0.0);
      e.variance_path.assign(columns, 0.0);
      e.materials.clear();
      e.spent = false;
      int repeated = 0, cells = 0;
      bool known = true, any_mixed = false;
      for_each_cell(i, j, [&](std::size_t cell, double w) {
        const float* mean = refined_.mean(cell);
        for (std::size_t c = 0; c < columns; ++c) e.mean[c] += w * static_cast<double>(mean[c]);
        const bool mixed = refined_.mixed(cell);
        any_mixed |= mixed;
        known &= refined_.add_variance(cell, w * w, mixed ? e.variance_geometry : e.variance_path);
        const int n = refined_.samples(cell);
        for (int k = 0; k < n; ++k)
          e.materials[field_.material_of(refined_.label(cell, k))].fraction += w / n;
        repeated += n - 1;
        e.spent = e.spent || refined_.spent(cell);
        ++cells;
      });
      if (any_mixed)
        for_each_cell(i, j, [&](std::size_t cell, double w) {
          if (refined_.mixed(cell)) add_material_variance(cell, w, e);
        });
      if (!known) {
        e.variance_geometry.assign(columns, std::numeric_limits<double>::quiet_NaN());
        for (auto& [material, share] : e.materials) share.variance = std::numeric_limits<double>::quiet_NaN();
      }
      e.quantile = student(repeated > 0 ? repeated : std::max(1, cells - 1));
      return e;
    }

   private:
    template <class Visit>
    void for_each_cell(int i, int j, Visit visit) const {
      const SubElementLattice& lattice = lattices_.of(group_, i);
      for (int b = 0; b < lattice.height(); ++b)
        for (int a = 0; a < lattice.width(); ++a)
          if (const double w = lattice.weight(a, b); w != 0.0)
            visit(refined_.index_of(i * lattice.columns_per_pixel() + lattice.first_column() + a,
                                    j * lattice.rows_per_pixel() + lattice.first_row() + b),
                  w);
    }

    double share_of(std::uint32_t material, std::size_t cell) const {
      const int n = refined_.samples(cell);
      int found = 0;
      for (int k = 0; k < n; ++k) found += field_.material_of(refined_.label(cell, k)) == material;
      return static_cast<double>(found) / n;
    }

    // Fractions are means of an indicator over the same samples, so they have errors like any radiance.
    void add_material_variance(std::size_t cell, double w, PixelEstimate& e) const {
      const int n = refined_.samples(cell);
      std::size_t near[4];
      const int count = refined_.neighbours(cell, near);
      for (auto& [material, share] : e.materials) {
        const double f = share_of(material, cell);
        if (n > 1) {
          share.variance += w * w * f * (1.0 - f) / (n - 1);
          continue;
        }
        for (int k = 0; k < count; ++k) {
          const double d = f - share_of(material, near[k]);
          share.variance += w * w * 0.5 / count * d * d;
        }
      }
    }

    const SubElementLattices& lattices_;
    const std::size_t group_;
    const RefinedLattice& refined_;
    Field& field_;
    PixelEstimate estimate_;
  };

  const ColumnFootprints& footprints_;
  std::vector<PixelSum> sums_;
  PixelEstimate estimate_;
};

}  // namespace

AdaptiveSampler::AdaptiveSampler(const AdaptiveOptions& options) : options_(options) {
  if (options.sub_elements_x < 1 || options.sub_elements_y < 1)
    throw std::invalid_argument("adaptive sampling needs at least one sub-element per pixel");
  if (options.max_samples < options.sub_elements_x * options.sub_elements_y)
    throw std::invalid_argument("adaptive sampling needs at least one sample per sub-element");
  if (!(options.allowed_difference >= 0.0))
    throw std::invalid_argument("the allowed difference must not be negative");
}

int AdaptiveSampler::halo_px() const {
  const int fewest = std::min(options_.sub_elements_x, options_.sub_elements_y);
  return (2 + fewest - 1) / fewest;
}

void AdaptiveSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  const ColumnFootprints footprints = problem.footprints(field);
  const SubElementLattices lattices(footprints, problem.tile, options_.sub_elements_x,
                                    options_.sub_elements_y);
  RefinedLattice refined(lattices.any(), options_, problem);
  refined.refine(field);

  StudentTable student(confidence_of(problem));
  PixelSums sum(lattices, footprints, refined, field);
  refined.count_samples(result);
  std::size_t pixel = 0;
  for (int j = problem.tile.y0; j < problem.tile.y1; ++j)
    for (int i = problem.tile.x0; i < problem.tile.x1; ++i)
      write_pixel(sum.estimate(i, j, student), problem, pixel++, result);
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
