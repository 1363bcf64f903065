#include "session/assembly/whole/sampling_assembly.h"

#include <algorithm>

#include "io/document/cameras/view_settings.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/sampling_document.h"
#include "io/document/sensor_document.h"
#include "render/image_renderer.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/tile.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/whole/noise_assembly.h"

namespace ifov::session {

namespace {

render::ErrorUnit unit_of(io::ErrorSize::Unit unit) {
  switch (unit) {
    case io::ErrorSize::Unit::kelvin: return render::ErrorUnit::kelvin;
    case io::ErrorSize::Unit::radiance: return render::ErrorUnit::radiance;
    case io::ErrorSize::Unit::reflectance: return render::ErrorUnit::reflectance;
    case io::ErrorSize::Unit::noise: return render::ErrorUnit::noise;
    case io::ErrorSize::Unit::polarization: return render::ErrorUnit::polarization;
    case io::ErrorSize::Unit::fraction: break;
  }
  return render::ErrorUnit::percent;
}

struct Plan {
  const io::DocumentSources& sources;
  const io::SensorDocument& sensor;
  const std::vector<radiometry::Channel>& channels;

  std::vector<int> judged(const io::DocumentName* channel) const {
    if (channel == nullptr) return {};
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].name == channel->name) return {static_cast<int>(c)};
    throw io::document_error(sources, channel->position, format("there is no channel '{}'", channel->name));
  }

  /// Noise of every channel, W m-2 sr-1 um-1. InputError at a judged channel that declares none.
  std::vector<double> noise(const std::vector<int>& judged) const {
    std::vector<double> result = assemble_noise(sources, sensor, channels);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const bool asked =
          judged.empty() || std::find(judged.begin(), judged.end(), static_cast<int>(c)) != judged.end();
      if (asked && !(result[c] > 0.0))
        throw io::document_error(
            sources, sensor.channels[c].position,
            format("the accuracy is stated as a share of the sensor's noise, and channel '{}' has "
                   "none above 0: give it 'noise', 'noise_temperature' or 'snr', or the sensor a 'detector'",
                   sensor.channels[c].name));
    }
    return result;
  }

  /// What accuracy sampling has to reach.
  void ask(const io::AccuracySampling& source, SamplingPlan& plan) const {
    plan.pilot_rays = source.pilot_rays && !source.of_image();
    render::AccuracyRequest request;
    request.image_wide = source.of_image();
    request.unit = unit_of(source.error.unit);
    request.error = source.error.value;
    request.confidence = source.confidence;
    request.simultaneous = source.simultaneous;
    request.floor = source.floor;
    request.channels = judged(source.channel_looked_at());
    if (request.unit == render::ErrorUnit::noise) request.noise_w_m2_sr_um = noise(request.channels);
    plan.accuracy_asked =
        source.of_image()
            ? format("an RMS over the image of {}{}", io::text_of(source.error),
                     source.channel ? format(" in channel '{}'", source.channel->name) : " in every channel")
            : format("{}{}, confidence {:g} % {}", io::text_of(source.error),
                     source.channel ? format(" in channel '{}'", source.channel->name) : " in every channel",
                     100.0 * source.confidence,
                     source.simultaneous ? "for all pixels and channels together" : "per pixel and channel");
    plan.steering_channels =
        render::steering_channels_of(static_cast<int>(channels.size()), request.channels);
    plan.request = std::move(request);
  }
};

/// A plan that was made for channels, for what paths carry of them.
void count_by_carried(const sensor::ColumnResponses& responses, SamplingPlan& plan) {
  const auto carried_of = [&](const std::vector<int>& channels) {
    std::vector<int> carried;
    for (const int channel : channels) {
      const auto c = static_cast<std::size_t>(channel);
      for (std::size_t k = responses.first(c); k < responses.first(c + 1); ++k)
        carried.push_back(static_cast<int>(k));
    }
    return carried;
  };
  if (!plan.request) {
    plan.steering_channels = carried_of(plan.steering_channels);
    return;
  }
  render::AccuracyRequest& request = *plan.request;
  request.channels = carried_of(request.channels);
  const std::vector<double> noise = std::move(request.noise_w_m2_sr_um);
  request.noise_w_m2_sr_um.clear();
  for (std::size_t k = 0; !noise.empty() && k < responses.carried(); ++k)
    request.noise_w_m2_sr_um.push_back(noise[responses.channel_of(k)]);
  plan.steering_channels =
      render::steering_channels_of(static_cast<int>(responses.carried()), request.channels);
}

}  // namespace

SamplingPlan assemble_sampling(const io::DocumentSources& sources, const io::SamplingDocument& sampling,
                               const io::SensorDocument& sensor,
                               const std::vector<radiometry::Channel>& channels,
                               const sensor::ColumnResponses* responses) {
  const Plan assemble{sources, sensor, channels};
  const io::SamplerSettings& settings = *sampling.method;
  SamplingPlan plan;
  const bool views = dynamic_cast<const io::ViewSettings*>(sensor.camera.settings.get()) != nullptr;
  plan.sampler = views ? settings.build_for_views() : settings.build();
  plan.method = settings.description();
  plan.knows_errors = settings.knows_errors();
  if (const auto* accuracy = io::sampler_as<io::AccuracySampling>(sampling))
    assemble.ask(*accuracy, plan);
  else
    plan.steering_channels = assemble.judged(settings.channel_looked_at());
  if (responses != nullptr) count_by_carried(*responses, plan);
  return plan;
}

void check_image_size(const io::DocumentSources& sources, const io::SamplingDocument& sampling,
                      std::int64_t pixels) {
  const auto* accuracy = io::sampler_as<io::AccuracySampling>(sampling);
  if (accuracy != nullptr && accuracy->of_image() && pixels < 2)
    throw io::document_error(
        sources, accuracy->position,
        "the error is asked of the image, and the image is one pixel: \"of\": \"pixel\" is "
        "of each pixel's own interval");
  constexpr int kReach_px = 192;  // of a PSF, on either side of a tile
  if (accuracy != nullptr && accuracy->lattice &&
      *accuracy->lattice * (sampling.tile_px + 2 * kReach_px) > sampling::AccuracySampler::kMostCells)
    throw io::document_error(
        sources, accuracy->position,
        format(
            "a lattice of {0} cells a pixel goes with a 'tile' of {1} pixels at most, and it has {2}: give a smaller tile or a coarser lattice",
            *accuracy->lattice, sampling::AccuracySampler::kMostCells / *accuracy->lattice - 2 * kReach_px,
            sampling.tile_px));
  const std::optional<int> audited = sampling.method->audited_pixels();
  if (audited && *audited > pixels)
    throw io::document_error(
        sources, sampling.position,
        format("an audit of {} pixels is asked for, and the image has {}: audit fewer", *audited, pixels));
}

}  // namespace ifov::session
