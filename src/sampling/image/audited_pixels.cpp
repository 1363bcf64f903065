#include "sampling/image/audited_pixels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/parallel.h"
#include "core/run_control.h"
#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/image/audit.h"
#include "sampling/image/bright_places.h"
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

/// Pixels that are sampled at once: those of a block, or one.
struct Cluster {
  PixelRect block;
  std::vector<std::size_t> candidates;
};

/// Candidates, and the blocks that they lie in: where blocks are large, several in each of fewer blocks, because one costs as much as
/// all of its block. Each pixel has the same chance.
std::vector<Place> candidate_places(const TileProblem& image, std::size_t count, int block_px,
                                    std::vector<Cluster>& clusters) {
  const PixelRect& all = image.image;
  const std::uint64_t key = hash(image.seed, kAuditPlaces);
  std::map<std::pair<int, int>, std::size_t> cluster_of;
  std::vector<Place> places;
  const auto add = [&](const Place& place) {
    const int x = all.x0 + (place.i - all.x0) / block_px * block_px,
              y = all.y0 + (place.j - all.y0) / block_px * block_px;
    const auto [found, is_new] = cluster_of.try_emplace({y, x}, clusters.size());
    if (is_new)
      clusters.push_back({{x, y, std::min(x + block_px, all.x1), std::min(y + block_px, all.y1)}, {}});
    clusters[found->second].candidates.push_back(places.size());
    places.push_back(place);
  };
  if (block_px == 1 || static_cast<std::size_t>(all.count()) <= count) {
    for (const Place& place : spread_places(all, count, key)) add(place);
    return places;
  }
  // Places choose blocks, so that blocks are chosen by their pixels; of each that is chosen, some pixels are drawn.
  constexpr std::size_t kOfBlock = 12;
  const std::vector<Place> chosen = spread_places(all, (count + kOfBlock - 1) / kOfBlock, key);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const int x = all.x0 + (chosen[k].i - all.x0) / block_px * block_px,
              y = all.y0 + (chosen[k].j - all.y0) / block_px * block_px;
    const PixelRect block{x, y, std::min(x + block_px, all.x1), std::min(y + block_px, all.y1)};
    for (const Place& place : spread_places(block, kOfBlock, hash(key, k))) add(place);
  }
  return places;
}

/// Pixels as the image will have them: samplers make the same of them whatever tile they lie in.
void sample_alone(const PixelSampler& sampler, const ImageSurvey* survey, const TileProblem& image,
                  const Cluster& cluster, std::span<const Place> places, Field& field,
                  std::span<AuditedPixel> pixels) {
  TileProblem problem = image;
  problem.tile = cluster.block;
  problem.survey = survey;
  TileResult result;
  sampler.sample(problem, field, result);
  const auto columns = static_cast<std::size_t>(result.columns);
  const std::vector<Audit::PixelClass> classes = classes_of(result);
  for (const std::size_t k : cluster.candidates) {
    const auto at = static_cast<std::size_t>((places[k].j - cluster.block.y0) * cluster.block.width() +
                                             places[k].i - cluster.block.x0);
    AuditedPixel& pixel = pixels[k];
    const auto value = result.mean.begin() + static_cast<std::ptrdiff_t>(at * columns);
    pixel.value.assign(value, value + static_cast<std::ptrdiff_t>(columns));
    pixel.variance.resize(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      const double sum = static_cast<double>(result.variance_geometry[at * columns + c]) +
                         static_cast<double>(result.variance_path[at * columns + c]);
      pixel.variance[c] = std::isfinite(sum) ? sum : 0.0;
    }
    pixel.mixed = classes[at] == Audit::kMixed;
  }
}

/// Adds the mean of a group of points to a half, which is so much of the pixel's response by group of columns.
void add_mean(const TileProblem& image, const PixelPoints& points, const ColumnFootprints& footprints,
              std::span<const double> of_pixel, Field& field, std::vector<double>& half) {
  const std::size_t groups = footprints.groups(), count = points.requests.size();
  std::vector<double> shares(groups * count, 1.0 / static_cast<double>(count));  // [request][group]
  if (!points.importance.empty())
    for (std::size_t g = 0; g < groups; ++g) {
      double all = 0.0;
      for (std::size_t k = g; k < shares.size(); k += groups) all += points.importance[k];
      for (std::size_t k = g; k < shares.size() && all > 0.0; k += groups)
        shares[k] = points.importance[k] / all;
    }
  for_each_value(
      field, image.cancel, count, [&](std::size_t k) { return points.requests[k]; },
      [&](std::size_t k, Label, const float* values) {
        for (std::size_t c = 0; c < half.size(); ++c) {
          const std::size_t g = footprints.group_of(c);
          half[c] += of_pixel[g] * shares[k * groups + g] * static_cast<double>(values[c]);
        }
      });
}

void measure(const TileProblem& image, const Place& place, Field& field, AuditedPixel& pixel) {
  PixelPoints points;
  const PixelPlan plan{Audit::kSide, Audit::kSide, 0};
  const ColumnFootprints footprints = image.footprints(field);
  const BrightShares bright = bright_shares(image, footprints, place.i, place.j);
  for (std::size_t h = 0; h < 2; ++h) {
    const std::uint64_t key = hash(image.seed, place.i, place.j, kAuditPaths, h);
    pixel.half[h].assign(static_cast<std::size_t>(field.columns()), 0.0);
    points.clear();
    points.add(image, bright, place.i, place.j, key, plan);
    add_mean(image, points, footprints, bright.left, field, pixel.half[h]);
    for (std::size_t n = 0; n < bright.parts.size(); ++n) {
      points.clear();
      points.add(image, bright.parts[n].where, place.i, place.j, hash(key, n), plan);
      add_mean(image, points, footprints, bright.parts[n].share, field, pixel.half[h]);
    }
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
  std::vector<Cluster> clusters;
  const std::vector<Place> places =
      candidate_places(image, kCandidates * static_cast<std::size_t>(wanted), sampler.block_px(), clusters);
  std::vector<AuditedPixel> candidates(places.size());
  for_each_pixel(request, clusters.size(), rays, [&](std::size_t k, Field& field) {
    sample_alone(sampler, survey, image, clusters[k], places, field, candidates);
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
