#include "sampling/accuracy/edges/curve_predictor.h"

#include <algorithm>
#include <cmath>

#include "sampling/accuracy/basis/dither.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/borders/contrast.h"
#include "sampling/accuracy/borders/traced_pixels.h"
#include "sampling/accuracy/edges/curve_check.h"
#include "sampling/accuracy/edges/narrow_features.h"
#include "sampling/hash.h"

namespace ifov::sampling {

namespace {

/// Width of the error of a middle that was predicted but not verified, as a share of the chord. Where the
/// tolerance can bear it, no ray is spent.
constexpr double kUnverifiedWidth = 0.25;
/// The same where not both are far enough to tell a direction, and borders may have corners: a tip as high as the chord.
constexpr double kVagueWidth = 1.0;
/// The same where both neighbours predict it: this and so many times the sagitta that they predict.
constexpr double kAgreedWidth = 0.06, kBendWidth = 2.0;
/// A curve in a narrow feature, or one whose neighbours are too near to tell its direction, may stay
/// unverified where a corner in it would cost less than this share of the allowed standard error,
constexpr double kTrustedAnyway = 0.16;
/// and the feature is so wide, in spacings of the lattice, that vertices show where it goes on, or matters
/// little.
constexpr double kSeenWidth = 0.5;
/// Only borders that go on, and gently so, may stay unverified: sagitta over chord, by either neighbour.
constexpr double kGentleBend = 0.1;
/// Likewise the cosine of the turn from a neighbour's chord, where borders may have corners.
constexpr double kGentleTurn = 0.93;
/// What the phase of a guessed middle is keyed by, beside its cell.
constexpr std::uint64_t kMiddleDither = 0x6d6964646c65ull;

/// A corner that the neighbours do not speak against: its height over the chord, and that of the leg over the chord's middle.
struct PossibleCorner {
  double height = 0.0, at_middle = 0.0;

