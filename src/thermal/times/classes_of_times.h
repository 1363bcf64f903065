#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "math/vec3.h"
#include "thermal/surface_classes.h"

namespace ifov::thermal {

struct DirectionOfTimes;
struct NodeOfTimes;

/// The classes of one material at several times, asked together: what the past of a point has in common at all of them. The past is told by absolute time, in spans between rows of the series;
/// spans make up bins, each of about the same part of what the past is worth to the times in the mean. Numbers of all times stand side by side, `lanes()` of them.
class ClassesOfTimes {
 public:
  /// Rows of all times fall on each other: `serves()`. One or more.
  explicit ClassesOfTimes(std::vector<std::shared_ptr<const SurfaceClasses>> by_time);
  ~ClassesOfTimes();
  /// Whether they do, and nothing came or went.
  static bool serves(std::span<const std::shared_ptr<const SurfaceClasses>> by_time);

  std::size_t times() const { return classes_.size(); }
  const SurfaceClasses& of_time(std::size_t time) const { return *classes_[time]; }
  std::size_t lanes() const { return lanes_; }  ///< times, and up to a whole number of registers
  std::size_t bins() const { return bins_.size(); }

  /// A time of the past within a bin: span, and where in it (0 to 1).
  struct Moment {
    std::uint32_t span = 0;
    float within = 0.0f;
  };
  /// The time up to which the share `u` of a bin's density lies: uniform within spans.
  Moment draw(std::size_t bin, double u) const;
  math::Vec3 towards_sun(const Moment& moment) const;  ///< unit

  /// What a point's classes are, at all times.
  class At {
   public:
    std::vector<float> shaded_k, of_sky_k;  ///< by lane: T_0, and what a free sky is worth of it
    std::vector<float> all_k;               ///< by lane: the sum of all w_k
    /// Before it all times are over when a bin begins: whatever is told of the bin is 0.
    std::size_t first_lane(std::size_t bin) const { return of_->bins_[bin].first_lane; }
    /// By bin and lane: the sum of w_k over it.
    void weights(std::span<float> kelvin) const;
    /// By lane: w_k at a moment over the density that it was drawn with, so that its mean is that of the bin's sum.
    void weigh(const Moment& moment, std::span<float> kelvin) const;
    /// q by bin and lane, per kelvin (SurfaceClasses::bends), of such weights.
    void bends(std::span<const float> weight_k, std::span<float> per_pair) const;

   private:
    friend class ClassesOfTimes;
    const ClassesOfTimes* of_ = nullptr;
    math::Vec3 normal_;
    struct Level {
      DirectionOfTimes* direction = nullptr;
      float share = 0.0f;
    };
    std::array<Level, 2> levels_;
    std::size_t count_ = 0;
    std::array<float, 3> by_sky_{};  ///< (1 - f)^2, f (1 - f), f^2 of the free share f of the sky
    /// To `to`, by lane, three rows by the sky, times `scale`.
    void add(const float* rows, float scale, std::size_t first_lane, float* to) const;
    void add_row(std::size_t row, double cosine, bool right, double by, std::size_t first_lane,
                 float* kelvin) const;
  };
  /// `at` keeps a reference to this, and is good until the next call of the thread.
  void at(const Pose& pose, double free_sky, At& at) const;

 private:
  struct Span {
    std::uint32_t left = 0, right = 0;  ///< rows
    std::uint32_t first_lane = 0;       ///< as of its bin
    double density = 0.0;               ///< share of its bin
    double until = 0.0;                 ///< shares of the bin up to it and with it
  };
  struct Bin {
    std::uint32_t first = 0, end = 0;  ///< spans
    std::uint32_t first_lane = 0;      ///< a whole number of registers
    std::vector<math::Vec3> suns;      ///< of their rows at which the Sun shone
  };
  struct Place;
  const NodeOfTimes& node_at(std::size_t place) const;
  void fill(NodeOfTimes& node, std::size_t place) const;
  void add_to_bin(NodeOfTimes& node, std::size_t place, std::size_t bin, std::size_t row, bool right) const;
  void make_bins();
  /// Of a normal at a level of wind; kept by each thread for those that it met last.
  DirectionOfTimes& direction(math::Vec3 normal, int level) const;
  void combine(DirectionOfTimes& direction, math::Vec3 normal) const;
  void combine_bends(DirectionOfTimes& direction) const;
  const float* combined_row(DirectionOfTimes& direction, std::size_t row, bool right) const;
  const float* row_of(const std::vector<float>& values, std::size_t row) const {
    return values.data() + row * lanes_;
  }

  std::vector<std::shared_ptr<const SurfaceClasses>> classes_;
  std::size_t lanes_;
  std::uint64_t id_;             ///< no two have the same
  std::vector<math::Vec3> sun_;  ///< by row, oldest first
  std::vector<bool> is_lit_;
  std::vector<std::vector<std::int32_t>>
      sunlit_;                         ///< by time and row: the sunlit row of its classes; -1: none
  std::vector<std::size_t> last_row_;  ///< by time
  std::vector<Span> spans_;
  std::vector<Bin> bins_;
  mutable std::vector<Place> places_;
};

}  // namespace ifov::thermal
