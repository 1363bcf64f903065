#pragma once

#include <limits>
#include <vector>

#include "io/quantities/quantity.h"
#include "sampling/tile.h"
#include "truth/collector.h"

namespace ifov::io {

/// What a collector left in a tile, as it is; of a gap of the image, whose tiles have no layers, not numbers, or 0 of whole ones.
template <const truth::Collector& kCollector, class Value>
void put_layer(const FinishedTile& of, ValueSink& sink) {
  using Limits = std::numeric_limits<Value>;
  const sampling::TileLayer* const layer = of.tile.layer(kCollector.name);
  if (layer != nullptr) return sink.put(layer->values<Value>());
  sink.put(std::vector<Value>(static_cast<std::size_t>(kCollector.bands) * of.tile.samples.size(),
                              Limits::has_quiet_NaN ? Limits::quiet_NaN() : Value{}));
}

}  // namespace ifov::io
