#include "sensor/spectrometer/column_responses.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"

namespace ifov::sensor {
namespace {

using radiometry::Channel;
using radiometry::Spectrum;

constexpr float kOne[] = {1.0f};

/// A response of area 1, cumulated: the share below a wavelength.
class Cumulated {
 public:
  explicit Cumulated(const Spectrum& response)
      : x_(response.wavelength_um().begin(), response.wavelength_um().end()),
        y_(response.values().begin(), response.values().end()),
        below_(x_.size(), 0.0) {
    for (std::size_t i = 1; i < x_.size(); ++i)
      below_[i] = below_[i - 1] + 0.5 * (y_[i - 1] + y_[i]) * (x_[i] - x_[i - 1]);
  }
  double first() const { return x_.front(); }
  double last() const { return x_.back(); }
  std::size_t points() const { return x_.size(); }
  double below(double at) const {
    if (!(at > x_.front())) return 0.0;
    if (!(at < x_.back())) return 1.0;
    const auto above = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), at) - x_.begin());
    const double width = x_[above] - x_[above - 1], t = (at - x_[above - 1]) / width;
    const double area = width * t * (y_[above - 1] + 0.5 * t * (y_[above] - y_[above - 1]));
    return (below_[above - 1] + area) / below_.back();
  }

 private:
  std::vector<double> x_, y_, below_;
};

/// The responses of a channel's columns as shares of cells of wavelength, of which some are chosen to stand for all.
class Choice {
 public:
  Choice(const Channel& channel, const ChannelColumns& columns) : of_(channel.response) {
    const std::size_t width = columns.centre_um.size();
    for (std::size_t i = 0; i < width; ++i)
      places_.push_back({columns.centre_um[i], columns.fwhm_um[i] / channel.fwhm_um});
    const double c = channel.centre_um;
    double first = INFINITY, last = -INFINITY;
    for (const Place& place : places_) {
      first = std::min(first, place.centre + place.stretch * (of_.first() - c));
      last = std::max(last, place.centre + place.stretch * (of_.last() - c));
    }
    constexpr std::size_t kFewest = 512, kMost = 4096;
    const std::size_t cells = std::clamp(3 * of_.points(), kFewest, kMost);
    for (const Place& place : places_) {
      const auto below = [&](std::size_t k) {
        const double um = first + (last - first) * static_cast<double>(k) / static_cast<double>(cells);
        return of_.below(c + (um - place.centre) / place.stretch);
      };
      std::vector<double>& shares = shares_.emplace_back();
      double before = below(0);
      for (std::size_t k = 1; k <= cells; ++k) {
        const double now = below(k);
        shares.push_back(now - before);
        before = now;
      }
    }
  }

  /// Chosen columns, until so much of each column is left out at most, or so many are chosen. Columns stand in an order along which
  /// responses change steadily.
  void choose(double left_out, std::size_t most) {
    // Those of smooth responses lie as Chebyshev's points do along the way from the first to the last, where weights stay small.
    constexpr std::size_t kMostSpread = 12;
    for (std::size_t count = 1; count <= std::min({kMostSpread, most, shares_.size()}); ++count) {
      take_spread(count);
      if (most_left() <= left_out) return;
    }
    forget();
    take(0);
    while (chosen_.size() < std::min(most, shares_.size())) {
      std::size_t worst = 0;
      double worst_left = 0.0;
      for (std::size_t i = 0; i < shares_.size(); ++i)
        if (const double left = left_of(i); left > worst_left) worst_left = left, worst = i;
      if (worst_left <= left_out) break;
      if (!take(worst)) break;
    }
  }

  double most_left() const {
    double most = 0.0;
    for (std::size_t i = 0; i < shares_.size(); ++i) most = std::max(most, left_of(i));
    return most;
  }

