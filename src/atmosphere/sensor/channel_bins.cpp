#include "atmosphere/sensor/channel_bins.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "radiometry/gauss_legendre.h"

namespace ifov::atmosphere {
namespace {

int bin_of(double wavelength_um) { return static_cast<int>(std::lround(1e4 / wavelength_um / kBinStep_cm1)); }

}  // namespace

std::vector<ChannelBin> channel_bins(const radiometry::Channel& channel,
                                     const radiometry::Spectrum& solar_irradiance) {
  if (channel.is_monochromatic())
    return {{bin_of(channel.centre_um), channel.centre_um, 1.0, solar_irradiance.at(channel.centre_um)}};
  const double first = channel.response.first_um(), last = channel.response.last_um();
  std::vector<ChannelBin> bins;
  double total = 0.0;
  for (int bin = bin_of(first); bin >= bin_of(last); --bin) {
    const double from = std::max(first, 1e4 / ((bin + 0.5) * kBinStep_cm1));
    const double to = std::min(last, 1e4 / ((bin - 0.5) * kBinStep_cm1));
    if (!(to > from)) continue;
    ChannelBin part{bin, 0.0, 0.0, 0.0};
    // Responses and solar spectra have points inside wide bins.
    constexpr int kParts = 4;
    for (int p = 0; p < kParts; ++p)
      for (const radiometry::GaussPoint& gauss : radiometry::kGauss4) {
        const double x = from + (p + gauss.position) * (to - from) / kParts;
        const double weight = gauss.weight * (to - from) * channel.response.at(x);
        part.share += weight;
        part.wavelength_um += weight * x;
        part.irradiance += weight * solar_irradiance.at(x);
      }
    if (part.share <= 0.0) continue;
    part.wavelength_um = std::clamp(part.wavelength_um / part.share, from, to);
    part.irradiance /= part.share;
    total += part.share;
    bins.push_back(part);
  }
  for (ChannelBin& part : bins) part.share /= total;
  return bins;
}

bool narrower_than_resolved(const radiometry::Channel& channel) {
  return 1e4 / (channel.centre_um * channel.centre_um) * channel.fwhm_um < kResolution_cm1;
}

BinOptics::BinOptics(const AtmosphereColumn& column, std::span<const std::vector<ChannelBin>> channels,
                     int threads) {
  for (const std::vector<ChannelBin>& bins : channels)
    for (const ChannelBin& bin : bins) optics_.try_emplace(bin.bin);
  std::vector<std::pair<const int, ColumnOptics>*> all;
  for (auto& entry : optics_) all.push_back(&entry);
  parallel_for(static_cast<std::int64_t>(all.size()), threads, [&](std::int64_t k) {
    auto& [bin, optics] = *all[static_cast<std::size_t>(k)];
    optics = column.at(bin * kBinStep_cm1);
  });
}

}  // namespace ifov::atmosphere
