#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "atmosphere/column/atmosphere_column.h"
#include "radiometry/channel.h"
#include "radiometry/spectrum.h"

namespace ifov::atmosphere {

/// The step of the band model's grid and the width to which it resolves lines, cm-1.
inline constexpr double kBinStep_cm1 = 5.0, kResolution_cm1 = 20.0;

/// Part of a channel that lies in one bin: of the band model (a multiple of kBinStep_cm1), or of a table of terms.
struct ChannelBin {
  double wavenumber_cm1 = 0.0;  ///< in the middle of the bin, which it stands for
  double wavelength_um = 0.0;   ///< mean over the response within the bin
  double share = 0.0;           ///< of the channel's response
  double irradiance = 0.0;      ///< of the Sun above the air, mean over the response, W m-2 um-1
};

/// The bins of a channel, from short to long wavelengths; within a table of terms, if there is one, its own.
std::vector<ChannelBin> channel_bins(const radiometry::Channel& channel,
                                     const radiometry::Spectrum& solar_irradiance,
                                     const GasTermTable* terms = nullptr);

/// How much of a channel lies within a table of terms.
enum class Covered { nothing, part, all };
Covered covered(const radiometry::Channel& channel, const GasTermTable* terms);

/// Whether the channel is narrower than the band model resolves, or within a table of terms than its bins.
bool narrower_than_resolved(const radiometry::Channel& channel, const GasTermTable* terms = nullptr);

/// Optical depths of the layers at all bins that some channels touch, computed once each.
class BinOptics {
 public:
  /// InputError where a channel leaves the range of the atmosphere's tables.
  BinOptics(const AtmosphereColumn& column, std::span<const std::vector<ChannelBin>> channels, int threads);
  const ColumnOptics& at(const ChannelBin& bin) const { return optics_.at(bin.wavenumber_cm1); }

 private:
  std::map<double, ColumnOptics> optics_;  // by the wavenumber of the bin
};

}  // namespace ifov::atmosphere