  /// The first so many as they stand.
  void take_first(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) take(k);
  }

  const std::vector<std::size_t>& chosen() const { return chosen_; }

  /// By the chosen ones, in their order.
  std::vector<double> weights(std::size_t column) const {
    std::vector<double> along(basis_.size());
    split(column, along);
    // Of a triangular system: chosen column k is that of the basis's vectors up to k.
    std::vector<double> weights(basis_.size() + 1, 0.0);
    for (std::size_t k = basis_.size(); k-- > 0;) {
      double rest = along[k];
      for (std::size_t later = k + 1; later < basis_.size(); ++later)
        rest -= weights[later + 1] * triangle_[later][k];
      weights[k + 1] = rest / triangle_[k][k];
    }
    weights[0] = 1.0 - std::accumulate(weights.begin() + 1, weights.end(), 0.0);
    return weights;
  }

  double left_of(std::size_t column) const {
    std::vector<double> along(basis_.size());
    double sum = 0.0;
    for (const double rest : split(column, along)) sum += std::abs(rest);
    return 0.5 * sum;
  }

 private:
  struct Place {
    double centre, stretch;
  };

  void forget() { chosen_.clear(), basis_.clear(), triangle_.clear(); }

  /// Columns at the extremes of Chebyshev's polynomial along the way that responses change.
  void take_spread(std::size_t count) {
    forget();
    if (way_.empty()) {
      way_.push_back(0.0);
      for (std::size_t i = 1; i < shares_.size(); ++i) {
        double step = 0.0;
        for (std::size_t q = 0; q < shares_[i].size(); ++q)
          step += std::abs(shares_[i][q] - shares_[i - 1][q]);
        way_.push_back(way_.back() + step);
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = count > 1
                               ? std::numbers::pi * static_cast<double>(k) / static_cast<double>(count - 1)
                               : 0.5 * std::numbers::pi;
      const double at = 0.5 * way_.back() * (1.0 - std::cos(angle));
      const auto above = std::lower_bound(way_.begin(), way_.end(), at);
      auto nearest = static_cast<std::size_t>(above - way_.begin());
      if (nearest == way_.size() || (nearest > 0 && at - way_[nearest - 1] < way_[nearest] - at)) --nearest;
      if (std::find(chosen_.begin(), chosen_.end(), nearest) == chosen_.end()) take(nearest);
    }
  }

  /// A column's difference to the first chosen one, along the basis; what stands across it comes back.
  std::vector<double> split(std::size_t column, std::vector<double>& along) const {
    std::vector<double> rest = shares_[column];
    const std::vector<double>& origin = shares_[chosen_.front()];
    for (std::size_t q = 0; q < rest.size(); ++q) rest[q] -= origin[q];
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      along[k] = std::inner_product(rest.begin(), rest.end(), basis_[k].begin(), 0.0);
      for (std::size_t q = 0; q < rest.size(); ++q) rest[q] -= along[k] * basis_[k][q];
    }
    return rest;
  }

  bool take(std::size_t column) {
    if (chosen_.empty()) {
      chosen_.push_back(column);
      return true;
    }
    std::vector<double> along(basis_.size());
    std::vector<double> rest = split(column, along);
    const double length = std::sqrt(std::inner_product(rest.begin(), rest.end(), rest.begin(), 0.0));
    if (!(length > 0.0)) return false;
    for (double& value : rest) value /= length;
    along.push_back(length);
    basis_.push_back(std::move(rest));
    triangle_.push_back(std::move(along));
    chosen_.push_back(column);
    return true;
  }

  Cumulated of_;
  std::vector<Place> places_;
  std::vector<std::vector<double>> shares_;  // by column
  std::vector<double> way_;                  // from the first column's response to each
  std::vector<std::size_t> chosen_;
  std::vector<std::vector<double>> basis_, triangle_;  // orthonormal; chosen ones along it
};

/// Columns of a few different responses.
struct Distinct {
  ChannelColumns columns;
  std::vector<std::size_t> of_column;
};

