#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "thermal/solid.h"
#include "thermal/surface_balance.h"
#include "thermal/surface_solution.h"
#include "thermal/wind_levels.h"

namespace ifov::thermal {

/// A surface that is solved for: what it is made of and what is about it. Of `stand` all but how and how high it stands.
struct ClassSurface {
  Solid solid;
  Skin skin;
  Stand stand;
  Start start = Start::steady;
  bool operator==(const ClassSurface&) const = default;
};

/// How a surface stands: its outward normal (unit, ENU), and how high above ground, for the wind.
struct Pose {
  Pose(math::Vec3 outward, double above_ground_m = 0.0) : normal(outward), height_m(above_ground_m) {}
  math::Vec3 normal;
  double height_m;
};

/// The temperature at the end of a series of surfaces of one material, however they stand, by how much of the sky is free and when the Sun was. For directions over a grid, with the sky free and
/// hidden, the whole nonlinear problem is solved always sunlit (T_1), always shaded (T_0), and at the shares of the Sun 1/2 -+ 1/sqrt(12), each with its kernel (linear_kernel.h), K_1, K_0, K_-
/// and K_+; between them
///
///   T = T_0 + sum over t_k of w_k V(t_k),   w_k = r K(t_k) alpha E(t_k) cos theta_k,   K = (K_- + K_+) / 2 + c (K_1 - K_0),
///
/// with E the Sun's irradiance across its beam and cos theta_k to its place then, of the surface's own direction. The mean of K_- and K_+ is that from shade to Sun to third order; about the shade
/// itself the kernel may have a cusp, where the surface is as warm as the air. c is so that T is right where the visibility V of the Sun is 1 throughout: between the two histories the kernel does
/// not change evenly, and what it changes by is little for the last minutes and much for yesterday. c stays within 1/2; what that leaves r takes, T_1 - T_0 over the sum. A surface that is warm
/// loses more of the next watt than a cold one. Two gains of the past weaken each other by what the later of them has lost since, so that to second order, over all pairs of times,
///
///   T = T_0 + sum w_k V(t_k) - sum over j, k of q / 2 w_j w_k V(t_j) (1 - V(t_k)),   b_k = (1 + 2 c) (K_1 - K_0) / K,
///
/// with q of the later time. That the kernel is K_1 where V is 1 throughout, and K_0 where it is 0, tells q: with p the sum of the w after a time and W that of all, b = q (W - p) + the integral
/// of q over p, hence dq/dp = (db/dp) / (W - p).
///
/// T_0, the kernels and r are bilinear between directions and linear in the free share of the sky. All are linear between levels of wind (WindLevels), of which there is one unless surfaces stand
/// higher than kLowestWind_m.
///
/// Where that share f was otherwise at times than it is now, with what a free sky is worth g (SurfaceBalance::of_free_sky_w_m2) and its share F of the view of a surface in the open, the
/// temperature changes by the sum over all rows of
///
///   s_k (f(t_k) - f),   s_k = (K_0 + u / 2 (K_1 - K_0)) F g(t_k):
///
/// what hides the sky mostly hides the Sun, so that half of u is what came after. Where the sky was freer than now the Sun was there, too, and all of u counts.
///
/// A direction at a level is solved when first asked for; any number of threads may ask, and what they are told does not depend on it.
class SurfaceClasses {
 public:
  static constexpr double kTiltStep_rad = 0.2617993877991494;     // 15 degrees
  static constexpr double kAzimuthStep_rad = 0.5235987755982988;  // 30 degrees

  /// `past_sky`: whether the s_k will be asked for, which takes the kernel of all rows. `highest_m`: no surface is asked for that stands higher above ground. Throws InputError as solve_surface
  /// does. `neighbours`: whether histories and what the past is worth are kept, by which surfaces warm each other (surface_past.cpp).
  SurfaceClasses(std::shared_ptr<const OutdoorsSeries> series, ClassSurface surface, int threads,
                 bool past_sky = false, double highest_m = 0.0, bool neighbours = false);

  /// Of the times at which the Sun shone, in order.
  std::size_t sunlit_rows() const { return rows_.size(); }
  double step_s() const { return series_->step_s; }
  std::size_t rows() const { return series_->rows.size(); }
  double end_s() const { return series_->begin_s + step_s() * static_cast<double>(rows() - 1); }
  /// Seconds from the end of the series, 0 or below, of a row of it and some steps after it (-1 to 1).
  double time_s(std::size_t row, double steps) const;
  /// To where the Sun stood, by row and steps after it (-1 to 1), unit; below the horizon it may be, too.
  math::Vec3 sun_at(std::size_t row, double steps) const;

