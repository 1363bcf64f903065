#include "session/assembly/whole/sampling_assembly.h"

#include <algorithm>
#include <cmath>

#include "io/document/document.h"
#include "render/image_renderer.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/adaptive_sampler.h"
#include "sampling/grid_sampler.h"
#include "sampling/single_sampler.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

std::string text_of(const io::ErrorSize& error) {
  switch (error.unit) {
    case io::ErrorSize::Unit::kelvin: return format("{:g} K", error.value);
    case io::ErrorSize::Unit::radiance: return format("{:g} W m-2 sr-1 um-1", error.value);
    case io::ErrorSize::Unit::fraction: return format("{:g} %", 100.0 * error.value);
    case io::ErrorSize::Unit::reflectance: return format("{:g} reflectance", error.value);
    case io::ErrorSize::Unit::noise: return format("{:g} of the sensor's noise", error.value);
  }
  return {};
}

render::ErrorUnit unit_of(io::ErrorSize::Unit unit) {
  switch (unit) {
    case io::ErrorSize::Unit::kelvin: return render::ErrorUnit::kelvin;
    case io::ErrorSize::Unit::radiance: return render::ErrorUnit::radiance;
    case io::ErrorSize::Unit::reflectance: return render::ErrorUnit::reflectance;
    case io::ErrorSize::Unit::noise: return render::ErrorUnit::noise;
    case io::ErrorSize::Unit::fraction: break;
  }
  return render::ErrorUnit::percent;
}

struct Plan {
  const io::Document& document;
  const std::vector<radiometry::Channel>& channels;

  std::vector<int> judged(const std::optional<io::DocumentName>& channel) const {
    if (!channel) return {};
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].name == channel->name) return {static_cast<int>(c)};
    throw io::document_error(document, channel->position, format("there is no channel '{}'", channel->name));
  }

  /// Noise of every channel, W m-2 sr-1 um-1. InputError at a judged channel that declares none.
  std::vector<double> noise(const std::vector<int>& judged) const {
    constexpr double kWarm_k = 300.0;
    std::vector<double> result(channels.size(), 0.0);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const io::ChannelDocument& source = document.sensor.channels[c];
      if (source.noise)
        result[c] = with_position(document, source.position, [&] {
          return assemble_spectrum(document, *source.noise, "noise").at(channels[c].centre_um);
        });
      else if (source.noise_k)
        result[c] = *source.noise_k * radiometry::channel_planck_slope_w_m2_sr_um_k(channels[c], kWarm_k);
      const bool asked =
          judged.empty() || std::find(judged.begin(), judged.end(), static_cast<int>(c)) != judged.end();
      if (asked && !(result[c] > 0.0))
        throw io::document_error(
            document, source.position,
            format("the accuracy is stated as a share of the sensor's noise, and channel '{}' has "
                   "none above 0: give it 'noise' or 'noise_temperature'",
                   source.name));
    }
    return result;
  }

  SamplingPlan operator()(const io::SingleSampling&) const {
    SamplingPlan plan;
    plan.sampler = std::make_unique<sampling::SingleSampler>();
    plan.method = "single ray";
    plan.knows_errors = false;
    return plan;
  }

  SamplingPlan operator()(const io::GridSampling& source) const {
    SamplingPlan plan;
    plan.sampler = std::make_unique<sampling::GridSampler>(source.columns, source.rows);
    plan.method = format("grid {} x {}", source.columns, source.rows);
    return plan;
  }

  SamplingPlan operator()(const io::AdaptiveSampling& source) const {
    sampling::AdaptiveOptions options;
    options.sub_elements_x = source.sub_columns;
    options.sub_elements_y = source.sub_rows;
    options.max_samples = source.max_samples;
    options.allowed_difference = source.allowed_difference.value;
    options.relative = source.allowed_difference.unit == io::ErrorSize::Unit::fraction;
    SamplingPlan plan;
    plan.sampler = std::make_unique<sampling::AdaptiveSampler>(options);
    plan.method =
        format("adaptive, {} x {} sub-elements, at most {} samples, difference {}", source.sub_columns,
               source.sub_rows, source.max_samples, text_of(source.allowed_difference));
    plan.drivers = judged(source.channel);
    return plan;
  }

  SamplingPlan operator()(const io::AccuracySampling& source) const {
    sampling::AccuracyOptions options;
    if (source.lattice) options.lattice = *source.lattice;
    options.probes_per_side = static_cast<int>(std::lround(std::sqrt(source.probes)));
    options.seeds = source.seeds;
    options.thinnest_px = source.thinnest_px;
    options.max_samples_per_pixel = static_cast<std::uint32_t>(source.max_samples);
    options.clutter_switch = source.clutter;
    SamplingPlan plan;
    plan.sampler = std::make_unique<sampling::AccuracySampler>(options);
    plan.method = "accuracy";
    plan.seed_objects = source.seeds;
    render::AccuracyRequest request;
    request.unit = unit_of(source.error.unit);
    request.error = source.error.value;
    request.confidence = source.confidence;
    request.simultaneous = source.simultaneous;
    request.floor = source.floor;
    request.channels = judged(source.channel);
    if (request.unit == render::ErrorUnit::noise) request.noise_w_m2_sr_um = noise(request.channels);
    plan.accuracy_asked =
        format("{}{}, confidence {:g} % {}", text_of(source.error),
               source.channel ? format(" in channel '{}'", source.channel->name) : " in every channel",
               100.0 * source.confidence,
               source.simultaneous ? "for all pixels and channels together" : "per pixel and channel");
    plan.drivers = render::driver_channels(static_cast<int>(channels.size()), request.channels);
    plan.request = std::move(request);
    return plan;
  }
};

}  // namespace

SamplingPlan assemble_sampling(const io::Document& document,
                               const std::vector<radiometry::Channel>& channels) {
  return std::visit(Plan{document, channels}, document.sampling.method);
}

}  // namespace ifov::session
