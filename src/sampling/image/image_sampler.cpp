#include "sampling/image/image_sampler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/error.h"
#include "core/run_control.h"
#include "sampling/hash.h"
#include "sampling/image/image_plan.h"
#include "sampling/image/levels.h"
#include "sampling/pixel_writer.h"
#include "sampling/quantiles.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kPilotPaths = 0x70696c6f74ull, kMainPaths = 0x6d61696eull;
constexpr std::size_t kPixelChunk = 32;

/// One chunk of a tile's pixels: pilots, plans, and all the rest.
class ImageChunk {
 public:
  ImageChunk(const TileProblem& problem, const ImagePlan& plan, Field& field, TileResult& result)
      : problem_(problem),
        plan_(plan),
        field_(field),
        result_(result),
        columns_(static_cast<std::size_t>(field.columns())),
        stride_(static_cast<std::size_t>(field.stride())),
        student_(confidence_of(problem)) {}

  void sample(std::size_t first, std::size_t last) {
    draw(
        first, last, kPilotPaths, [](std::size_t) { return Allocation::pilot(); }, pilot_);
    plans_.clear();
    cut_.clear();
    materials_.clear();
    for (std::size_t p = first; p < last; ++p) choose(p - first);
    draw(
        first, last, kMainPaths, [&](std::size_t p) { return plans_[p - first]; }, main_);
    label_ = 0;
    for (std::size_t p = first; p < last; ++p) write(p, p - first);
  }

 private:
  template <class PlanOf>
  void draw(std::size_t first, std::size_t last, std::uint64_t purpose, PlanOf plan_of, LevelSums& sums) {
    points_.clear();
    const int width = problem_.tile.width();
    for (std::size_t p = first; p < last; ++p) {
      const int i = problem_.tile.x0 + static_cast<int>(p) % width,
                j = problem_.tile.y0 + static_cast<int>(p) / width;
      points_.add(*problem_.footprint, i, j, hash(problem_.seed, i, j, purpose), plan_of(p));
    }
    field_.levels({points_.requests, points_.whole, points_.counts}, sums);
  }

  std::span<const Label> pilot_labels(std::size_t in_chunk) const {
    const std::size_t count = Allocation::pilot().count();
    return std::span<const Label>(pilot_.labels).subspan(in_chunk * count, count);
  }

  void choose(std::size_t in_chunk) {
    const std::size_t row = in_chunk * stride_;
    materials_.push_back(main_material(field_, pilot_labels(in_chunk)));
    const Allocation& allocation = plan_.allocation();
    const double direct_factor = plan_.direct_factor(shows_several(field_, pilot_labels(in_chunk)));
    variances_.direct.resize(columns_);
    variances_.rest.resize(columns_);
    for (std::size_t c = 0; c < columns_; ++c) {
      variances_.direct[c] = direct_factor * static_cast<double>(pilot_.direct_variance[row + c]);
      variances_.rest[c] = plan_.rest_factor() * static_cast<double>(pilot_.rest_variance[row + c]);
    }
    plan_.moderate_pilot(variances_, materials_.back());
    const double direct = allocation.direct_size(variances_.direct),
                 rest = allocation.rest_size(variances_.rest);
    plans_.push_back(allocation.plan(direct, rest));
    cut_.push_back(allocation.is_cut(direct, rest) ? 1 : 0);
  }

