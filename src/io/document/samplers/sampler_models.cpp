#include <array>

#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/plain_sampling.h"
#include "io/document/samplers/sampler_model.h"

namespace ifov::io {
namespace {

constexpr std::array kModels{&SingleSampling::kModel, &GridSampling::kModel, &AdaptiveSampling::kModel,
                             &AccuracySampling::kModel};

}  // namespace

std::span<const SamplerModel* const> sampler_models() { return kModels; }

std::shared_ptr<const SamplerSettings> usual_sampler() { return std::make_shared<const AccuracySampling>(); }

}  // namespace ifov::io