Distinct distinct_responses(const ChannelColumns& columns) {
  const std::size_t width = columns.centre_um.size();
  std::vector<std::size_t> order(width);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return std::pair(columns.centre_um[i], columns.fwhm_um[i]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  Distinct found{{}, std::vector<std::size_t>(width)};
  for (const std::size_t i : order) {
    ChannelColumns& to = found.columns;
    if (to.centre_um.empty() || to.centre_um.back() != columns.centre_um[i] ||
        to.fwhm_um.back() != columns.fwhm_um[i]) {
      to.centre_um.push_back(columns.centre_um[i]);
      to.fwhm_um.push_back(columns.fwhm_um[i]);
    }
    found.of_column[i] = to.centre_um.size() - 1;
  }
  return found;
}

ColumnResponses::Channel found(const Channel& channel, const ChannelColumns& columns) {
  ColumnResponses::Channel result;
  result.columns = columns;
  if (columns.centre_um.empty()) {
    result.carried.push_back(channel);
    return result;
  }
  const Distinct distinct = distinct_responses(columns);
  const std::size_t count = distinct.columns.centre_um.size();
  // Of many, some are looked at to choose from, and all of them afterwards.
  constexpr std::size_t kLookedAt = 129;
  ChannelColumns looked_at = distinct.columns;
  if (count > kLookedAt) {
    looked_at = {};
    for (std::size_t k = 0; k < kLookedAt; ++k) {
      const std::size_t at = k * (count - 1) / (kLookedAt - 1);
      looked_at.centre_um.push_back(distinct.columns.centre_um[at]);
      looked_at.fwhm_um.push_back(distinct.columns.fwhm_um[at]);
    }
  }
  Choice choice(channel, looked_at);
  choice.choose(ColumnResponses::kLeftOut, ColumnResponses::kMostCarried);
  ChannelColumns chosen;
  for (const std::size_t at : choice.chosen()) {
    chosen.centre_um.push_back(looked_at.centre_um[at]);
    chosen.fwhm_um.push_back(looked_at.fwhm_um[at]);
    const auto has = [&](std::size_t i) {
      return columns.centre_um[i] == chosen.centre_um.back() && columns.fwhm_um[i] == chosen.fwhm_um.back();
    };
    std::size_t column = 0;
    while (!has(column)) ++column;
    result.carried.push_back(moved(channel, chosen.centre_um.back(), chosen.fwhm_um.back()));
    if (choice.chosen().size() > 1)
      result.carried.back().name = format("{} in column {}", channel.name, column + 1);
  }
  const std::size_t carried = result.carried.size();
  std::vector<std::vector<double>> weights;
  if (count <= kLookedAt) {
    for (std::size_t k = 0; k < count; ++k) {
      weights.push_back(choice.weights(k));
      result.left_out = std::max(result.left_out, choice.left_of(k));
    }
  } else {
    // In pieces, so that few responses are in memory at a time.
    for (std::size_t from = 0; from < count; from += kLookedAt) {
      ChannelColumns piece = chosen;
      const std::size_t end = std::min(count, from + kLookedAt);
      for (std::size_t k = from; k < end; ++k) {
        piece.centre_um.push_back(distinct.columns.centre_um[k]);
        piece.fwhm_um.push_back(distinct.columns.fwhm_um[k]);
      }
      Choice again(channel, piece);
      again.take_first(carried);
      for (std::size_t k = from; k < end; ++k) {
        weights.push_back(again.weights(carried + k - from));
        result.left_out = std::max(result.left_out, again.left_of(carried + k - from));
      }
    }
  }
  if (carried > 1)
    for (std::size_t i = 0; i < columns.centre_um.size(); ++i)
      for (const double weight : weights[distinct.of_column[i]])
        result.weights.push_back(static_cast<float>(weight));
  return result;
}

}  // namespace

Channel moved(const Channel& channel, double centre_um, double fwhm_um) {
  if (centre_um == channel.centre_um && fwhm_um == channel.fwhm_um) return channel;
  const double stretch = fwhm_um / channel.fwhm_um;
  std::vector<double> wavelength;
  for (const double um : channel.response.wavelength_um())
    wavelength.push_back(centre_um + stretch * (um - channel.centre_um));
  if (!(wavelength.front() > 0.0))
    throw InputError(format("channel '{}': a response of {:g} um about {:g} um is not possible", channel.name,
                            fwhm_um, centre_um));
  const auto values = channel.response.values();
  return {channel.name,
          Spectrum(std::move(wavelength), {values.begin(), values.end()}, channel.response.outside(),
                   channel.name),
          centre_um, fwhm_um};
}

ColumnResponses ColumnResponses::find(std::span<const radiometry::Channel> channels,
                                      std::span<const ChannelColumns> columns) {
  std::vector<Channel> found_of(channels.size());
  std::vector<std::exception_ptr> failed(channels.size());  // what is told does not depend on threads
  parallel_for(static_cast<std::int64_t>(channels.size()), 0, [&](std::int64_t k) {
    const auto c = static_cast<std::size_t>(k);
    try {
      found_of[c] = found(channels[c], columns[c]);
    } catch (...) {
      failed[c] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  return ColumnResponses(std::move(found_of));
}

ColumnResponses::ColumnResponses(std::vector<Channel> channels) : channels_(std::move(channels)) {
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    first_.push_back(channel_of_.size());
    scales_.emplace_back(channels_[c].carried.begin(), channels_[c].carried.end());
    channel_of_.resize(channel_of_.size() + channels_[c].carried.size(), c);
    const std::size_t count = channels_[c].carried.size(), width = channels_[c].weights.size() / count;
    for (std::size_t i = 0; i < width; ++i)
      most_spread_ = std::max(most_spread_, spread(c, static_cast<int>(i)));
  }
  first_.push_back(channel_of_.size());
}

std::span<const float> ColumnResponses::weights(std::size_t channel, int column) const {
  const Channel& of = channels_[channel];
  if (of.weights.empty()) return kOne;
  return std::span(of.weights)
      .subspan(static_cast<std::size_t>(column) * of.carried.size(), of.carried.size());
}

double ColumnResponses::spread(std::size_t channel, int column) const {
  double sum = 0.0;
  for (const float weight : weights(channel, column)) sum += std::abs(static_cast<double>(weight));
  return sum;
}

std::vector<radiometry::Channel> ColumnResponses::all_carried() const {
  std::vector<radiometry::Channel> all;
  for (const Channel& channel : channels_)
    all.insert(all.end(), channel.carried.begin(), channel.carried.end());
  return all;
}

}  // namespace ifov::sensor
