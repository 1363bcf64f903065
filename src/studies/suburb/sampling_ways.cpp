#include "studies/suburb/sampling_ways.h"

#include <utility>

#include "core/format.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/plain_sampling.h"
#include "studies/common/study_document.h"

namespace ifov::studies {

namespace {

const char* audited(const std::optional<int>& audit) { return audit ? ", audited" : ""; }

}  // namespace

SamplingWay grid_way(int n, std::optional<int> audit) {
  if (n == 1) return {"one ray a pixel", "single", sampling_of(io::SingleSampling{})};
  io::GridSampling grid(n, n);
  grid.audit = audit;
  return {format("grid {} x {}{}", n, n, audited(audit)), format("grid {}", n), sampling_of(std::move(grid))};
}

SamplingWay adaptive_way(const std::string& channel, double difference) {
  io::AdaptiveSampling adaptive;
  adaptive.sub_columns = adaptive.sub_rows = 5;
  adaptive.max_samples = 100;
  adaptive.allowed_difference = {difference, io::ErrorSize::Unit::fraction};
  adaptive.channel = io::DocumentName{channel, {}};
  return {"adaptive, 25 sub-elements, at most 100 samples",
          format("adaptive, difference {:.2g} % in {}", 100.0 * difference, channel), sampling_of(adaptive)};
}

SamplingWay accuracy_way(double error) {
  io::AccuracySampling accuracy;
  accuracy.error = {error, io::ErrorSize::Unit::reflectance};
  return {format("accuracy, {:.2g} of reflectance", error),
          format("accuracy, error {:.4g} reflectance", error), sampling_of(accuracy)};
}

SamplingWay image_way(double noises, std::optional<int> audit) {
  io::AccuracySampling accuracy;
  accuracy.error = {noises, io::ErrorSize::Unit::noise};
  accuracy.of = io::AccuracySampling::Of::image;
  accuracy.pooling = true;
  accuracy.audit = audit;
  return {format("image, {:.3g} of the limits{}", noises, audited(audit)),
          format("accuracy, error {:.3g} noise of image", noises), sampling_of(accuracy)};
}

}  // namespace ifov::studies
