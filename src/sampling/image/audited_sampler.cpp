#include "sampling/image/audited_sampler.h"

#include <cmath>
#include <stdexcept>

#include "sampling/image/audit.h"

namespace ifov::sampling {

AuditedSampler::AuditedSampler(std::unique_ptr<PixelSampler> sampler, int pixels)
    : sampler_(std::move(sampler)), pixels_(pixels) {
  if (pixels < 20) throw std::invalid_argument("an audit needs at least 20 pixels");
}

std::unique_ptr<const ImageSurvey> AuditedSampler::survey(const SurveyRequest& request) const {
  return Audit::make(*sampler_, sampler_->survey(request), request, pixels_);
}

void AuditedSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  const auto* audit = dynamic_cast<const Audit*>(problem.survey);
  if (audit == nullptr) throw std::invalid_argument("an audited sampler needs a survey of its own");
  TileProblem inner = problem;
  inner.survey = audit->inner();
  sampler_->sample(inner, field, result);
  const auto columns = static_cast<std::size_t>(result.columns);
  if (result.column_errors.empty()) {
    result.column_errors.resize(columns);
    for (std::size_t at = 0; at < result.mean.size(); ++at) {
      ColumnError& of = result.column_errors[at % columns];
      of.mean_sum += static_cast<double>(result.mean[at]);
      of.variance_sum +=
          static_cast<double>(result.variance_geometry[at]) + static_cast<double>(result.variance_path[at]);
    }
  }
  if (audit->pixels() == 0) return;
  for (std::size_t c = 0; c < columns; ++c) {
    result.column_errors[c].audited = static_cast<float>(audit->ratios()[c]);
    result.column_errors[c].variance_sum +=
        audit->least_variance(c) * static_cast<double>(result.samples.size());
  }
  const std::vector<Audit::PixelClass> classes = classes_of(result);
  for (std::size_t at = 0; at < result.half_width.size(); ++at) {
    const std::size_t c = at % columns;
    const double variance = static_cast<double>(result.variance_geometry[at]) +
                            static_cast<double>(result.variance_path[at]) + audit->least_variance(c);
    result.half_width[at] =
        static_cast<float>(audit->multiplier(classes[at / columns], c) * std::sqrt(variance));
  }
}

}  // namespace ifov::sampling
