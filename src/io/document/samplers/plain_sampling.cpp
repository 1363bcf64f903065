#include "io/document/samplers/plain_sampling.h"

#include "core/format.h"
#include "io/document/samplers/audit_setting.h"
#include "io/document/schema/record.h"
#include "sampling/adaptive_sampler.h"
#include "sampling/grid_sampler.h"

namespace ifov::io {
namespace {

constexpr int kMostElements = 1000;
constexpr const char* kAuditWords =
    "how many pixels of the image are measured once more by independent rays (each takes some 400 values), from which "
    "half-widths are calibrated and the image's error is told; 200 do for most";

SchemaType<std::shared_ptr<const SamplerSettings>> single_type() {
  return sampler_type(
      Record<SingleSampling>("single sampling", "One ray through the centre of each pixel.").type());
}

SchemaType<std::array<int, 2>> elements_type() { return tuple<int, 2>(integer(1, kMostElements)); }

SchemaType<std::shared_ptr<const SamplerSettings>> grid_type() {
  Record<GridSampling> record("grid sampling", "Rays through the centres of equal cells of each pixel.");
  record
      .required("elements",
                via(
                    [](GridSampling& grid, std::array<int, 2> n) {
                      grid.columns = n[0];
                      grid.rows = n[1];
                    },
                    [](const GridSampling& grid) {
                      return std::array{grid.columns, grid.rows};
                    }),
                elements_type(), "cells across and down")
      .optional("audit", &GridSampling::audit, audit_type(), kAuditWords);
  return sampler_type(record.type());
}

SchemaType<std::shared_ptr<const SamplerSettings>> adaptive_type() {
  Record<AdaptiveSampling> record(
      "adaptive sampling", "Sub-elements of a pixel that differ from their neighbours get more samples.");
  record
      .required("sub_elements",
                via(
                    [](AdaptiveSampling& a, std::array<int, 2> n) {
                      a.sub_columns = n[0];
                      a.sub_rows = n[1];
                    },
                    [](const AdaptiveSampling& a) {
                      return std::array{a.sub_columns, a.sub_rows};
                    }),
                elements_type(), "sub-elements across and down")
      .required(
          "allowed_difference", &AdaptiveSampling::allowed_difference,
          error_size_type({{ErrorSize::Unit::radiance, &kRadiance}, {ErrorSize::Unit::fraction, &kPercent}}),
          "between a new sample and the average so far")
      .with_default("max_samples", &AdaptiveSampling::max_samples, integer(1, 1000000), "100", "per pixel")
      .optional("channel", &AdaptiveSampling::channel, name_of("a channel"),
                "that is compared; without it the channel that differs most")
      .optional("audit", &AdaptiveSampling::audit, audit_type(), kAuditWords);
  return sampler_type(record.type());
}

}  // namespace

constinit const SamplerModel SingleSampling::kModel{"single", "one ray a pixel", single_type};
constinit const SamplerModel GridSampling::kModel{"grid", "the same rays in every pixel", grid_type};
constinit const SamplerModel AdaptiveSampling::kModel{"adaptive", "more rays where samples differ",
                                                      adaptive_type};

std::unique_ptr<sampling::PixelSampler> SingleSampling::build() const {
  return std::make_unique<sampling::SingleSampler>();
}

std::string SingleSampling::description() const { return "single ray"; }

std::unique_ptr<sampling::PixelSampler> GridSampling::build() const {
  return audited(std::make_unique<sampling::GridSampler>(columns, rows), audit);
}

std::string GridSampling::description() const {
  return format("grid {} x {}{}", columns, rows, audit_words(audit));
}

std::unique_ptr<sampling::PixelSampler> AdaptiveSampling::build() const {
  sampling::AdaptiveOptions options;
  options.sub_elements_x = sub_columns;
  options.sub_elements_y = sub_rows;
  options.max_samples = max_samples;
  options.allowed_difference = allowed_difference.value;
  options.relative = allowed_difference.unit == ErrorSize::Unit::fraction;
  return audited(std::make_unique<sampling::AdaptiveSampler>(options), audit);
}

std::string AdaptiveSampling::description() const {
  return format("adaptive, {} x {} sub-elements, at most {} samples, difference {}{}", sub_columns, sub_rows,
                max_samples, text_of(allowed_difference), audit_words(audit));
}

}  // namespace ifov::io
