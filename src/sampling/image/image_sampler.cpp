#include "sampling/image/image_sampler.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "core/run_control.h"
#include "sampling/image/image_block.h"
#include "sampling/image/image_plan.h"
#include "sampling/image/like_pixels.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

namespace {

/// Rounded down to where a block begins that is not beyond it.
int block_start(int at, int origin) { return origin + (at - origin) / LikePixels::kSide * LikePixels::kSide; }

/// Writes pixels in their order, whose blocks come in another.
class PixelsInOrder {
 public:
  PixelsInOrder(const TileProblem& problem, TileResult& result) : problem_(problem), result_(result) {
    unjudged_ = problem;
    unjudged_.tolerance = nullptr;
  }

  void take(const Place& place, SampledPixel& pixel) {
    const PixelRect& tile = problem_.tile;
    if (place.i < tile.x0 || place.i >= tile.x1 || place.j < tile.y0 || place.j >= tile.y1) {
      result_.halo_samples += pixel.samples;
      return;
    }
    const std::size_t at =
        static_cast<std::size_t>(place.j - tile.y0) * static_cast<std::size_t>(tile.width()) +
        static_cast<std::size_t>(place.i - tile.x0);
    waiting_.emplace(at, std::move(pixel));
  }

  void write() {
    for (auto& [at, pixel] : waiting_) {
      result_.samples[at] = result_.radiance_evaluations[at] = pixel.samples;
      write_pixel(pixel.estimate, unjudged_, at, result_);
      // The image is judged as a whole, and what its pixels were to do for it is done, unless they might not.
      result_.reasons[at] = pixel.cut ? bit(Reason::samples) : Reasons{0};
      for (std::size_t c = 0; c < result_.column_errors.size(); ++c) {
        result_.column_errors[c].mean_sum += pixel.estimate.mean[c];
        result_.column_errors[c].variance_sum +=
            pixel.estimate.variance_geometry[c] + pixel.estimate.variance_path[c];
      }
    }
    waiting_.clear();
  }

 private:
  const TileProblem& problem_;
  TileProblem unjudged_;
  TileResult& result_;
  std::map<std::size_t, SampledPixel> waiting_;
};

}  // namespace

std::unique_ptr<const ImageSurvey> ImageSampler::survey(const SurveyRequest& request) const {
  if (request.image.tolerance == nullptr || request.image.footprint == nullptr)
    throw std::invalid_argument("the image sampler needs a tolerance and a footprint");
  return ImagePlan::find(request, most_samples_, pooling_.on);
}

int ImageSampler::block_px() const { return pooling_.on ? LikePixels::kSide : 1; }

void ImageSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  const auto* plan = dynamic_cast<const ImagePlan*>(problem.survey);
  if (plan == nullptr || problem.footprint == nullptr)
    throw std::invalid_argument("the image sampler needs a survey of its own and a footprint");
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  result.column_errors.resize(static_cast<std::size_t>(field.columns()));
  for (std::size_t c = 0; c < result.column_errors.size(); ++c)
    result.column_errors[c].limit = static_cast<float>(plan->limits()[c]);
  ImageBlock block(problem, *plan, field, pooling_.trust);
  PixelsInOrder pixels(problem, result);
  const PixelRect &image = problem.image, &tile = problem.tile;
  // Blocks that reach beyond the tile are sampled whole where their pixels tell of each other.
  const PixelRect wanted = pooling_.on ? image : tile;
  std::vector<Place> places;
  for (int y = block_start(tile.y0, image.y0); y < tile.y1; y += LikePixels::kSide) {
    for (int x = block_start(tile.x0, image.x0); x < tile.x1; x += LikePixels::kSide) {
      if (problem.cancel != nullptr && problem.cancel->cancelled()) throw Cancelled();
      places.clear();
      for (int j = std::max(y, wanted.y0); j < std::min(y + LikePixels::kSide, wanted.y1); ++j)
        for (int i = std::max(x, wanted.x0); i < std::min(x + LikePixels::kSide, wanted.x1); ++i)
          places.push_back({i, j});
      const std::span<SampledPixel> sampled = block.sample(places);
      for (std::size_t k = 0; k < places.size(); ++k) pixels.take(places[k], sampled[k]);
    }
    pixels.write();
  }
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
