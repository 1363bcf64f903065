#include "io/quantities/quantity_set.h"

#include <algorithm>

#include "io/quantities/quality_quantities.h"
#include "io/quantities/radiance_quantities.h"
#include "io/quantities/sunlight_quantities.h"
#include "render/tile_sink.h"
#include "sensor/view_list.h"
#include "truth/collector.h"

namespace ifov::io {
namespace {

/// Its line of the table.
std::ptrdiff_t order_of(const Quantity* quantity) {
  const auto all = all_quantities();
  return std::find(all.begin(), all.end(), quantity) - all.begin();
}

}  // namespace

const Quantity* find_quantity(std::string_view name) {
  const auto all = all_quantities();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Quantity* quantity) { return quantity->name == name; });
  return found == all.end() ? nullptr : *found;
}

QuantitySet QuantitySet::all() {
  QuantitySet set;
  for (const Quantity* quantity : all_quantities()) set.add(*quantity);
  return set;
}

bool QuantitySet::has(const Quantity& quantity) const {
  return std::find(chosen_.begin(), chosen_.end(), &quantity) != chosen_.end();
}

void QuantitySet::add(const Quantity& quantity) {
  if (has(quantity)) return;
  const auto index = std::find_if(chosen_.begin(), chosen_.end(), [&](const Quantity* other) {
    return order_of(other) > order_of(&quantity);
  });
  chosen_.insert(index, &quantity);
}

QuantitySet usual_quantities(bool map_tells, bool stokes) {
  QuantitySet set;
  for (const Quantity* quantity : all_quantities())
    if ((quantity->usual == Quantity::Usual::yes ||
         (quantity->usual == Quantity::Usual::where_no_map_tells && !map_tells)) &&
        (stokes || !quantity->needs.stokes))
      set.add(*quantity);
  return set;
}

QuantitySet possible_quantities(const QuantitySet& choice, const render::ImageInfo& image,
                                bool knows_errors) {
  const bool air = std::any_of(image.channels.begin(), image.channels.end(),
                               [](const render::ChannelInfo& channel) { return channel.air.has_value(); });
  const bool sunlight =
      std::any_of(image.channels.begin(), image.channels.end(),
                  [](const render::ChannelInfo& channel) { return channel.toa_irradiance > 0.0; });
  const bool points = image.views != nullptr && image.views->kind == sensor::ViewList::Kind::points;
  QuantitySet possible{&quantities::kRadiance};
  for (const Quantity* quantity : choice) {
    const Quantity::Needs& needs = quantity->needs;
    if ((!needs.errors || knows_errors) && (!needs.air || air) &&
        (!needs.materials || !image.materials.empty()) && (!needs.stokes || image.stokes) &&
        (!(needs.parts || needs.radiance || needs.emissivity) || !points) && (!needs.sunlight || sunlight) &&
        (!needs.mosaic || image.mosaic) && (!needs.solved || image.solved))
      possible.add(*quantity);
  }
  return possible;
}

void add_view_quantities(bool points, QuantitySet& choice) {
  for (const Quantity* quantity :
       {&quantities::kHalfWidth, &quantities::kStandardError, &quantities::kSamples, &quantities::kReasons})
    choice.add(*quantity);
  if (points) choice.add(quantities::kSkyView);
}

std::vector<const truth::Collector*> collectors_of(const QuantitySet& quantities) {
  std::vector<const truth::Collector*> collectors;
  for (const Quantity* quantity : quantities)
    if (quantity->collector != nullptr &&
        std::find(collectors.begin(), collectors.end(), quantity->collector) == collectors.end())
      collectors.push_back(quantity->collector);
  return collectors;
}

std::uint64_t CubeSize::bytes() const {
  return static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) *
         static_cast<std::uint64_t>(bands) * static_cast<std::uint64_t>(value_bytes);
}

CubeSize cube_size(const Quantity& quantity, const render::ImageInfo& image) {
  return {image.width_px, image.height_px, quantity.band_count(image),
          static_cast<int>(bytes_per_value(quantity.type))};
}

}  // namespace ifov::io
