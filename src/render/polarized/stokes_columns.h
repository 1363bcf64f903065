#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "transport/polarized/stokes_rows.h"

namespace ifov::sampling {
struct TileResult;
}
namespace ifov::radiometry {
struct StokesVector;
class SpectralNodes;
}  // namespace ifov::radiometry

namespace ifov::render {

struct LightTold;
class PartColumns;
struct Polarimetry;

/// The columns of a sample that are light: the channels' radiance, and behind them Q, U and V of all channels where a sensor tells
/// them, I before the channels' optics, and the parts of I where these are told. Samplers treat them all alike; when a tile is done what is not
/// radiance leaves its arrays for layers, so that whoever takes tiles finds channels as always. An object serves one thread.
class StokesColumns {
 public:
  /// Keeps references.
  StokesColumns(const LightTold& told, const radiometry::SpectralNodes& nodes);
  ~StokesColumns();

  std::size_t count() const;
  bool told() const;
  const PartColumns& parts() const { return *parts_; }
  /// As sampling::Field::leader().
  int leader(int column) const;
  /// As sampling::Field::channel_of().
  int channel_of(int column) const;

  /// Light in nodes, about the focal plane's axes, behind the channels' optics.
  void write(const transport::StokesRows& light, float* row);
  /// The parts of such light, all that are radiance, and the share that the air leaves of them, in nodes.
  void write_parts(std::span<const transport::StokesRows> parts, const float* transmittance, float* row);
  /// Of unpolarized light by channel; `row` and `channels` may be the same.
  void write_unpolarized(std::span<const float> channels, float* row);

  /// Moves Q, U and V, and parts, of a finished tile that has these columns alone to its layers (StokesLayers, PartLayers).
  void settle(sampling::TileResult& tile) const;

 private:
  radiometry::StokesVector seen(std::size_t channel, const radiometry::StokesVector& light) const;
  void pass(std::size_t channel, const radiometry::StokesVector& light, float* row) const;

  const Polarimetry& polarimetry_;
  const radiometry::SpectralNodes& nodes_;
  std::size_t channels_;
  std::unique_ptr<const PartColumns> parts_;
  std::vector<float> work_;
};

/// Layers of a tile with the Stokes vector beside I, floats, [pixel][component][channel]. Errors are there where the tile has any.
struct StokesLayers {
  static constexpr const char* kMean = "stokes";                  ///< Q, U, V
  static constexpr const char* kStandardError = "stokes_error";   ///< of I, Q, U, V
  static constexpr const char* kHalfWidth = "stokes_half_width";  ///< of Q, U, V
  static constexpr const char* kBefore = "before_optics";         ///< I before polarizers; [pixel][channel]
};

}  // namespace ifov::render
