#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/moving/moving_cover.h"

namespace ifov::render {

/// What a point of the focal plane looks at while it is exposed, where the camera moves meanwhile: another ray at every instant. A point
/// that shows one label at instants so close that the picture moves by a fraction of a pixel from one to the next has that label; any
/// other shows several things, one after the other, as what is covered by something that moves does. Labels steer alone: values have times
/// of their own, stratified over all of the exposure.
class FlownExposure {
 public:
  /// Null where the camera stands still while a point is exposed.
  static std::unique_ptr<FlownExposure> find(const scene::Scene& scene, const sensor::Camera& camera);

  /// At which labels are asked, after the middle of the exposure: the first is its beginning, the last its end.
  const std::vector<double>& instants_s() const { return instants_s_; }

  /// The longest way in the picture, while it is exposed, of what the middles of its parts look at.
  double way_px() const { return way_px_; }

  /// Where something small is at an instant: what lies between instants passes unseen by labels.
  struct Dot {
    sampling::FocalPoint at;
    double radius_px = 0.0;
    std::size_t instant = 0;  ///< its number
    std::optional<sampling::FocalPoint> next =
        std::nullopt;  ///< at the next one, where it is known there too
  };
  /// Those near all points that will be asked for.
  void follow(std::vector<Dot> dots);

  /// As MovingCover's, about the middle of the exposure.
  MovingCover::Times times(const sampling::PathRequest& request);
  /// Whether something that moves by itself, or something small, may lie on the rays of a point, between instants too.
  bool crossed(const sampling::FocalPoint& point);

 private:
  FlownExposure(const scene::Scene& scene, const sensor::Camera& camera);
  double longest_way_px() const;
  void when_met(const sampling::FocalPoint& point);
  void when_crossed(const sampling::FocalPoint& point);
  /// Calls at(dot, where it is nearest to the point, how near) for those that may be near.
  template <class At>
  void visit_dots(const sampling::FocalPoint& point, const At& at) const;

  const scene::Scene& scene_;
  const sensor::Camera& camera_;
  double exposure_s_, way_px_, apart_px_;  // the last from one instant to the next, at most
  std::vector<double> instants_s_;
  std::vector<geometry::TimeInterval> crossed_;  // of the point that was asked last
  std::vector<Dot> dots_;
  // Of squares a pixel wide: the dots that reach into each.
  int first_x_ = 0, first_y_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> near_;
};

}  // namespace ifov::render
