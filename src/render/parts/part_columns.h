#pragma once

#include <cstddef>
#include <vector>

#include "transport/parts/light_part.h"

namespace ifov::radiometry {
class SpectralNodes;
}

namespace ifov::sampling {
struct TileResult;
}

namespace ifov::render {

/// The columns of a sample that hold the parts of its light (transport::LightPart), [part][channel], behind those of the light
/// itself (StokesColumns). Nothing is decided by them: each follows its channel (sampling::Field::leader()), and when a tile is done they
/// leave its arrays for layers. An object serves one thread.
class PartColumns {
 public:
  /// Keeps a reference to the nodes. `first`: how many columns stand before them; `told` false: there are none.
  PartColumns(bool told, std::size_t first, const radiometry::SpectralNodes& nodes);

  bool told() const { return told_; }
  std::size_t first() const { return first_; }
  std::size_t count() const { return told_ ? transport::kLightParts * channels_ : 0; }

  /// From spectra in nodes into the row of a sample.
  void write(const transport::PartRows& light, float* row) const;
  /// Of these the transmittance alone.
  void write_transmittance(const float* share, float* row) const;
  /// Of a sample whose light in its first columns, the channels', is all of one part; transmittance 0, because such light is beside
  /// that of the path.
  void write_one(transport::LightPart part, float* row) const;

  /// Layers of a finished tile, before its arrays are cut to channels.
  void add_layers(sampling::TileResult& tile) const;

 private:
  bool told_;
  std::size_t first_, channels_;
  const radiometry::SpectralNodes& nodes_;
  std::vector<float> of_one_;  // what channels make of 1 in all nodes, by channel
};

/// Layers of a tile with the parts of its radiance, floats, [pixel][part][channel]. Errors are there where the tile has any.
struct PartLayers {
  static constexpr const char* kMean = "parts";
  static constexpr const char* kStandardError = "parts_error";
};

/// Such layers without values in them yet, in a tile that has channels alone.
void add_empty_part_layers(std::size_t channels, sampling::TileResult& tile);

}  // namespace ifov::render
