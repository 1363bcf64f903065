#include "sampling/image/audit.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/run_control.h"
#include "sampling/image/audited_pixels.h"
#include "sampling/pixel_sampler.h"

namespace ifov::sampling {

std::vector<Audit::PixelClass> classes_of(const TileResult& tile) {
  std::vector<Audit::PixelClass> classes(tile.samples.size(), Audit::kMixed);
  for (const Abundance& share : tile.abundances)
    if (static_cast<double>(share.fraction) >= Audit::kPureShare) classes[share.pixel] = Audit::kPure;
  return classes;
}

std::unique_ptr<const Audit> Audit::make(const PixelSampler& sampler,
                                         std::unique_ptr<const ImageSurvey> inner,
                                         const SurveyRequest& request, int pixels) {
  std::unique_ptr<Audit> audit(new Audit());
  audit->inner_ = std::move(inner);
  if (audit->inner_ != nullptr) audit->rays = audit->inner_->rays;
  const double confidence = request.image.tolerance != nullptr ? request.image.tolerance->confidence() : 0.95;
  const std::vector<AuditedPixel> audited =
      audited_pixels(sampler, audit->inner_.get(), request, pixels, audit->rays);
  audit->pixels_ = audited.size();
  if (audited.empty()) return audit;
  const std::size_t columns = audited.front().value.size();

  audit->least_variance_.resize(columns);
  audit->ratios_.resize(columns);
  for (std::vector<double>& multipliers : audit->multipliers_) multipliers.resize(columns);
  std::array<std::size_t, kClasses> count{};
  for (const AuditedPixel& pixel : audited) ++count[pixel.mixed ? kMixed : kPure];
  std::vector<ConformalScore> scores;
  for (std::size_t c = 0; c < columns; ++c) {
    double sum = 0.0, weights = 0.0, squares = 0.0, fourths = 0.0, stated = 0.0;
    for (const AuditedPixel& pixel : audited) {
      sum += pixel.weight * std::abs(pixel.value[c]);
      weights += pixel.weight;
    }
    constexpr double kPrecision = 1e-5;
    const double least = kPrecision * sum / weights;
    audit->least_variance_[c] = least * least;
    for (const AuditedPixel& pixel : audited) {
      const double square =
          pixel.weight * (pixel.value[c] - pixel.half[0][c]) * (pixel.value[c] - pixel.half[1][c]);
      squares += square;
      fourths += square * square;
      stated += pixel.weight * (pixel.variance[c] + audit->least_variance_[c]);
    }
    // What is less than its own standard error is not told to be less.
    audit->ratios_[c] = stated > 0.0 ? std::max(squares, std::sqrt(fourths)) / stated : 0.0;
    for (std::size_t k = 0; k < kClasses; ++k) {
      scores.clear();
      double noise = 0.0, all = 0.0;
      for (const AuditedPixel& pixel : audited) {
        if (count[k] >= kLeastOfClass && (pixel.mixed ? kMixed : kPure) != k) continue;
        const double away = pixel.value[c] - 0.5 * (pixel.half[0][c] + pixel.half[1][c]),
                     apart = 0.5 * (pixel.half[0][c] - pixel.half[1][c]),
                     variance = pixel.variance[c] + audit->least_variance_[c];
        if (!(variance > 0.0)) continue;
        noise += pixel.weight * apart * apart / variance;
        all += pixel.weight * away * away / variance;
        scores.push_back({std::abs(away) / std::sqrt(variance), pixel.weight});
      }
      const double own = all > 0.0 ? std::sqrt(std::max(0.0, 1.0 - noise / all)) : 1.0;
      audit->multipliers_[k][c] = own * conformal_quantile(scores, confidence);
    }
  }
  return audit;
}

}  // namespace ifov::sampling
