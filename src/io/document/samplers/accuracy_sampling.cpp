#include "io/document/samplers/accuracy_sampling.h"

#include <cmath>

#include "core/format.h"
#include "io/document/samplers/audit_setting.h"
#include "io/document/schema/record.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/image/image_sampler.h"

namespace ifov::io {
namespace {

constexpr std::int64_t kMostSamples = 1000000000;

SchemaType<std::shared_ptr<const SamplerSettings>> accuracy_type() {
  Record<AccuracySampling> record("accuracy sampling",
                                  "Rays go where they are needed until the error is as asked.");
  record
      .with_default(
          "error", &AccuracySampling::error,
          error_size_type({{ErrorSize::Unit::kelvin, &kTemperatureDifference},
                           {ErrorSize::Unit::fraction, &kPercent},
                           {ErrorSize::Unit::radiance, &kRadiance},
                           {ErrorSize::Unit::reflectance, &kReflectance},
                           {ErrorSize::Unit::noise, &kNoise},
                           {ErrorSize::Unit::polarization, &kDegreeOfPolarization}}),
          "\"1 %\"",
          "allowed half-width of each pixel's interval: brightness temperature, share of the pixel's value, "
          "radiance, apparent reflectance, share of the noise that channels declare, or degree of linear "
          "polarization in percentage points (of a sensor with 'stokes'); never finer than "
          "1e-5 of the value, the precision of the products; reflectance is not judged in channels where a white "
          "surface sends less than 1 % of what the air does")
      .with_default(
          "of", &AccuracySampling::of,
          choice<AccuracySampling::Of>(
              {{"pixel", AccuracySampling::Of::pixel}, {"image", AccuracySampling::Of::image}}),
          "\"pixel\"",
          "what the error is of: the half-width of every pixel's interval; or the root mean square over the "
          "image's pixels, channel by channel, where percent are of the channel's mean over the image, and "
          "kelvin at it")
      .optional(
          "audit", &AccuracySampling::audit, audit_type(),
          "of an image: how many of its pixels are measured once more by independent rays (each takes some "
          "400 values), from which half-widths and the image's error are calibrated; 200 do for most")
      .with_default(
          "pooling", &AccuracySampling::pooling, boolean(), "false",
          "of an image: light from the sky and from other surfaces is shrunk towards what like pixels of the "
          "same block of 8 x 8 have, as much as these are alike; errors of neighbours then go together")
      .with_default("confidence", &AccuracySampling::confidence, fraction({0.5, 1.0, false, true, {}}),
                    "0.95", "probability with which the interval holds the true value")
      .optional("channel", &AccuracySampling::channel, name_of("a channel"), "that is judged; without it all")
      .with_default("simultaneous", &AccuracySampling::simultaneous, boolean(), "false",
                    "confidence for all channels of a pixel at once")
      .optional("lattice", &AccuracySampling::lattice, integer(1, sampling::AccuracySampler::kMostLattice),
                "cells of the detection lattice along a side of a pixel; chosen if not given")
      .with_default("probes", &AccuracySampling::probes, integer(0, 10000), "9",
                    "probing rays in a flagged pixel and round")
      .with_default("pilot_rays", &AccuracySampling::pilot_rays, boolean(), "true",
                    "one ray for each known object smaller than a pixel")
      .formerly("seeds")
      .with_default("thinnest", &AccuracySampling::thinnest_px, quantity(kPixels, Range::above(0.0, "px")),
                    "\"0.0125 px\"", "thinnest feature that is followed")
      .optional("max_samples", &AccuracySampling::max_samples, long_integer(1, kMostSamples),
                "per pixel; 100,000 if not given, of single views 100,000,000")
      .with_default("floor", &AccuracySampling::floor, fraction(Range::between(0.0, 1.0)), "\"0.1 %\"",
                    "share of a white surface's radiance W: in percent no half-width need be below floor x "
                    "W; in K a pixel is "
                    "taken to be no colder than one of radiance floor x W, in DoLP no darker")
      .with_default("clutter", &AccuracySampling::clutter, boolean(), "true",
                    "stratified samples instead of edges where there are too many edges");
  record.check([](const AccuracySampling& accuracy, const DocumentNode& node) {
    if (!accuracy.of_image()) {
      if (const DocumentNode* audit = node.find("audit"))
        audit->fail_at_key(
            "an audit is of an image: \"of\": \"image\" goes with it; intervals of single pixels need none");
      if (accuracy.pooling)
        node.find("pooling")->fail_at_key(
            "pixels are pooled for an error of the image: \"of\": \"image\" goes with it");
      return;
    }
    for (const char* key : {"lattice", "probes", "pilot_rays", "thinnest", "clutter", "simultaneous"})
      if (const DocumentNode* own = node.find(key))
        own->fail_at_key(format("'{}' is of errors pixel by pixel, and \"of\" is \"image\"", key));
  });
  return sampler_type(record.type());
}

}  // namespace

constinit const SamplerModel AccuracySampling::kModel{"accuracy", "as many rays as an accuracy needs",
                                                      accuracy_type};

std::unique_ptr<sampling::PixelSampler> AccuracySampling::build(std::int64_t most_samples) const {
  if (of_image())
    return audited(std::make_unique<sampling::ImageSampler>(static_cast<std::uint32_t>(most_samples),
                                                            sampling::ImageSampler::Pooling{pooling}),
                   audit);
  sampling::AccuracyOptions options;
  if (lattice) options.lattice = *lattice;
  options.probes_per_side = static_cast<int>(std::lround(std::sqrt(probes)));
  options.pilot_rays = pilot_rays;
  options.thinnest_px = thinnest_px;
  options.max_samples_per_pixel = static_cast<std::uint32_t>(most_samples);
  options.clutter_switch = clutter;
  return std::make_unique<sampling::AccuracySampler>(options);
}

std::string AccuracySampling::description() const {
  if (!of_image()) return "accuracy";
  return (pooling ? "accuracy of the image, pooled" : "accuracy of the image") + audit_words(audit);
}

}  // namespace ifov::io
