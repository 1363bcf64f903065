#include "sampling/image/audited_pixels.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/run_control.h"
#include "sampling/hash.h"
#include "sampling/image/audit.h"
#include "sampling/image/pixel_points.h"
#include "sampling/image/spread_places.h"
#include "sampling/pixel_sampler.h"
#include "sampling/random.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

constexpr std::uint64_t kAuditPlaces = 0x6175646974ull, kAuditChoice = 0x63686f696365ull,
                        kAuditPaths = 0x68616c766573ull;
constexpr std::size_t kCandidates = 3;  // for each pixel that is wanted

/// The pixel as the image will have it: samplers make the same of it whatever tile it lies in.
void sample_alone(const PixelSampler& sampler, const ImageSurvey* survey, const TileProblem& image,
                  const Place& place, Field& field, AuditedPixel& pixel) {
  TileProblem problem = image;
  problem.tile = {place.i, place.j, place.i + 1, place.j + 1};
  problem.survey = survey;
  TileResult result;
  sampler.sample(problem, field, result);
  const auto columns = static_cast<std::size_t>(result.columns);
  pixel.value.assign(result.mean.begin(), result.mean.end());
  pixel.variance.resize(columns);
  for (std::size_t c = 0; c < columns; ++c) {
    const double sum =
        static_cast<double>(result.variance_geometry[c]) + static_cast<double>(result.variance_path[c]);
    pixel.variance[c] = std::isfinite(sum) ? sum : 0.0;
  }
  pixel.mixed = classes_of(result).front() == Audit::kMixed;
}

void measure(const TileProblem& image, const Place& place, Field& field, AuditedPixel& pixel) {
  PixelPoints points;
  const auto columns = static_cast<std::size_t>(field.columns());
  const PixelPlan plan{Audit::kSide, Audit::kSide, 0};
  for (std::size_t h = 0; h < 2; ++h) {
    points.clear();
    points.add(*image.footprint, place.i, place.j, hash(image.seed, place.i, place.j, kAuditPaths, h), plan);
    pixel.half[h].assign(columns, 0.0);
    const double share = 1.0 / static_cast<double>(points.requests.size());
    for_each_value(
        field, image.cancel, points.requests.size(), [&](std::size_t k) { return points.requests[k]; },
        [&](std::size_t, Label, const float* values) {
          for (std::size_t c = 0; c < columns; ++c)
            pixel.half[h][c] += share * static_cast<double>(values[c]);
        });
  }
}

template <class Body>
void for_each_pixel(const SurveyRequest& request, std::size_t count, RayCounts& rays, const Body& body) {
  constexpr std::size_t kChunk = 8;
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<RayCounts> traced(chunks);
  parallel_for(static_cast<std::int64_t>(chunks), request.threads, [&](std::int64_t chunk) {
    const std::unique_ptr<Field> field = request.field();
    const std::size_t first = static_cast<std::size_t>(chunk) * kChunk;
    for (std::size_t k = first; k < std::min(count, first + kChunk); ++k) {
      if (request.image.cancel != nullptr && request.image.cancel->cancelled()) throw Cancelled();
      body(k, *field);
    }
    traced[static_cast<std::size_t>(chunk)] = field->counts();
  });
  for (const RayCounts& counts : traced) rays += counts;
}

}  // namespace

std::vector<AuditedPixel> audited_pixels(const PixelSampler& sampler, const ImageSurvey* survey,
                                         const SurveyRequest& request, int wanted, RayCounts& rays) {
  const TileProblem& image = request.image;
  const std::vector<Place> places = spread_places(image.image, kCandidates * static_cast<std::size_t>(wanted),
                                                  hash(image.seed, kAuditPlaces));
  std::vector<AuditedPixel> candidates(places.size());
  for_each_pixel(request, places.size(), rays, [&](std::size_t k, Field& field) {
    sample_alone(sampler, survey, image, places[k], field, candidates[k]);
  });
  // Every column counts as much as another.
  const std::size_t columns = candidates.front().value.size();
  std::vector<double> mean(columns, 0.0);
  for (const AuditedPixel& pixel : candidates)
    for (std::size_t c = 0; c < columns; ++c) mean[c] += pixel.variance[c];
  std::vector<double> size(candidates.size(), 0.0);
  double sizes = 0.0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    for (std::size_t c = 0; c < columns; ++c)
      if (mean[c] > 0.0) size[k] += candidates[k].variance[c] / mean[c];
    sizes += size[k];
  }
  std::vector<AuditedPixel> audited;
  std::vector<Place> where;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const double evenly = 1.0 / static_cast<double>(candidates.size()),
                 by_size = sizes > 0.0 ? size[k] / sizes : evenly,
                 chance = std::min(1.0, 0.5 * wanted * (evenly + by_size));
    if (unit_double(hash(image.seed, kAuditChoice, k)) >= chance) continue;
    audited.push_back(std::move(candidates[k]));
    audited.back().weight = 1.0 / chance;
    where.push_back(places[k]);
  }
  for_each_pixel(request, audited.size(), rays,
                 [&](std::size_t k, Field& field) { measure(image, where[k], field, audited[k]); });
  return audited;
}

double conformal_quantile(std::vector<ConformalScore>& scores, double confidence) {
  if (scores.empty()) return 0.0;
  std::sort(scores.begin(), scores.end(),
            [](const ConformalScore& a, const ConformalScore& b) { return a.score < b.score; });
  double sum = 0.0;
  for (const ConformalScore& score : scores) sum += score.weight;
  const double wanted = confidence * sum * (1.0 + 1.0 / static_cast<double>(scores.size()));
  double below = 0.0;
  for (const ConformalScore& score : scores)
    if ((below += score.weight) >= wanted) return score.score;
  return scores.back().score;
}

}  // namespace ifov::sampling