  /// T_0 at a free share of the sky, and by what a free sky changes it from a hidden one; kelvins.
  struct Shade {
    double kelvin = 0.0, of_sky_k = 0.0;
  };
  /// Of a surface with this share of the sky above its horizon that is free; w_k by sunlit row, kelvins, none below 0.
  Shade shaded(const Pose& pose, double free_sky, std::span<double> weight_k) const;
  /// q by sunlit row, per kelvin; `sum_k`: of the w_k that shaded() gave, up to each and with it.
  void bends(const Pose& pose, std::span<const double> sum_k, std::span<double> per_pair) const;
  /// s_k by row of the series without the Sun (u = 0), and by what it changes with u / 2; only with `past_sky`.
  void past_sky(const Pose& pose, std::span<double> weight_k, std::span<double> bend_k) const;
  /// The row of the series that a sunlit row is.
  std::size_t row_of_series(std::size_t sunlit_row) const { return rows_[sunlit_row].index; }

 private:
  struct Node;

 public:
  struct Corner {
    const Node* node = nullptr;
    double share = 0.0;
    std::size_t place = 0;  ///< of the node
  };
  /// Of directions and levels between which a pose lies, those of a share above 0: what is asked of a pose more than once is asked of these.
  struct Corners {
    std::array<Corner, 8> all;
    std::size_t count = 0;
    const Corner* begin() const { return all.data(); }
    const Corner* end() const { return all.data() + count; }
  };
  Corners corners(const Pose& pose) const;
  /// One of them, as often as it has a share, for all of it: what is linear in them is right in the mean. `by_chance`: 0 to 1.
  Corners any_corner(const Pose& pose, double by_chance) const;
  /// Of the sunlit rows from first_row() on alone: those before are worth nothing.
  std::size_t first_row(const Corners& at) const;
  Shade shaded(const Corners& at, math::Vec3 normal, double free_sky, std::span<double> weight_k) const;
  void bends(const Corners& at, std::span<const double> sum_k, std::span<double> per_pair) const;
  /// What a free sky is worth (Shade::of_sky_k), how far apart the places of the Sun are that count (0: all in one; about 1: all over a day), and what it is worth where it is always seen: about,
  /// to know how many rays to send.
  struct AtStake {
    double of_sky_k = 0.0, sun_spread = 0.0, rise_k = 0.0;
  };
  AtStake at_stake(const Corners& at) const;

  // What surfaces send to each other; only with `neighbours`. The past is told in bins, the last row first, a sixth of what lies behind
  // them long and half an hour at most.
  std::size_t bins() const { return past_.begin.empty() ? 0 : past_.begin.size() - 1; }
  /// Rows of the series of a bin: `first` and older ones.
  struct BinRows {
    std::size_t first = 0, count = 0;
  };
  BinRows rows_of_bin(std::size_t bin) const;
  std::size_t bin_of_row(std::size_t row) const { return past_.of_lag[rows() - 1 - row]; }
  const Outdoors& outdoors(std::size_t row) const { return series_->rows[row]; }
  /// The sunlit row that one of the series is; -1: the Sun did not shine.
  std::int32_t sunlit_row_of(std::size_t row) const { return past_.sunlit[row]; }
  /// A row of the past, drawn by what a gain there is worth, and kelvins now per W m-2 of gain there over the chance of it: in shade, and by what always Sun adds to that.
  struct PastRow {
    std::size_t row = 0;
    double in_shade_k = 0.0, of_sun_k = 0.0;
  };
  /// Three numbers from 0 to 1. Rows of much light are drawn more often.
  PastRow draw_past(const Corners& at, std::array<double, 3> by_chance) const;
  /// The same at several times, of the classes of one material, with one row for all: drawn as one of the times has it, by the chance that all of them give it. `row`: of that time's series, whose
  /// number is returned.
  static std::size_t draw_past(std::span<const SurfaceClasses* const> by_time, const Pose& pose,
                               std::array<double, 4> by_chance, std::span<PastRow> found);
  /// Rows before another, drawn by what a gain there is worth to it: as the same time before the series' end is to that.
  std::size_t draw_lag(const Corners& at, double which, double how_long) const;
  /// By bin, kelvins now per W m-2 of gain throughout it: in shade, and by what always Sun adds.
  void worth(const Pose& pose, std::span<double> in_shade_k, std::span<double> of_sun_k) const;
  /// The surface's temperature in the middle of a bin, always shaded, and by how much the Sun warms it.
  struct Then {
    double shaded_k = 0.0, rise_k = 0.0;
  };
  Then then(const Corners& at, double free_sky, std::size_t bin) const;
  /// The same throughout the past, a mean of sunlit and shaded.
  double worth_of_all_k(const Corners& at) const;
  /// Of what a gain throughout the past adds to a surface its square is lost, times this: a warmer surface emits, gives to still air and evaporates more than in proportion, so that the next watt
  /// is worth less. Per kelvin.
  double bend_of_gain(const Corners& at) const;
  /// The cosine by which the Sun's beam meets a surface, that of the face it meets; 0 where that is not one of the surface's.
  double facing(math::Vec3 normal, math::Vec3 sun) const {
    const double cosine = math::dot(normal, sun);
    return two_faces() ? std::abs(cosine) : std::max(0.0, cosine);
  }
  /// What a surface in the open sees of the sky, both of a sheet's faces together.
  double open_share(math::Vec3 normal) const { return two_faces() ? 1.0 : 0.5 * (1.0 + normal.z); }
  bool two_faces() const { return surface_.skin.two_faces; }
  double ground_reflectance() const { return surface_.stand.ground_reflectance; }
  /// What such a surface gains at the end of the series at some temperature: with the Sun's share that it sees then, the free share of its sky, and what comes from all that is not sky.
  Fluxes last_fluxes(const Pose& pose, double visibility, double free_sky, const FromBeside& beside,
                     double surface_k) const;
  FromBeside from_ground(std::size_t row) const { return of_level_ground(outdoors(row), surface_.stand); }
  const Skin& skin() const { return surface_.skin; }
  /// What the surface gains more by what comes from some of its view, W m-2 of that, than by the ground it is taken for.
  double more_than_ground_w_m2(const FromBeside& comes, std::size_t row) const;

