#include "io/quantities/share_quantities.h"

#include <stdexcept>
#include <vector>

#include "render/tile_sink.h"

namespace ifov::io::quantities {
namespace {

template <float sampling::Abundance::*kMember>
void put_shares(const FinishedTile& of, ValueSink& sink) {
  const std::size_t materials = of.image.materials.size(), pixels = of.tile.samples.size();
  std::vector<float> values(pixels * materials, 0.0f);
  for (const sampling::Abundance& a : of.tile.abundances) {
    if (a.pixel >= pixels || a.material >= materials)
      throw std::logic_error("a tile's abundance names no pixel or no material");
    values[a.pixel * materials + a.material] = a.*kMember;
  }
  sink.put(values);
}

}  // namespace

constinit const Quantity kAbundance{.name = "abundance",
                                    .what = "material fractions",
                                    .unit = "1",
                                    .role = Quantity::Role::share,
                                    .statistic = Quantity::Statistic::mean,
                                    .type = EnviType::float32,
                                    .bands = Quantity::Bands::materials,
                                    .band_names = {},
                                    .usual = Quantity::Usual::yes,
                                    .needs = {.materials = true},
                                    .values = put_shares<&sampling::Abundance::fraction>};

constinit const Quantity kAbundanceHalfWidth{.name = "abundance_half_width",
                                             .what = "half-width of the material fractions' intervals",
                                             .unit = "1",
                                             .role = Quantity::Role::error,
                                             .statistic = Quantity::Statistic::half_width,
                                             .type = EnviType::float32,
                                             .bands = Quantity::Bands::materials,
                                             .band_names = {},
                                             .needs = {.materials = true},
                                             .values = put_shares<&sampling::Abundance::half_width>};

}  // namespace ifov::io::quantities
