#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiometry/channel.h"
#include "render/tolerance/accuracy_request.h"
#include "sampling/pixel_sampler.h"

namespace ifov::io {
struct SensorDocument;
struct DocumentSources;
struct SamplingDocument;
}  // namespace ifov::io
namespace ifov::sensor {
class ColumnResponses;
}

namespace ifov::session {

/// How a document's image is to be sampled.
struct SamplingPlan {
  std::unique_ptr<sampling::PixelSampler> sampler;
  std::optional<render::AccuracyRequest> request;  ///< only where an accuracy is asked for
  std::string method;                              ///< for people: "grid 10 x 10"
  std::string accuracy_asked;  ///< for people: "0.1 K in channel 'B10', at 95 %"; may be empty
  bool pilot_rays = false;
  bool knows_errors = true;  ///< false for single rays
  std::vector<int> steering_channels;
};

/// An accuracy may be stated by the sensor's noise. `responses`: what paths carry, by which the plan counts; null: the channels.
SamplingPlan assemble_sampling(const io::DocumentSources& sources, const io::SamplingDocument& sampling,
                               const io::SensorDocument& sensor,
                               const std::vector<radiometry::Channel>& channels,
                               const sensor::ColumnResponses* responses = nullptr);

/// Fails where an image of so many pixels has too few for what is asked of it as a whole.
void check_image_size(const io::DocumentSources& sources, const io::SamplingDocument& sampling,
                      std::int64_t pixels);

}  // namespace ifov::session
