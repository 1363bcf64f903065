#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/random.h"

namespace ifov::sampling {

/// The response of one pixel over the focal plane (PSF convolved with the detector's sensitive area), as a density
/// h(dx, dy) in 1/px^2 about the pixel's centre, with integral 1 and support |dx|, |dy| <= half_width_px.
class PixelFootprint {
 public:
  /// A uniform square of the given side (1: the whole pixel; less: a fill factor of side^2).
  static PixelFootprint box(double side_px);

  /// Values of h at the centres of n x n equal cells over the square of the given half width (n = cells_per_side),
  /// row by row, y downwards; normalised here. Negative values are an error.
  static PixelFootprint tabulated(double half_width_px, int cells_per_side, std::vector<double> values);

  /// A stretch of a density along y, straight from `from` to `to`; nothing below y0 or above y1.
  struct Piece {
    double y0 = 0.0, y1 = 0.0, from = 0.0, to = 0.0;
    double at(double y) const { return from + (to - from) * (y - y0) / (y1 - y0); }
  };

  /// Uniform over `side_px` along x times pieces along y, which follow each other upwards without overlap; normalised here.
  static PixelFootprint striped(double side_px, std::vector<Piece> pieces);

  double half_width_px() const { return half_width_; }
  /// Along x; along y the half width holds.
  double half_width_x_px() const { return pieces_.empty() ? half_width_ : half_width_x_; }
  bool uniform() const { return cells_ == 0 && pieces_.empty(); }
  /// Of striped(), the density along y; integrals over polygons are exact piece by piece. Else empty.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Side of a table's cells, px; 0 of others.
  double cell_px() const { return cells_ == 0 ? 0.0 : 2.0 * half_width_ / cells_; }
  /// Uniform over the whole pixel and nothing else.
  bool whole_pixel() const { return uniform() && half_width_px() == 0.5; }

  /// h(dx, dy), bilinear between cell centres; 0 outside.
  double density(double dx_px, double dy_px) const;

  /// Integral of h over the rectangle [x0, x1] x [y0, y1] (about the pixel's centre), of what density() says.
  double integral(double x0_px, double y0_px, double x1_px, double y1_px) const;

 private:
  PixelFootprint() = default;
  double striped_below(double y_px) const;  // integral along y up to there

  double half_width_ = 0.5, half_width_x_ = 0.5;
  int cells_ = 0;                // cells per side; 0 for a box
  std::vector<Piece> pieces_;    // along y, their integral 1; empty for others
  std::vector<double> density_;  // h at cell centres
  std::vector<double> summed_;   // summed-area table, (cells_ + 1)^2
};

/// A pixel's response in channels that have it alike.
struct FootprintGroup {
  PixelFootprint footprint;
  Point2 shift_px{};  ///< from the pixel's centre to the footprint's, x right, y down
};

/// Responses of pixels that differ from channel to channel. The first group is the reference: what is no channel's own (shares of
/// materials) holds for its footprint.
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
  /// The mean of all about the pixel's centre, as a table; points drawn from it are weighed by importance().
  const PixelFootprint& mixture() const { return tables_.back(); }
  /// A group's density over the mixture's, at this place from the pixel's centre: 0 to size(), 1 on average over the mixture.
  double importance(std::size_t group, double dx_px, double dy_px) const;

 private:
  std::vector<FootprintGroup> groups_;
  std::vector<int> of_channel_;
  double half_width_px_ = 0.0;
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
  Point2 shift_px(std::size_t group) const {
    return groups_ == nullptr ? Point2{} : (*groups_)[group].shift_px;
  }
  /// One for all columns, of the whole pixel and nothing else.
  bool whole_pixel() const { return groups_ == nullptr && one_->whole_pixel(); }
  double half_width_px() const {
    return groups_ == nullptr ? one_->half_width_px() : groups_->half_width_px();
  }
  /// Pixels that the widest reaches beyond its own, on each side.
  int reach() const;
  /// Whether a group's may weigh anything of the pixel that stands so many pixels away.
  bool reaches(std::size_t group, int dx, int dy) const;
  double density(std::size_t group, double dx_px, double dy_px) const {
    const Point2 s = shift_px(group);
    return footprint(group).density(dx_px - s.x, dy_px - s.y);
  }
  double integral(std::size_t group, double x0_px, double y0_px, double x1_px, double y1_px) const {
    const Point2 s = shift_px(group);
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
