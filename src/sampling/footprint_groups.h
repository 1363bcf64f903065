#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/pixel_footprint.h"
#include "sampling/random.h"

namespace ifov::sampling {

/// A pixel's response in channels that have it alike.
struct FootprintGroup {
  PixelFootprint footprint;
  Point2 shift_px{};                   ///< from the pixel's centre to the footprint's, x right, y down
  std::vector<double> across_px = {};  ///< by column of the image, how much further right; empty: nowhere

  /// In a column of the image.
  Point2 shift_at(int column) const {
    return across_px.empty() ? shift_px
                             : Point2{shift_px.x + across_px[static_cast<std::size_t>(column)], shift_px.y};
  }
};

/// Responses of pixels that differ from channel to channel. The first group is the reference: what is no channel's own (shares of materials) holds for its footprint.
class FootprintGroups {
 public:
  /// `group_of_channel`: one number for each channel. Errors: std::invalid_argument where a channel has no group, or there is none.
  FootprintGroups(std::vector<FootprintGroup> groups, std::vector<int> group_of_channel);

  std::size_t size() const { return groups_.size(); }
  const FootprintGroup& operator[](std::size_t group) const { return groups_[group]; }
  /// Of a channel; below 0, of none: the reference.
  std::size_t group_of(int channel) const {
    return channel < 0 ? 0 : static_cast<std::size_t>(of_channel_[static_cast<std::size_t>(channel)]);
  }
  /// All vanish where |dx| or |dy| from the pixel's centre is larger.
  double half_width_px() const { return half_width_px_; }
  /// Whether any of them lies otherwise in one column of the image than in another.
  bool by_column() const { return by_column_; }
  /// The mean of all about the pixel's centre, in all columns, as a table; points drawn from it are weighed by importance().
  const PixelFootprint& mixture() const { return tables_.back(); }
  /// A group's density over the mixture's, at this place from the centre of a pixel in a column of the image: 1 on average over the mixture, as far as tables know it.
  double importance(std::size_t group, int column, double dx_px, double dy_px) const;

 private:
  std::vector<FootprintGroup> groups_;
  std::vector<int> of_channel_;
  double half_width_px_ = 0.0;
  bool by_column_ = false;
  std::vector<PixelFootprint>
      tables_;  // of the same cells: by group, about the pixel's centre, and their mean
};

/// Footprints by the columns of a field: one of all, or that of each column's group. Places are counted from the pixel's centre.
class ColumnFootprints {
 public:
  /// Keeps a reference.
  ColumnFootprints(const PixelFootprint& of_all) : one_(&of_all) {}  // NOLINT(google-explicit-constructor)
  /// Keeps references. `groups` may be null: `of_all` then. `channels`: by column, as of Field::channel_of().
  ColumnFootprints(const PixelFootprint& of_all, const FootprintGroups* groups,
                   std::span<const int> channels);

  std::size_t groups() const { return groups_ == nullptr ? 1 : groups_->size(); }
  std::size_t group_of(std::size_t column) const { return of_column_.empty() ? 0 : of_column_[column]; }
  const PixelFootprint& footprint(std::size_t group) const {
    return groups_ == nullptr ? *one_ : (*groups_)[group].footprint;
  }
  /// Of a pixel in a column of the image, as all that is asked for with one.
  Point2 shift_px(std::size_t group, int at) const {
    return groups_ == nullptr ? Point2{} : (*groups_)[group].shift_at(at);
  }
  bool by_column() const { return groups_ != nullptr && groups_->by_column(); }
  /// One for all columns, of the whole pixel and nothing else.
  bool whole_pixel() const { return groups_ == nullptr && one_->whole_pixel(); }
  double half_width_px() const {
    return groups_ == nullptr ? one_->half_width_px() : groups_->half_width_px();
  }
  /// Pixels that the widest reaches beyond its own, on each side.
  int reach() const;
  /// Whether a group's may weigh anything of the pixel that stands so many pixels away.
  bool reaches(std::size_t group, int at, int dx, int dy) const;
  double density(std::size_t group, int at, double dx_px, double dy_px) const {
    const Point2 s = shift_px(group, at);
    return footprint(group).density(dx_px - s.x, dy_px - s.y);
  }
  double integral(std::size_t group, int at, double x0_px, double y0_px, double x1_px, double y1_px) const {
    const Point2 s = shift_px(group, at);
    return footprint(group).integral(x0_px - s.x, y0_px - s.y, x1_px - s.x, y1_px - s.y);
  }
  /// Positions in a list of columns, by group.
  std::vector<std::vector<std::size_t>> positions(std::span<const int> columns) const;

 private:
  const PixelFootprint* one_;
  const FootprintGroups* groups_ = nullptr;
  std::vector<std::uint16_t> of_column_;
};

}  // namespace ifov::sampling
