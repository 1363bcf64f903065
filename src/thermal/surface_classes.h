#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "thermal/solid.h"
#include "thermal/surface_balance.h"
#include "thermal/surface_solution.h"

namespace ifov::thermal {

/// A surface that is solved for: what it is made of and what is about it. Of `stand` all but how it stands.
struct ClassSurface {
  Solid solid;
  Skin skin;
  Stand stand;
  Start start = Start::steady;
};

/// The temperature at the end of a series of surfaces of one material, however they stand, by how much of the sky is free
/// and when the Sun was. For directions over a grid, with the sky free and hidden, the whole nonlinear problem is solved
/// twice, always sunlit (T_1) and always shaded (T_0), and linearised about both; between them
///
///   T = T_0 + sum over t_k of w_k V(t_k),   w_k = r K(t_k) alpha E(t_k) cos theta_k,
///
/// with E the Sun's irradiance across its beam and cos theta_k to its place then, of the surface's own direction; K the
/// mean of the kernels K_0 and K_1 (linear_kernel.h), and r = (T_1 - T_0) / sum K alpha E cos theta, so that T is right where
/// the visibility V of the Sun is 0 or 1 throughout. A surface that is warm loses more of the next watt than a cold one: to
/// second order, with the share u = sum w V / sum w of its Sun that a point had and the bend b_k = (K_1 - K_0) / K,
///
///   T = T_0 + sum w_k V(t_k) (1 + (u - 1) b_k / 2).
///
/// T_0, the kernels and r are bilinear between directions, T_0 and r linear in the free share of the sky.
///
/// A direction is solved when first asked for; any number of threads may ask, and what they are told does not depend on it.
class SurfaceClasses {
 public:
  static constexpr double kTiltStep_rad = 0.2617993877991494;     // 15 degrees
  static constexpr double kAzimuthStep_rad = 0.5235987755982988;  // 30 degrees

  /// Throws InputError as solve_surface does.
  SurfaceClasses(std::shared_ptr<const OutdoorsSeries> series, ClassSurface surface, int threads);

  /// Of the times at which the Sun shone, in order.
  std::size_t sunlit_rows() const { return rows_.size(); }
  double step_s() const { return series_->step_s; }
  /// To where the Sun stood, by row and steps after it (-1 to 1), unit; below the horizon it may be, too.
  math::Vec3 sun_at(std::size_t row, double steps) const;

  /// T_0 at a free share of the sky, and by what a free sky changes it from a hidden one; kelvins.
  struct Shade {
    double kelvin = 0.0, of_sky_k = 0.0;
  };
  /// Of a surface with this outward normal (unit, ENU) and share of the sky above its horizon that is free; w_k by sunlit row,
  /// kelvins, none below 0.
  Shade shaded(math::Vec3 normal, double free_sky, std::span<double> weight_k) const;
  /// b_k of some sunlit rows.
  void bends(math::Vec3 normal, std::span<const std::size_t> rows, std::span<double> bend) const;
  /// The row of the series that a sunlit row is.
  std::size_t row_of_series(std::size_t sunlit_row) const { return rows_[sunlit_row].index; }

  /// Of all that can come out: of ten directions, with a margin for those between them.
  double coldest_k() const { return coldest_k_; }
  double hottest_k() const { return hottest_k_; }

 private:
  struct Row {
    std::size_t index = 0;
    math::Vec3 sun, before, after;
    double absorbed_w_m2 = 0.0;  ///< alpha E
  };
  /// A direction: with the sky hidden and free.
  struct Node {
    std::array<double, 2> shaded_k{}, rise_k{}, ratio{};
    std::vector<float> kernel, difference;  ///< by sunlit row: mean of both, K_1 - K_0
  };
  /// Those of a share above 0.
  struct Corners {
    struct Corner {
      const Node* node = nullptr;
      double share = 0.0;
    };
    std::array<Corner, 4> all;
    std::size_t count = 0;
    const Corner* begin() const { return all.data(); }
    const Corner* end() const { return all.data() + count; }
  };
  struct Place {
    std::once_flag once;
    std::atomic<bool> solved = false;
    Node node;
  };
  Corners corners(math::Vec3 normal) const;
  const Node& node_at(int ring, int azimuth) const;
  void solve(Node& node, double tilt_rad, double azimuth_rad) const;

  std::shared_ptr<const OutdoorsSeries> series_;
  ClassSurface surface_;
  std::vector<Row> rows_;
  mutable std::vector<Place> places_;  ///< facing up, facing down, and rings between
  double coldest_k_ = 0.0, hottest_k_ = 0.0;
};

}  // namespace ifov::thermal
