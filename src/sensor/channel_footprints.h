#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sampling/random.h"

namespace ifov::sensor {

class Psf;
struct AlongTrack;

/// Channels whose footprints have less than this share of their energy in different places have one.
inline constexpr double kOneFootprint = 1e-3;

/// What the footprint of a channel follows from.
struct ChannelResponse {
  double wavelength_um = 0.0;          ///< that its PSF is of; 0: one is of all channels
  sampling::Point2 shift_px{};         ///< of its middle from the pixel's centre
  std::vector<double> across_px = {};  ///< by column of the image, how much further right; empty: nowhere
  friend bool operator==(const ChannelResponse& a, const ChannelResponse& b) {
    return a.wavelength_um == b.wavelength_um && a.lies_as(b);
  }
  /// Whether it is shifted alike in all columns.
  bool lies_as(const ChannelResponse& b) const {
    return shift_px.x == b.shift_px.x && shift_px.y == b.shift_px.y && across_px == b.across_px;
  }
};

/// Channels that have one footprint: that of the channel `like`.
struct ChannelGroup {
  std::vector<int> channels;  ///< rising
  int like = 0;
  std::shared_ptr<const Psf> psf;  ///< null: perfect optics
};

/// The PSF at a wavelength (0: of all); null: perfect optics.
using PsfAt = std::function<std::shared_ptr<const Psf>(double wavelength_um)>;

/// Share of the energy of two pixels' responses that they have in different places, half the integral of |h1 - h2|: of PSFs (null:
/// perfect optics) about their shifts, on squares of the side that `fill_factor` leaves. What PSFs are cut by is not looked at.
double energy_apart(const Psf* one, sampling::Point2 shift_px, const Psf* other,
                    sampling::Point2 other_shift_px, double fill_factor);

/// Channels by their footprints, no two of a group kOneFootprint apart or more; the first channel's group is the first. `ordered`: PSFs differ
/// the more, the further apart wavelengths are; else all of a group are compared with its first.
std::vector<ChannelGroup> group_channels(std::span<const ChannelResponse> channels, double fill_factor,
                                         const PsfAt& psf_at, bool ordered = true);

}  // namespace ifov::sensor
