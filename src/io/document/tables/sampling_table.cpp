#include "core/format.h"
#include "core/names.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr int kMostElements = 1000;
constexpr std::int64_t kMostSamples = 1000000000;

struct ErrorUnit {
  ErrorSize::Unit unit;
  const Dimension* dimension;
};

/// A size whose unit says what is meant.
Kind<ErrorSize> error_size_kind(const std::vector<ErrorUnit>& allowed) {
  ValueDescription d;
  d.form = ValueDescription::Form::alternatives;
  std::string examples, units;
  for (const ErrorUnit& one : allowed) {
    ValueDescription text;
    text.expected = std::string(one.dimension->name);
    text.short_name = text.expected.substr(2);
    text.pattern = quantity_pattern(*one.dimension, Sign::positive);
    d.alternatives.push_back(std::make_shared<const ValueDescription>(std::move(text)));
    examples += format("{}\"{}\"", examples.empty() ? "" : ", ", one.dimension->example);
    units += format("{}{}", units.empty() ? "" : ", ", one.dimension->unit_list());
  }
  d.expected = format("a size above 0 with its unit, such as {} (units: {})", examples, units);
  d.short_name = format("size in {}", units);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {
      description, [description, allowed](const DocumentNode& node) {
        if (node.type() == DocumentNode::Type::text) {
          const std::optional<QuantityText> parts = split_quantity(node.text());
          for (const ErrorUnit& one : allowed) {
            if (!parts || one.dimension->find(parts->unit) == nullptr) continue;
            const Range positive = Range::above(0.0, one.dimension->units[0].spelling);
            return ErrorSize{read_quantity(node, *one.dimension, positive, description->expected), one.unit};
          }
        }
        node.fail_expected(description->expected);
      }};
}

Kind<std::array<int, 2>> elements_kind() { return tuple<int, 2>(integer(1, kMostElements)); }

Kind<GridSampling> grid_kind() {
  Record<GridSampling> record("grid sampling", "Rays through the centres of equal cells of each pixel.");
  record.required(
      "elements",
      [](GridSampling& grid, std::array<int, 2> n) {
        grid.columns = n[0];
        grid.rows = n[1];
      },
      elements_kind(), "cells across and down");
  return record.kind();
}

Kind<AdaptiveSampling> adaptive_kind() {
  Record<AdaptiveSampling> record(
      "adaptive sampling", "Sub-elements of a pixel that differ from their neighbours get more samples.");
  record
      .required(
          "sub_elements",
          [](AdaptiveSampling& a, std::array<int, 2> n) {
            a.sub_columns = n[0];
            a.sub_rows = n[1];
          },
          elements_kind(), "sub-elements across and down")
      .required(
          "allowed_difference", &AdaptiveSampling::allowed_difference,
          error_size_kind({{ErrorSize::Unit::radiance, &kRadiance}, {ErrorSize::Unit::fraction, &kPercent}}),
          "between a new sample and the average so far")
      .with_default("max_samples", &AdaptiveSampling::max_samples, integer(1, 1000000), "100", "per pixel")
      .optional("channel", &AdaptiveSampling::channel, name_of("a channel"),
                "that is compared; without it the channel that differs most");
  return record.kind();
}

Kind<AccuracySampling> accuracy_kind() {
  Record<AccuracySampling> record("accuracy sampling",
                                  "Rays go where they are needed until the error is as asked.");
  record
      .with_default(
          "error", &AccuracySampling::error,
          error_size_kind({{ErrorSize::Unit::kelvin, &kTemperatureDifference},
                           {ErrorSize::Unit::fraction, &kPercent},
                           {ErrorSize::Unit::radiance, &kRadiance},
                           {ErrorSize::Unit::reflectance, &kReflectance},
                           {ErrorSize::Unit::noise, &kNoise}}),
          "\"1 %\"",
          "allowed half-width of each pixel's interval: brightness temperature, share of the pixel's value, "
          "radiance, apparent reflectance, or share of the noise that channels declare; never finer than "
          "1e-5 of the value, the precision of the products; reflectance is not judged in channels where a white "
          "surface sends less than 1 % of what the air does")
      .with_default("confidence", &AccuracySampling::confidence, fraction({0.5, 1.0, false, true, {}}),
                    "0.95", "probability with which the interval holds the true value")
      .optional("channel", &AccuracySampling::channel, name_of("a channel"), "that is judged; without it all")
      .with_default("simultaneous", &AccuracySampling::simultaneous, boolean(), "false",
                    "confidence for all channels of a pixel at once")
      .optional("lattice", &AccuracySampling::lattice, integer(1, 64),
                "cells of the detection lattice along a side of a pixel; chosen if not given")
      .with_default("probes", &AccuracySampling::probes, integer(0, 10000), "9",
                    "probing rays in a flagged pixel and round")
      .with_default("seeds", &AccuracySampling::seeds, boolean(), "true",
                    "one ray for each known object smaller than a pixel")
      .with_default("thinnest", &AccuracySampling::thinnest_px, quantity(kPixels, Range::above(0.0, "px")),
                    "\"0.0125 px\"", "thinnest feature that is followed")
      .with_default("max_samples", &AccuracySampling::max_samples, long_integer(1, kMostSamples), "100000",
                    "per pixel")
      .with_default("floor", &AccuracySampling::floor, fraction(Range::between(0.0, 1.0)), "\"0.1 %\"",
                    "share of a white surface's radiance W: in percent no half-width need be below floor x "
                    "W; in K a pixel is "
                    "taken to be no colder than one of radiance floor x W")
      .with_default("clutter", &AccuracySampling::clutter, boolean(), "true",
                    "stratified samples instead of edges where there are too many edges");
  return record.kind();
}

}  // namespace

Kind<SamplingDocument> sampling_kind() {
  Record<SamplingDocument> record("sampling",
                                  "How many rays, and where; accuracy sampling if none is given.");
  record.at_most_one()
      .one("single", &SamplingDocument::method,
           Record<SingleSampling>("single sampling", "One ray through the centre of each pixel.").kind(),
           "one ray a pixel")
      .one("grid", &SamplingDocument::method, grid_kind(), "the same rays in every pixel")
      .one("adaptive", &SamplingDocument::method, adaptive_kind(), "more rays where samples differ")
      .one("accuracy", &SamplingDocument::method, accuracy_kind(), "as many rays as an accuracy needs")
      .with_default("tile", &SamplingDocument::tile_px, integer(1, 4096), "64",
                    "pixels along a side of the tiles that are computed at once")
      .with_default(
          "mirror_reflections", &SamplingDocument::mirror_reflections, integer(0, 8), "8",
          "flat mirrors, one after the other, by way of which sunlight is sought; where more may matter, "
          "pixels are marked. With 0 neither sunlight nor what shines is sought by way of any mirror, round ones "
          "included")
      .optional(
          "max_depth", &SamplingDocument::max_depth, integer(1, 10000),
          "surfaces a path may meet, for light that is cut short on purpose; without it no light is lost");
  return record.kind();
}

}  // namespace ifov::io