  /// `foot`: of the apex, from the chord's nearer or farther end.
  static PossibleCorner over(double chord, double height, double foot) {
    const double longer = std::max({foot, chord - foot, 0.5 * chord});
    return {height, height * 0.5 * chord / longer};
  }
  /// The border goes on straight from one end, at an angle of this cosine to the chord, and turns by a right angle towards the
  /// other end; by more, to a tip as high as the chord, where it sets out away from that.
  static PossibleCorner right_angled(double chord, double cosine) {
    if (cosine <= 0.0) return over(chord, chord, 0.5 * chord);
    const double square = std::min(1.0, cosine * cosine);
    return over(chord, chord * std::sqrt(square * (1.0 - square)), chord * square);
  }
};

/// Curvature of a border from that found towards its two ends: their mean where they tell of one smooth
/// curve, the smaller one where a corner on one side makes them differ, none where they bend opposite ways.
double limited_mean(const double curvature[2], const double weight[2]) {
  if (weight[0] == 0.0) return curvature[1];
  if (weight[1] == 0.0) return curvature[0];
  if (curvature[0] * curvature[1] <= 0.0) return 0.0;
  const double small = std::min(std::abs(curvature[0]), std::abs(curvature[1]));
  const double large = std::max(std::abs(curvature[0]), std::abs(curvature[1]));
  if (large > 2.0 * small) return std::copysign(small, curvature[0]);
  return (weight[0] * curvature[0] + weight[1] * curvature[1]) / (weight[0] + weight[1]);
}

}  // namespace

CurvePredictor::Verdict CurvePredictor::predict(CurveCheck& check) const {
  const Cell& cell = model_.tree()[check.cell];
  const Curve& curve = model_.curve_of(cell);
  const Lattice& lattice = model_.tree().lattice();
  check.ends = model_.drawn_ends(curve);
  const Point2 a = check.ends.a, b = check.ends.b, d = b - a;
  check.chord = length(d);
  check.centre = 0.5 * (a + b);
  if (check.chord < 1e-9) {
    const double width =
        std::max(model_.brackets()[curve.bracket[0]].width(), model_.brackets()[curve.bracket[1]].width());
    check.low = -0.5 * width;
    check.high = 0.5 * width;
    return Verdict::accept;
  }
  check.normal = {-d.y / check.chord, d.x / check.chord};
  const double x0 = lattice.x_px(cell.x), y0 = lattice.y_px(cell.y), side = lattice.side_px(cell.level);
  // By all corners: the chord may pass through one of them, or just beyond.
  Point2 towards_inner;
  const double inner = curve.side[1] - curve.side[0];
  for (int corner = 0; corner < 4; ++corner) {
    const bool is_inner = corner > curve.side[0] && corner <= curve.side[1];
    const Point2 at{static_cast<double>(kCornerX[corner]), static_cast<double>(kCornerY[corner])};
    towards_inner = towards_inner + (is_inner ? 1.0 / inner : -1.0 / (4.0 - inner)) * at;
  }
  const bool inner_far = dot(towards_inner, check.normal) > 0.0;
  check.far = inner_far ? curve.inner : curve.outer;
  check.near = inner_far ? curve.outer : curve.inner;

  double curvature[2] = {0.0, 0.0}, weights[2] = {0.0, 0.0};
  const CurveEnds middles = model_.ends(curve);
  const double span = length(middles.b - middles.a);
  Point2 beyond[2];
  int neighbours = 0;
  PossibleCorner corner;
  bool continued = false;
  double turn_cosine = 1.0;  // of the sharper turn from a neighbour's chord to this one
  for (int end = 0; end < 2; ++end) {
    if (!model_.neighbour_end(curve.bracket[end], curve.cell, beyond[end])) continue;
    continued = true;
    const double reach = length(beyond[end] - (end == 0 ? middles.a : middles.b));
    if (span < 1e-9 || reach <= 3.0 * model_.brackets()[curve.bracket[end]].width()) continue;
    curvature[end] = end == 0 ? menger_curvature(beyond[0], middles.a, middles.b, reach, span)
                              : menger_curvature(middles.a, middles.b, beyond[1], span, reach);
    weights[end] = std::min(reach, check.chord);
    const Point2 here = end == 0 ? a : b, along = here - beyond[end];
    const double cosine = (end == 0 ? 1.0 : -1.0) * dot(along, d) / (length(along) * check.chord);
    turn_cosine = std::min(turn_cosine, cosine);
    corner = PossibleCorner::right_angled(check.chord, cosine);
    ++neighbours;
  }
  const double blur = model_.blur(curve);
  check.blur = blur;
  check.tolerance =
      std::clamp(curve.wanted_middle > 0.0 ? curve.wanted_middle : blur, 1e-7, check.chord / 6.0);
  check.predicted = sagitta_of_curvature(limited_mean(curvature, weights), check.chord);
  check.most = kLargestSagitta * check.chord;
  check.least = -check.most;

  const double contrast = contrast_(cell.pixel, curve.inner, curve.outer);
  const double allowed = pixels_.allowed_deviation(cell.pixel);
  // The neighbours' chords, extended into this cell, meet at the apex of a corner.
  bool inside = false;
  if (curve.corner) {
    check.apex = curve.origin + (0.5 * (curve.low + curve.high)) * curve.normal;
    check.has_apex = true;
    corner = {};
  } else if (neighbours == 2) {
    const Point2 u = a - beyond[0], v = b - beyond[1];
    const double turn = cross(u, v);
    corner = {};
    if (std::abs(turn) > 1e-3 * length(u) * length(v)) {
      const double s = cross(d, v) / turn, t = cross(d, u) / turn;
      check.apex = a + s * u;
      if (s > 0.0 && t > 0.0)
        corner = PossibleCorner::over(check.chord, std::abs(dot(check.apex - check.centre, check.normal)),
                                      dot(check.apex - a, d) / check.chord);
      inside = s > 0.0 && t > 0.0 && check.apex.x >= x0 && check.apex.x <= x0 + side && check.apex.y >= y0 &&
               check.apex.y <= y0 + side;
    }
  }
  // A corner encloses with the chord what an arc of 3/4 of its height does. Where that matters it is asked which of the two there
  // is, by rays between them; else what is claimed reaches from one to the other.
  const double cut_off = std::max(0.0, 0.75 * corner.height - std::abs(check.predicted));
  const bool corner_matters = 2.0 / 3.0 * check.chord * cut_off * contrast > kLooseCurve * allowed;
  if (corner_matters)
    check.tolerance = std::min(check.tolerance,
                               std::max(0.5 * (corner.at_middle - std::abs(check.predicted)), 0.75 * blur));
  check.has_apex = check.has_apex ||
                   (inside && std::abs(dot(check.apex - check.centre, check.normal)) > 2.0 * check.tolerance);
  const double hidden = kRefusedShare * check.chord * check.chord * contrast;
  const double bend = std::max(std::abs(curvature[0]), std::abs(curvature[1])) * check.chord / 8.0;
  const double unverified_width =
      std::max(check.chord * (neighbours == 2 ? std::min(kUnverifiedWidth, kAgreedWidth + kBendWidth * bend)
                              : check.may_have_corners ? kVagueWidth
                                                       : kUnverifiedWidth),
               2.0 * cut_off);
  const auto trusted = [&] {
    const double feature = features_.width_at(cell), spacing = lattice.side_px(0);
    const bool cannot_hide = feature > kSeenWidth * spacing || feature * spacing * contrast < allowed;
    return (feature == INFINITY && neighbours > 0) ||
           (continued && cannot_hide && hidden < kTrustedAnyway * allowed);
  };
  // A circle through a long chord and a short one beside it is flat, however sharp the turn: as much of that may be a corner here.
  const bool turns = check.may_have_corners && turn_cosine < kGentleTurn;
  check.corner_matters = corner_matters && turns;
  if (unverified_width <= curve.wanted_middle && bend < kGentleBend && !turns && !corner_matters &&
      trusted()) {
    check.predicted = std::clamp(check.predicted, check.least, check.most);
    check.low = check.predicted - 0.5 * unverified_width;
    check.high = check.predicted + 0.5 * unverified_width;
    return Verdict::accept;
  }
  if (curve.corner || (std::abs(check.predicted) > check.most && check.has_apex)) {
    check.try_corner();
    return Verdict::look;
  }
  if (std::abs(check.predicted) > check.most) {
    if (cell.level < kMaxLevel && hidden > kLooseCurve * allowed) return Verdict::split;
    check.predicted = std::clamp(check.predicted, check.least, check.most);
  }
  const double disagreement = std::abs(curvature[0] - curvature[1]) * check.chord * check.chord / 8.0;
  // No neighbour tells how it bends. Borders bend one way more often than the other: a middle that is taken to lie on the
  // chord and confirmed within the tolerance would be off to the same side every time.
  if (neighbours == 0) {
    const std::uint64_t key =
        hash(seed_, lattice.image_x(cell.x), lattice.image_y(cell.y), cell.level, kMiddleDither);
    check.guessed = true;
    check.predicted = (2.0 * dither_.phase(key) - 1.0) * check.tolerance;
  }
  if (neighbours == 2 && curvature[0] * curvature[1] > 0.0)
    check.unevenness = 2.0 * std::abs(curvature[0] - curvature[1]) / std::abs(curvature[0] + curvature[1]);
  check.smooth =
      neighbours == 2 && !turns &&
      disagreement <= std::max(1.5 * std::max(check.tolerance, blur), 0.35 * std::abs(check.predicted));
  return Verdict::look;
}

}  // namespace ifov::sampling
