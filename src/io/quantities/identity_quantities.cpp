#include "io/quantities/identity_quantities.h"

#include <algorithm>
#include <limits>
#include <string>

#include "io/quantities/classes.h"
#include "io/quantities/layer_values.h"
#include "render/image_info.h"
#include "truth/identity.h"

namespace ifov::io::quantities {
namespace {

void put_objects(const FinishedTile& of, ValueSink& sink) {
  std::vector<std::uint16_t> classes(of.tile.samples.size());
  const std::vector<std::uint32_t>& first = of.image.first_of_objects;
  if (const sampling::TileLayer* const layer = of.tile.layer(truth::kInstance.name)) {
    const std::span<const std::uint32_t> instances = layer->values<std::uint32_t>();
    // Those are counted from 1, and so as many begin below one as its class says.
    std::transform(instances.begin(), instances.end(), classes.begin(), [&](std::uint32_t instance) {
      return static_cast<std::uint16_t>(std::lower_bound(first.begin(), first.end(), instance) -
                                        first.begin());
    });
  }
  sink.put(classes);
}

void put_dominant(const FinishedTile& of, ValueSink& sink) {
  std::vector<std::uint16_t> classes(of.tile.samples.size());
  std::vector<float> most(classes.size(), 0.0f);
  for (const sampling::Abundance& share : of.tile.abundances) {
    if (!(share.fraction > most[share.pixel])) continue;
    most[share.pixel] = share.fraction;
    classes[share.pixel] = static_cast<std::uint16_t>(share.material + 1);
  }
  sink.put(classes);
}

void put_counts(const FinishedTile& of, ValueSink& sink) {
  std::vector<std::uint16_t> counts(of.tile.samples.size());
  for (const sampling::Abundance& share : of.tile.abundances)
    if (share.fraction > 0.0f) ++counts[share.pixel];
  sink.put(counts);
}

void add_named_classes(std::vector<std::string> names, EnviHeader& header) {
  names.insert(names.begin(), "nothing");
  add_classes(names, distinct_colours(names.size()), header);
}

void add_materials(EnviHeader& header, const render::ImageInfo& image) {
  add_named_classes(image.materials, header);
}

void add_objects(EnviHeader& header, const render::ImageInfo& image) {
  add_named_classes(image.objects, header);
}

constexpr std::string_view kMaterialBands[] = {"material class"}, kObjectBands[] = {"object class"},
                           kInstanceBands[] = {"instance"}, kDominantBands[] = {"dominant material"},
                           kCountBands[] = {"materials"};

}  // namespace

constinit const Quantity kMaterialClass{.name = "material_class",
                                        .what = "material that the middle of each pixel sees",
                                        .unit = "1",
                                        .role = Quantity::Role::truth,
                                        .statistic = Quantity::Statistic::middle,
                                        .type = EnviType::uint16,
                                        .bands = Quantity::Bands::named,
                                        .band_names = kMaterialBands,
                                        .needs = {.materials = true},
                                        .collector = &truth::kMaterial,
                                        .values = put_layer<truth::kMaterial, std::uint16_t>,
                                        .complete_header = add_materials};

constinit const Quantity kObjectClass{.name = "object_class",
                                      .what = "object that the middle of each pixel sees",
                                      .unit = "1",
                                      .role = Quantity::Role::truth,
                                      .statistic = Quantity::Statistic::middle,
                                      .type = EnviType::uint16,
                                      .bands = Quantity::Bands::named,
                                      .band_names = kObjectBands,
                                      .collector = &truth::kInstance,
                                      .values = put_objects,
                                      .complete_header = add_objects};

constinit const Quantity kInstance{.name = "instance",
                                   .what = "number of the placed object that the middle of each pixel sees",
                                   .unit = "1",
                                   .role = Quantity::Role::truth,
                                   .statistic = Quantity::Statistic::middle,
                                   .type = EnviType::uint32,
                                   .bands = Quantity::Bands::named,
                                   .band_names = kInstanceBands,
                                   .collector = &truth::kInstance,
                                   .values = put_layer<truth::kInstance, std::uint32_t>};

constinit const Quantity kDominantMaterial{.name = "dominant_material",
                                           .what = "material with the largest share of each pixel",
                                           .unit = "1",
                                           .role = Quantity::Role::truth,
                                           .statistic = Quantity::Statistic::pixel,
                                           .type = EnviType::uint16,
                                           .bands = Quantity::Bands::named,
                                           .band_names = kDominantBands,
                                           .needs = {.materials = true},
                                           .values = put_dominant,
                                           .complete_header = add_materials};

constinit const Quantity kMaterialCount{.name = "material_count",
                                        .what = "how many materials have a share of each pixel",
                                        .unit = "count",
                                        .role = Quantity::Role::truth,
                                        .statistic = Quantity::Statistic::pixel,
                                        .type = EnviType::uint16,
                                        .bands = Quantity::Bands::named,
                                        .band_names = kCountBands,
                                        .needs = {.materials = true},
                                        .values = put_counts};

}  // namespace ifov::io::quantities
