#include "io/quantities/quality_quantities.h"

#include <algorithm>
#include <vector>

#include "io/quantities/quality_classes.h"
#include "render/tile_sink.h"

namespace ifov::io::quantities {
namespace {

void put_samples(const FinishedTile& of, ValueSink& sink) {
  const sampling::TileResult& tile = of.tile;
  std::vector<std::uint32_t> counts;
  counts.reserve(3 * tile.samples.size());
  for (std::size_t p = 0; p < tile.samples.size(); ++p)
    counts.insert(counts.end(), {tile.samples[p], tile.label_rays[p], tile.radiance_evaluations[p]});
  sink.put(counts);
}

void put_quality(const FinishedTile& of, ValueSink& sink) {
  const sampling::TileResult& tile = of.tile;
  std::vector<float> quality;
  quality.reserve(4 * tile.samples.size());
  for (std::size_t p = 0; p < tile.samples.size(); ++p)
    quality.insert(quality.end(), {tile.converged(p) ? 1.0f : 0.0f, tile.worst_ratio[p],
                                   tile.missable_fraction[p], tile.share_of_borders(p)});
  sink.put(quality);
}

void put_reasons(const FinishedTile& of, ValueSink& sink) { sink.put(of.tile.reasons); }

void put_classes(const FinishedTile& of, ValueSink& sink) {
  std::vector<std::uint8_t> classes(of.tile.reasons.size());
  std::transform(of.tile.reasons.begin(), of.tile.reasons.end(), classes.begin(), class_of);
  sink.put(classes);
}

constexpr std::string_view kSampleBands[] = {"samples", "label rays", "radiance evaluations"},
                           kQualityBands[] = {"converged", "largest half-width over its limit",
                                              "missable fraction", "borders' share of the variance"},
                           kReasonBands[] = {"reasons"}, kClassBands[] = {"quality class"};

}  // namespace

constinit const Quantity kSamples{.name = "samples",
                                  .what = "samples per pixel",
                                  .unit = "count",
                                  .role = Quantity::Role::count,
                                  .statistic = Quantity::Statistic::pixel,
                                  .type = EnviType::uint32,
                                  .bands = Quantity::Bands::named,
                                  .band_names = kSampleBands,
                                  .usual = Quantity::Usual::yes,
                                  .values = put_samples};

constinit const Quantity kQuality{.name = "quality",
                                  .what = "quality",
                                  .unit = "1",
                                  .role = Quantity::Role::judgement,
                                  .statistic = Quantity::Statistic::pixel,
                                  .type = EnviType::float32,
                                  .bands = Quantity::Bands::named,
                                  .band_names = kQualityBands,
                                  .usual = Quantity::Usual::yes,
                                  .values = put_quality};

constinit const Quantity kReasons{.name = "reasons",
                                  .what = "why pixels are not converged, a bit for each reason",
                                  .unit = "1",
                                  .role = Quantity::Role::judgement,
                                  .statistic = Quantity::Statistic::pixel,
                                  .type = EnviType::uint16,
                                  .bands = Quantity::Bands::named,
                                  .band_names = kReasonBands,
                                  .usual = Quantity::Usual::yes,
                                  .values = put_reasons,
                                  .complete_header = add_bit_names};

constinit const Quantity kQualityClass{.name = "quality_class",
                                       .what = "converged, or the gravest reason why not",
                                       .unit = "1",
                                       .role = Quantity::Role::judgement,
                                       .statistic = Quantity::Statistic::pixel,
                                       .type = EnviType::byte,
                                       .bands = Quantity::Bands::named,
                                       .band_names = kClassBands,
                                       .usual = Quantity::Usual::yes,
                                       .values = put_classes,
                                       .complete_header = add_quality_classes};

}  // namespace ifov::io::quantities
