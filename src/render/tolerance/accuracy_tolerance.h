#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/tolerance/accuracy_request.h"
#include "render/tolerance/atmosphere_half_width.h"
#include "render/tolerance/node_half_width.h"
#include "sampling/tolerance.h"

namespace ifov::sampling {
class BoundedError;
}

namespace ifov::render {

class ChannelBrightness;

/// Limits by channel for a pixel's radiance L. The white reference W is a level white Lambertian's radiance under the scene's Sun and sky plus a black body's of 288.15 K, so that it means
/// something in every channel. Percent: max(error * |L|, floor * W). Kelvin: error * dL/dT at the pixel's own brightness temperature, taken no colder than that of floor * W. Reflectance: error *
/// the white Lambertian's reflected radiance; channels in which that is less than a hundredth of the path's are not judged, because the air hides the surface (unless all are such). Noise: error *
/// the channel's noise. Polarization: limits of I, Q and U within which the degree of linear polarization is sure to err by no more than error (degree_limits()), of a pixel taken no darker than
/// floor * W; V is not judged. So dark channels and pixels finish. None is below 1e-5 of |L|, which single precision can bear.
class AccuracyTolerance final : public sampling::Tolerance {
 public:
  /// By channel: `white_reflected`, the radiance of a level white Lambertian lit by Sun and sky, and `path_radiance`, what the path to the sensor adds (empty: nothing). `pixel_count` counts for
  /// simultaneous confidence only.
  AccuracyTolerance(AccuracyRequest request, const ChannelBrightness& brightness,
                    std::vector<double> white_reflected_w_m2_sr_um, std::int64_t pixel_count,
                    const std::vector<double>& path_radiance_w_m2_sr_um = {},
                    std::vector<AtmosphereHalfWidth> air = {});

  /// What nodes may be wrong by, by channel, and the share of what is asked for that is kept for what a PSF's cut leaves out. Before the first tile.
  void leave_room(std::vector<NodeHalfWidth> nodes, double cut_share);

  /// Behind the channels stand Q, U and V of all of them (Polarimetry), which are judged by their channel's radiance: each has the limit of I. Before the first tile. `passed`: by channel, what
  /// polarizers leave of unpolarized light (empty: all); the brightness temperature is that of the light before them.
  void judge_stokes(bool stokes, std::vector<double> passed = {});
  bool with_stokes() const { return stokes_; }

  /// What is left for paths and edges: what makes what is asked for with what the air, the nodes and a cut may be wrong by (sampling::BoundedError), but never less than kLeastShare of it, because
  /// no number of rays makes up for those. Where the air alone is wrong by more than what is asked for, nor less than kShareOfAir of that: what rays add is then little beside it.
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    limits_beside({}, mean, limit);
  }
  bool by_material() const override;
  void limits_holding(const sampling::Abundance* held, std::size_t count, std::span<const double> mean,
                      std::span<double> limit) const override;
  /// The same beside bounds of a pixel's own, by column; empty: none.
  void limits_beside(std::span<const double> bounds, std::span<const double> mean, std::span<double> limit,
                     const sampling::Abundance* held = nullptr, std::size_t count = 0) const;
  void asked(std::span<const double> mean, std::span<double> limit) const;  ///< what is asked for
  static constexpr double kLeastShare = 0.5, kShareOfAir = 1.0 / 3.0;
  /// What the air may be wrong by over what is asked for, in a judged channel: up to most_bounded() it can be reached.
  double atmosphere_share(std::size_t channel, double radiance) const;
  double confidence() const override { return confidence_; }
  /// Of what is asked for, the largest part that bounds may take so that it can be reached.
  double most_bounded() const { return most_bounded_; }
  const sampling::BoundedError& joint() const { return *joint_; }

  bool judged(int channel) const { return judged_[static_cast<std::size_t>(channel)] != 0; }
  double floor_w_m2_sr_um(int channel) const { return floor_[static_cast<std::size_t>(channel)]; }

 private:
  std::size_t judged_columns(std::size_t columns) const;
  void ask_degree(std::size_t channel, std::span<const double> mean, std::span<double> limit) const;
  void leave_hidden_channels(const std::vector<double>& path_radiance);

  AccuracyRequest request_;
  const ChannelBrightness& brightness_;
  std::vector<double> white_;
  std::vector<AtmosphereHalfWidth> air_;  // by channel; empty: none
  std::vector<NodeHalfWidth> nodes_;      // likewise
  double cut_share_ = 0.0;
  bool stokes_ = false;
  std::vector<double> passed_;
  std::vector<double> floor_;
  std::vector<char> judged_;
  double confidence_ = 0.95;
  std::shared_ptr<const sampling::BoundedError> joint_;
  double most_bounded_ = 0.0;
};

/// At the confidence of a tolerance, or without one at the usual.
const sampling::BoundedError& joint_of(const AccuracyTolerance* tolerance);

}  // namespace ifov::render
