#include "transport/mirrors/lobe_targets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transport/mirrors/sun_mirrors.h"

namespace ifov::transport {

namespace {

using geometry::SurfaceSurvey;
using math::Point3;
using math::Vec3;

/// Of the rays to a target whose highlight is known, so many are sent to it.
constexpr double kToHighlight = 0.75;
/// Rays to a target are as many as its radius is large to the eye: small ones are met seldom by chance. Those to one whose
/// normals do not show the Sun are fewer, down to this share.
constexpr double kLeastShare = 0.02;

/// 1 - cosine of an angle given by its sine.
double versine_of_sine(double s) { return s * s / (1.0 + std::sqrt(std::max(0.0, 1.0 - s * s))); }

bool holds(Vec3 axis, double versine, Vec3 direction) {
  const Vec3 chord = direction - axis;
  return math::dot(chord, chord) <= 2.0 * versine;
}

}  // namespace

LobeTargets::LobeTargets(const SurfaceSurvey& survey, Vec3 towards_sun, double slope)
    : towards_sun_(towards_sun), slope_(slope) {
  std::vector<SurfaceSurvey::Ball> balls;
  if (survey.rounds.size() <= kMostRounds) {
    for (const SurfaceSurvey::Round& round : survey.rounds)
      targets_.push_back({round.ball, RoundMirror::of(round), false, {}, 0.0});
  } else {
    for (const SurfaceSurvey::Round& round : survey.rounds) balls.push_back(round.ball);
  }
  if (survey.all_facets) {
    for (const FacetCluster& cluster : facet_clusters(survey, kMostClusters)) {
      const bool lit = math::dot(cluster.normal, towards_sun) >= 0.0;
      targets_.push_back(
          {cluster.ball, std::nullopt, true, lit ? cluster.normal : -cluster.normal, cluster.spread});
    }
  }
  // Those about meshes, whose triangles are in the clusters, stand in the order of `smooths`.
  std::size_t mesh = 0;
  for (const SurfaceSurvey::Ball& ball : survey.balls) {
    const bool known = mesh < survey.smooths.size() &&
                       math::length(survey.smooths[mesh].ball.centre_m - ball.centre_m) == 0.0 &&
                       survey.smooths[mesh].ball.radius_m == ball.radius_m;
    if (known)
      ++mesh;
    else
      balls.push_back(ball);
  }
  for (const SurfaceSurvey::Ball& ball : SunMirrors::grouped(std::move(balls)))
    targets_.push_back({ball, std::nullopt, false, {}, 0.0});
}

// The distribution of normals of GGX facets (Walter et al. 2007).
Vec3 LobeTargets::Highlight::sample(sampling::Point2 u) const {
  const double tangent = width * std::sqrt(u.x / std::max(1e-12, 1.0 - u.x)),
               turn = 2.0 * std::numbers::pi * u.y;
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  return sampling::TangentFrame(axis).to_world({sine * std::cos(turn), sine * std::sin(turn), cosine});
}

double LobeTargets::Highlight::density(Vec3 direction) const {
  const double cosine = math::dot(axis, direction);
  if (cosine <= 0.0) return 0.0;
  const double across = math::length(math::cross(axis, direction)), square = width * width;
  const double below = across * across + cosine * cosine * square;
  return square * cosine / (std::numbers::pi * below * below);
}

void LobeView::fill(const LobeTargets& targets, Point3 from, Vec3 normal) {
  count_ = std::min(targets.targets_.size(), LobeTargets::kMost);
  all_ = 0.0;
  const Vec3 sun = targets.towards_sun_;
  for (std::size_t k = 0; k < count_; ++k) {
    const LobeTargets::Target& target = targets.targets_[k];
    Aim& aim = aims_[k];
    const Vec3 towards = target.ball.centre_m - from;
    const double apart = math::length(towards);
    const bool inside = apart <= target.ball.radius_m;
    const double sine = inside ? 1.0 : target.ball.radius_m / apart;
    aim.whole =
        inside ? LobeTargets::Cone{normal, 1.0} : LobeTargets::Cone{towards / apart, versine_of_sine(sine)};
    aim.share = sine;
    aim.shows = false;
    if (target.round) {
      if (const std::optional<RoundMirror::Image> image = target.round->image(from, sun)) {
        aim.highlight = {image->direction, targets.slope_ * target.ball.radius_m / image->distance_m};
        aim.shows = aim.highlight.width < 0.5 * sine;
      }
    } else if (target.facets) {
      const double width = 2.0 * (targets.slope_ + target.spread);
      if (!inside) {
        const Vec3 half = sun - towards / apart;
        const double length = math::length(half);
        const double off = length > 0.0 ? math::length(half / length - target.normal) : 1.0;
        const double excess = std::max(0.0, off - target.spread - 0.6 * sine) / (2.0 * targets.slope_);
        const double square = excess * excess;
        aim.share *= std::max(kLeastShare, 1.0 / (1.0 + square * square));
      }
      aim.highlight = {sun - 2.0 * math::dot(sun, target.normal) * target.normal, width};
      aim.shows = (inside || width < 0.5 * sine) && width < 1.0;
    }
    all_ += aim.share;
  }
}

Vec3 LobeView::sample(double choice, sampling::Point2 u) const {
  double position = choice * all_;
  std::size_t picked = 0;
  while (picked + 1 < count_ && position >= aims_[picked].share) position -= aims_[picked++].share;
  const Aim& aim = aims_[picked];
  if (aim.shows) {
    if (u.x < kToHighlight) {
      u.x /= kToHighlight;
      return aim.highlight.sample(u);
    }
    u.x = (u.x - kToHighlight) / (1.0 - kToHighlight);
  }
  return sampling::UniformCone(2.0 * std::asin(std::sqrt(0.5 * aim.whole.versine))).sample(aim.whole.axis, u);
}

double LobeView::density(Vec3 direction) const {
  double density = 0.0;
  for (std::size_t k = 0; k < count_; ++k) {
    const Aim& aim = aims_[k];
    const double whole = holds(aim.whole.axis, aim.whole.versine, direction)
                             ? 1.0 / (2.0 * std::numbers::pi * aim.whole.versine)
                             : 0.0;
    density +=
        aim.share *
        (aim.shows ? (1.0 - kToHighlight) * whole + kToHighlight * aim.highlight.density(direction) : whole);
  }
  return density / all_;
}

}  // namespace ifov::transport
