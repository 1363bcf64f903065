#include "atmosphere/sensor/channel_bins.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/gas/gas_term_table.h"
#include "core/parallel.h"
#include "radiometry/gauss_legendre.h"

namespace ifov::atmosphere {
namespace {

int bin_of(double wavelength_um) { return static_cast<int>(std::lround(1e4 / wavelength_um / kBinStep_cm1)); }

/// Of a wavelength; by the bins' middles and edges, which wavenumbers fall along.
struct Interval {
  double middle_cm1, from_um, to_um;
};

/// From a short to a long wavelength.
std::vector<Interval> band_bins(double first_um, double last_um) {
  std::vector<Interval> bins;
  for (int bin = bin_of(first_um); bin >= bin_of(last_um); --bin)
    bins.push_back({bin * kBinStep_cm1, std::max(first_um, 1e4 / ((bin + 0.5) * kBinStep_cm1)),
                    std::min(last_um, 1e4 / ((bin - 0.5) * kBinStep_cm1))});
  return bins;
}

std::vector<Interval> term_bins(const GasTermTable& terms, double first_um, double last_um) {
  std::vector<Interval> bins;
  const auto edge_um = [&](std::size_t k) { return 1e4 / terms.edge_cm1(k); };
  const auto bin_before = [&](double wavelength_um) {
    const double at = (1e4 / wavelength_um - terms.first_cm1) / terms.step_cm1;
    return std::min(terms.bins.size() - 1, static_cast<std::size_t>(std::max(0.0, at)));
  };
  const std::size_t last = bin_before(last_um);
  for (std::size_t k = bin_before(first_um) + 1; k-- > last;)
    bins.push_back({terms.centre_cm1(k), std::max(first_um, edge_um(k + 1)), std::min(last_um, edge_um(k))});
  return bins;
}

std::vector<Interval> bins_between(double first_um, double last_um, const GasTermTable* terms) {
  if (terms == nullptr) return band_bins(first_um, last_um);
  const double low_um = 1e4 / terms->last_cm1(), high_um = 1e4 / terms->first_cm1;
  std::vector<Interval> bins;
  const auto add = [&](const std::vector<Interval>& more) {
    bins.insert(bins.end(), more.begin(), more.end());
  };
  if (first_um < low_um) add(band_bins(first_um, std::min(last_um, low_um)));
  if (std::max(first_um, low_um) < std::min(last_um, high_um))
    add(term_bins(*terms, std::max(first_um, low_um), std::min(last_um, high_um)));
  if (last_um > high_um) add(band_bins(std::max(first_um, high_um), last_um));
  return bins;
}

}  // namespace

std::vector<ChannelBin> channel_bins(const radiometry::Channel& channel,
                                     const radiometry::Spectrum& solar_irradiance,
                                     const GasTermTable* terms) {
  if (channel.is_monochromatic()) {
    const std::optional<std::size_t> own =
        terms != nullptr ? terms->bin_at(1e4 / channel.centre_um) : std::optional<std::size_t>();
    return {{own ? terms->centre_cm1(*own) : bin_of(channel.centre_um) * kBinStep_cm1, channel.centre_um, 1.0,
             solar_irradiance.at(channel.centre_um)}};
  }
  std::vector<ChannelBin> bins;
  double total = 0.0;
  for (const Interval& bin : bins_between(channel.response.first_um(), channel.response.last_um(), terms)) {
    const double from = bin.from_um, to = bin.to_um;
    if (!(to > from)) continue;
    ChannelBin part{bin.middle_cm1, 0.0, 0.0, 0.0};
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

Covered covered(const radiometry::Channel& channel, const GasTermTable* terms) {
  if (terms == nullptr) return Covered::nothing;
  const bool line = channel.is_monochromatic();
  const double low_cm1 = 1e4 / (line ? channel.centre_um : channel.response.last_um()),
               high_cm1 = 1e4 / (line ? channel.centre_um : channel.response.first_um());
  if (high_cm1 <= terms->first_cm1 || low_cm1 >= terms->last_cm1()) return Covered::nothing;
  return low_cm1 >= terms->first_cm1 && high_cm1 <= terms->last_cm1() ? Covered::all : Covered::part;
}

bool narrower_than_resolved(const radiometry::Channel& channel, const GasTermTable* terms) {
  const double resolved_cm1 = covered(channel, terms) == Covered::all ? terms->step_cm1 : kResolution_cm1;
  return 1e4 / (channel.centre_um * channel.centre_um) * channel.fwhm_um < resolved_cm1;
}

BinOptics::BinOptics(const AtmosphereColumn& column, std::span<const std::vector<ChannelBin>> channels,
                     int threads) {
  for (const std::vector<ChannelBin>& bins : channels)
    for (const ChannelBin& bin : bins) optics_.try_emplace(bin.wavenumber_cm1);
  std::vector<std::pair<const double, ColumnOptics>*> all;
  for (auto& entry : optics_) all.push_back(&entry);
  parallel_for(static_cast<std::int64_t>(all.size()), threads, [&](std::int64_t k) {
    auto& [wavenumber_cm1, optics] = *all[static_cast<std::size_t>(k)];
    optics = column.at(wavenumber_cm1);
  });
}

}  // namespace ifov::atmosphere
