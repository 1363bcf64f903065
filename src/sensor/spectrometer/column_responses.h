#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiometry/channel.h"
#include "sensor/detector/brightness_scale.h"

namespace ifov::sensor {

/// Where a channel's response lies and how wide it is, by column of the image; both empty: as the channel's own in all.
struct ChannelColumns {
  std::vector<double> centre_um, fwhm_um;
};

/// A response in another place and of another width: moved as a whole, and stretched about its centre.
radiometry::Channel moved(const radiometry::Channel& channel, double centre_um, double fwhm_um);

/// Channels whose responses differ from column to column (smile), each as sums of a few responses: those are what paths carry
/// ("carried", numbered through all channels), and a pixel's radiance in a channel is the sum by the weights of its column
/// (docs/theory/sensor.md). Immutable.
class ColumnResponses {
 public:
  struct Channel {
    ChannelColumns columns;
    std::vector<radiometry::Channel> carried;  ///< one where the response is alike in all columns
    std::vector<float> weights;  ///< [column][carried], of a column adding up to 1; empty: 1 of the one
    /// The most that a column's response and the sum have in different places, half the integral of their difference.
    double left_out = 0.0;
  };

  /// Responses to be carried, so few that kLeftOut of each column's is left out, or kMostCarried of a channel. `columns`: by
  /// channel. Errors: InputError where a response cannot be.
  static ColumnResponses find(std::span<const radiometry::Channel> channels,
                              std::span<const ChannelColumns> columns);
  /// As find() has once found them.
  explicit ColumnResponses(std::vector<Channel> channels);

  static constexpr double kLeftOut = 1e-4;
  static constexpr std::size_t kMostCarried = 48;

  std::size_t channels() const { return channels_.size(); }
  std::size_t carried() const { return channel_of_.size(); }
  const Channel& operator[](std::size_t channel) const { return channels_[channel]; }
  /// The first that is carried of a channel; of channels() behind the last.
  std::size_t first(std::size_t channel) const { return first_[channel]; }
  std::size_t channel_of(std::size_t carried) const { return channel_of_[carried]; }
  /// Of those that are carried of a channel, in a column.
  std::span<const float> weights(std::size_t channel, int column) const;
  /// Sum of a column's weights without their signs; the largest of all.
  double spread(std::size_t channel, int column) const;
  double most_spread() const { return most_spread_; }
  /// Kelvins by what is carried of a channel.
  const std::vector<BrightnessScale>& scales(std::size_t channel) const { return scales_[channel]; }
  /// All that are carried; those of channels that have several are named after a column that has this response.
  std::vector<radiometry::Channel> all_carried() const;

 private:
  std::vector<Channel> channels_;
  std::vector<std::size_t> first_, channel_of_;
  std::vector<std::vector<BrightnessScale>> scales_;  // by channel
  double most_spread_ = 1.0;
};

}  // namespace ifov::sensor
