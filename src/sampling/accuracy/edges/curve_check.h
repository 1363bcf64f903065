#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "sampling/accuracy/borders/chord.h"
#include "sampling/accuracy/borders/curve.h"
#include "sampling/field.h"

namespace ifov::sampling {

/// Area between curve and chord that a refused curve may hide, as a share of chord^2.
constexpr double kRefusedShare = 0.12;
/// Share of the allowed standard error below which a curve that fails verification is not worth more rays.
constexpr double kLooseCurve = 0.05;
/// A corner is looked for between these multiples of the predicted distance from the chord.
constexpr double kCornerNear = 0.4, kCornerFar = 1.5;
/// Its legs are looked at here, from their outer ends: nearer the apex than the middle, as the apex of a narrow tip is seldom quite on
/// the line on which it is sought.
constexpr double kAlongLeg = 2.0 / 3.0;

/// Where a border may have corners anywhere, an arc whose middle is farther from its chord than this share of it may be one, too:
/// rays between the two at a quarter of the way from each end, where an arc is at 3/4 of its height and a corner at 1/2, tell which
/// it is, once the height is known to this share of itself (an arc of 5/6 of the height is where the rays are).
constexpr double kSteep = 0.1, kBetweenArcAndCorner = 0.625, kKnownHeight = 1.0 / 3.0;

/// An arc that is as steep as that need not be part of a circle: outlines of round things that are seen aslant. What it encloses with its
/// chord is less than a circle through its ends and its middle does by so many times the square of what it is off at a quarter of the
/// way, as a share of the height (ellipses' quarters, to 0.6 of the one axis by the other).
constexpr double kOfSkew = 2.2;
/// Share of the allowed standard error that may come of that, and the share of the height that is let pass anyway.
constexpr double kLooseSkew = 0.02, kUsualSkew = 0.15;
/// That is about so much of what the curvatures towards its two ends differ by, as a share of their mean.
constexpr double kSkewOfCurvatures = 0.3;

/// One tentative curve on its way through verification. Its middle is looked for on a line through the
/// chord's middle; beyond the curve on that line the label is `far`, before it `near`. It is `guessed` where nothing predicts it.
struct CurveCheck {
  enum class Stage { middle, far_side, bisect, arc_or_corner, legs, done };
  std::uint32_t cell = 0;
  Stage stage = Stage::middle;
  CurveEnds ends;
  Point2 centre, normal;
  double chord = 0.0, least = 0.0, most = 0.0, tolerance = 0.0, predicted = 0.0;
  double low = 0.0, high = 0.0, blur = 0.0;
  std::uint32_t far = 0, near = 0;
  bool may_have_corners = false;  ///< the border
  bool corner_matters = false;    ///< it turns sharply enough from a neighbour for one that would
  double unevenness = INFINITY;   ///< what the curvatures towards both ends differ by, over their mean
  double most_skew = kUsualSkew;  ///< of an arc's height, at a quarter of the way from its ends
  bool smooth = false, guessed = false, beyond_wrong = false, has_apex = false, corner = false,
       confirmed = false, measured = false;
  Point2 apex;
  std::size_t first_point = 0;

  double middle() const { return 0.5 * (low + high); }
  bool may_be_corner() const { return may_have_corners && !corner && std::abs(middle()) > kSteep * chord; }
  bool knows_height() const { return high - low <= 1.000001 * kKnownHeight * std::abs(middle()); }
  /// How high a circle through the ends and the middle is at a quarter of the way.
  double quarter_height() const {
    const double height = std::abs(middle());
    if (height < 1e-6 * chord) return 0.75 * middle();
    const double radius = (0.25 * chord * chord + height * height) / (2.0 * height);
    return std::copysign(std::sqrt(radius * radius - chord * chord / 16.0) - (radius - height), middle());
  }
  /// How many of the rays between arc and corner saw the latter: one, where its apex is not over the chord's middle.
  int corners_seen(const std::uint32_t* seen) const {
    const std::uint32_t of_corner = middle() > 0.0 ? far : near;
    return (seen[0] == of_corner ? 1 : 0) + (seen[1] == of_corner ? 1 : 0);
  }
  /// Where neither did: an arc is not lower than where they were. False where a corner may be so high that they missed it.
  bool note_arc() {
    const double asked = kBetweenArcAndCorner * middle(), least_height = asked / 0.75;
    if (middle() > 0.0)
      low = std::max(low, least_height);
    else
      high = std::min(high, least_height);
    return 0.5 * std::max(high, -low) <= std::abs(asked);
  }

  /// From an arc to two legs that meet at the apex.
  void try_corner() {
    const Point2 to_apex = apex - centre;
    const double height = length(to_apex);
    if (dot(to_apex, normal) < 0.0) std::swap(far, near);
    normal = (1.0 / height) * to_apex;
    predicted = height;
    least = kCornerNear * height;
    most = kCornerFar * height;
    corner = true;
    has_apex = false;
    confirmed = measured = false;
    stage = Stage::middle;
  }

  /// What to look at next.
  void add_points(std::vector<FocalPoint>& points) const {
    const auto on_line = [&](double t) { add(points, centre + t * normal); };
    switch (stage) {
      case Stage::middle:
        on_line(predicted + tolerance);
        on_line(predicted - tolerance);
        break;
      case Stage::far_side: on_line(beyond_wrong ? high : low); break;
      case Stage::bisect: on_line(middle()); break;
      case Stage::arc_or_corner:
        for (const Point2 end : {ends.a, ends.b})
          add(points, 0.5 * (centre + end) + (kBetweenArcAndCorner * middle()) * normal);
        break;
      case Stage::legs: add_leg_points(points); break;
      case Stage::done: break;
    }
  }

 private:
  static void add(std::vector<FocalPoint>& points, Point2 p) { points.push_back({p.x, p.y}); }

  /// Next to the curve at a quarter of the way from each end, on either side: far, near, far, near.
  void add_leg_points(std::vector<FocalPoint>& points) const {
    for (const Point2 end : {ends.a, ends.b}) {
      Point2 foot, across;
      double margin = tolerance;
      if (corner) {
        const Point2 tip = centre + middle() * normal, leg = tip - end;
        const double reach = length(leg);
        foot = end + kAlongLeg * (tip - end);
        across = reach > 0.0 ? Point2{-leg.y / reach, leg.x / reach} : normal;
        if (dot(across, normal) < 0.0) across = -1.0 * across;
        margin = std::max(margin, blur);
      } else {
        foot = 0.5 * (centre + end) + (most_skew < kUsualSkew ? quarter_height() : 0.75 * middle()) * normal;
        across = normal;
        margin = std::max(margin, most_skew * std::abs(middle()));
      }
      add(points, foot + margin * across);
      add(points, foot - margin * across);
    }
  }
};

}  // namespace ifov::sampling