  void write(std::size_t pixel, std::size_t in_chunk) {
    const std::size_t row = in_chunk * stride_;
    const PixelPlan& plan = plans_[in_chunk];
    const Allocation& allocation = plan_.allocation();
    const LevelVariances& kind = plan_.kind(materials_[in_chunk]).mean;
    const double count = plan.count(), whole = plan.whole, direct_weight = allocation.pilot_direct_weight(),
                 rest_weight = allocation.pilot_rest_weight();
    // A value of the pilot's strata varies more than one of finer strata.
    const double finer = std::pow(Allocation::pilot().count() / count, Allocation::kExponent - 1.0);
    PixelEstimate estimate;
    estimate.mean.resize(columns_);
    estimate.variance_geometry.assign(columns_, 0.0);
    estimate.variance_path.assign(columns_, 0.0);
    add_materials(in_chunk, plan.count(), estimate);
    double direct_size = 0.0, rest_size = 0.0;  // of the pixel's variance, all columns together
    const bool mixed = estimate.materials.size() > 1;
    const double direct_factor = plan_.direct_factor(mixed), rest_factor = plan_.rest_factor();
    for (std::size_t c = 0; c < columns_; ++c) {
      const std::size_t at = row + c;
      const auto d = [&](const std::vector<float>& values) { return static_cast<double>(values[at]); };
      estimate.mean[c] = direct_weight * d(pilot_.direct) + (1.0 - direct_weight) * d(main_.direct) +
                         rest_weight * d(pilot_.rest) + (1.0 - rest_weight) * d(main_.rest);
      const double fours = count / 4.0,
                   own =
                       direct_factor *
                       (fours * d(main_.direct_variance) + kPilotFours * finer * d(pilot_.direct_variance)) /
                       (fours + kPilotFours),
                   fine = ImagePlan::moderated(own, fours + kPilotFours, finer * kind.direct[c],
                                               ImagePlan::kDirectPrior);
      const double own_rest = rest_factor *
                              ((whole - 1.0) * d(main_.rest_variance) +
                               (Allocation::kPilotWhole - 1.0) * d(pilot_.rest_variance)) /
                              (whole + Allocation::kPilotWhole - 2.0),
                   rest = ImagePlan::moderated(own_rest, whole + Allocation::kPilotWhole - 2.0, kind.rest[c],
                                               ImagePlan::kRestPrior);
      const double direct_variance = allocation.direct_variance(fine / finer, fine, plan.count()),
                   rest_variance = allocation.rest_variance(rest, rest, plan.whole),
                   limit = plan_.limits()[c];
      (mixed ? estimate.variance_geometry : estimate.variance_path)[c] = direct_variance;
      estimate.variance_path[c] += rest_variance;
      if (!(limit > 0.0) || !std::isfinite(limit)) continue;
      direct_size += direct_variance / (limit * limit);
      rest_size += rest_variance / (limit * limit);
    }
    // Degrees of freedom of both levels together (Satterthwaite 1946), columns by what they weigh.
    const double direct_freedom = count / 4.0 + kPilotFours + ImagePlan::kDirectPrior,
                 rest_freedom = whole + Allocation::kPilotWhole - 2.0 + ImagePlan::kRestPrior,
                 both = direct_size + rest_size,
                 freedom = both > 0.0 ? both * both /
                                            (direct_size * direct_size / direct_freedom +
                                             rest_size * rest_size / rest_freedom)
                                      : direct_freedom;
    estimate.quantile = student_(std::max(1, static_cast<int>(freedom)));
    result_.samples[pixel] = result_.radiance_evaluations[pixel] = plan.count() + Allocation::pilot().count();
    TileProblem unjudged = problem_;
    unjudged.tolerance = nullptr;
    write_pixel(estimate, unjudged, pixel, result_);
    // The image is judged as a whole, and what its pixels were to do for it is done, unless they might not.
    result_.reasons[pixel] = cut_[in_chunk] != 0 ? bit(Reason::samples) : Reasons{0};
    for (std::size_t c = 0; c < columns_; ++c) {
      result_.column_errors[c].mean_sum += estimate.mean[c];
      result_.column_errors[c].variance_sum += estimate.variance_geometry[c] + estimate.variance_path[c];
    }
  }

  void add_materials(std::size_t in_chunk, std::uint32_t count, PixelEstimate& estimate) {
    const double weight = plan_.allocation().pilot_direct_weight();
    const std::span<const Label> pilot = pilot_labels(in_chunk),
                                 main = std::span<const Label>(main_.labels).subspan(label_, count);
    label_ += count;
    for (const Label label : pilot)
      estimate.materials[field_.material_of(label)].fraction += weight / static_cast<double>(pilot.size());
    for (const Label label : main)
      estimate.materials[field_.material_of(label)].fraction += (1.0 - weight) / count;
    for (auto& [material, share] : estimate.materials) {
      const double of_one = std::max(0.0, share.fraction * (1.0 - share.fraction));
      share.variance = of_one * (weight * weight / static_cast<double>(pilot.size()) +
                                 (1.0 - weight) * (1.0 - weight) / count);
    }
  }

  static constexpr double kPilotFours = Allocation::kPilotAcross * Allocation::kPilotDown / 4.0;

  const TileProblem& problem_;
  const ImagePlan& plan_;
  Field& field_;
  TileResult& result_;
  std::size_t columns_, stride_;
  StudentTable student_;
  LevelVariances variances_;
  PixelPoints points_;
  LevelSums pilot_, main_;
  std::vector<PixelPlan> plans_;
  std::vector<std::uint8_t> cut_;
  std::vector<std::uint32_t> materials_;
  std::size_t label_ = 0;  // the next pixel's first in main_
};

}  // namespace

std::unique_ptr<const ImageSurvey> ImageSampler::survey(const SurveyRequest& request) const {
  if (request.image.tolerance == nullptr || request.image.footprint == nullptr)
    throw std::invalid_argument("the image sampler needs a tolerance and a footprint");
  return ImagePlan::find(request, most_samples_);
}

void ImageSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  const auto* plan = dynamic_cast<const ImagePlan*>(problem.survey);
  if (plan == nullptr || problem.footprint == nullptr)
    throw std::invalid_argument("the image sampler needs a survey of its own and a footprint");
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  result.column_errors.resize(static_cast<std::size_t>(field.columns()));
  for (std::size_t c = 0; c < result.column_errors.size(); ++c)
    result.column_errors[c].limit = static_cast<float>(plan->limits()[c]);
  ImageChunk chunk(problem, *plan, field, result);
  for (std::size_t first = 0; first < result.samples.size(); first += kPixelChunk) {
    if (problem.cancel != nullptr && problem.cancel->cancelled()) throw Cancelled();
    chunk.sample(first, std::min(result.samples.size(), first + kPixelChunk));
  }
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