  /// Of all that can come out: of ten directions, with a margin for those between them.
  double coldest_k() const { return coldest_k_; }
  double hottest_k() const { return hottest_k_; }
  /// Of a level surface half in the Sun, under half of its sky.
  double middle_k() const { return middle_k_; }

 private:
  struct Row {
    std::size_t index = 0;
    math::Vec3 sun, before, after;
    double absorbed_w_m2 = 0.0;  ///< alpha E
  };
  /// A direction: with the sky hidden and free.
  struct Node {
    std::array<double, 2> shaded_k{}, rise_k{}, ratio{}, shift{};
    double sun_spread = 0.0;                               ///< about its mean direction, weighed by w
    std::size_t first = 0;                                 ///< sunlit row; kernels are 0 before it
    std::array<std::vector<float>, 2> kernel, difference;  ///< by sunlit row: K, not below 0; K_1 - K_0
    /// By row of the series, of both skies: mean of K_0 and K_1, and K_1 - K_0; empty without `past_sky`.
    std::vector<float> past_kernel, past_difference;
    /// By bin of the past. Sums of the kernels over the bin, K_0 and K_1 - K_0, and shares of sums of them up to it: by what they are worth under the light of the time, and alone.
    std::vector<std::array<float, 4>>
        then_k;  ///< shaded, and the rise in the Sun, each with the sky hidden and free
    std::vector<float> worth, worth_of_sun, drawn, lagged;
    double bend = 0.0;  ///< of a gain throughout the past, per kelvin that it warms by
  };
  /// Of the kernels of both histories under both skies, and the kelvins that each comes to.
  struct Worths {
    std::array<double, 4> kelvin{}, worth_k{};
  };
  double bend_of(const Worths& worths) const;
  void keep_past(Node& node, std::size_t sky, const SurfaceSolution& shaded, const SurfaceSolution& sunlit,
                 std::span<const double> at_shade, std::span<const double> at_sun) const;
  void make_bins();
  const Corner& corner_by(const Corners& corners, double by_chance) const;
  struct Place {
    std::once_flag once;
    std::atomic<bool> solved = false;
    Node node;
  };
  /// Where among the grid's directions a normal lies: past a ring and an azimuth by shares of a step.
  struct Turn {
    int ring = 0, azimuth = 0;
    double up = 0.0, east = 0.0;
  };
  static Turn turn_of(math::Vec3 normal);
  /// Where among the levels: above one, by a share of the way to the next.
  struct AboveLevel {
    int level = 0;
    double stronger = 0.0;
  };
  AboveLevel level_of(double height_m) const;
  /// The corners of a turn at a level, which has `share` of all; nodes are still to be asked for. Behind the last the share is 0.
  static std::array<Corner, 4> corners_at(const Turn& turn, int level, double share);
  static std::size_t place_of(int level, int ring, int azimuth);
  const Node& node_at(std::size_t place) const;
  void solve(Node& node, double height_m, double tilt_rad, double azimuth_rad) const;

  friend class ClassesOfTimes;  // the same of several times

  std::shared_ptr<const OutdoorsSeries> series_;
  ClassSurface surface_;
  WindLevels levels_;
  int top_level_;
  std::vector<double> of_free_sky_w_m2_;  ///< g by row of the series; empty without `past_sky`
  std::vector<Row> rows_;
  struct PastBins {
    std::vector<std::size_t> begin;  ///< rows before the last; one more than there are bins
    std::vector<std::uint16_t> of_lag;
    std::vector<std::int32_t> sunlit;
    std::vector<double> light;  ///< by bin, by which they are drawn more often
  };
  PastBins past_;
  mutable std::vector<Place> places_;  ///< level by level: facing up, facing down, and rings between
  double coldest_k_ = 0.0, hottest_k_ = 0.0, middle_k_ = 0.0;
};

}  // namespace ifov::thermal
