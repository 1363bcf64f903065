#include "materials/bsdf/two_lobes.h"

#include <cmath>

#include "materials/bsdf/microfacet/facet_frame.h"

namespace ifov::materials {

TwoLobes::TwoLobes(double direction_rad)
    : cos_direction_(std::cos(direction_rad)), sin_direction_(std::sin(direction_rad)) {}

math::Frame TwoLobes::frame_of(const BsdfEvent& event) const {
  const math::Frame frame = facet_frame(event.normal, event.tangent);
  return {cos_direction_ * frame.x + sin_direction_ * frame.y,
          cos_direction_ * frame.y - sin_direction_ * frame.x, frame.z};
}

TwoLobes::Directions TwoLobes::directions_of(const BsdfEvent& event) const {
  const math::Frame frame = frame_of(event);
  return {frame.local_from_outer(event.outgoing), frame.local_from_outer(event.incoming)};
}

double TwoLobes::mixed_density(const Directions& event) const {
  const double broad = broad_share(event.out);
  return broad * density(Lobe::broad, event) + (1.0 - broad) * density(Lobe::narrow, event);
}

BsdfSample TwoLobes::sample(const BsdfEvent& view, double u1, double u2) const {
  const math::Frame frame = frame_of(view);
  Directions event{frame.local_from_outer(view.outgoing), {}};
  const double broad = broad_share(event.out);
  event.in = u1 < broad ? draw(Lobe::broad, event.out, {u1 / broad, u2})
                        : draw(Lobe::narrow, event.out, {(u1 - broad) / (1.0 - broad), u2});
  BsdfSample sample{math::normalized(frame.outer_from_local(event.in)), 0.0, 0.0};
  if (!event.are_above()) return sample;
  sample.pdf = mixed_density(event);
  sample.weight = sample.pdf > 0.0 ? event.in.z / sample.pdf : 0.0;
  return sample;
}

double TwoLobes::pdf(const BsdfEvent& event) const {
  const Directions directions = directions_of(event);
  return directions.are_above() ? mixed_density(directions) : 0.0;
}

UnitSquarePoint TwoLobes::invert(const BsdfEvent& event) const {
  const Directions directions = directions_of(event);
  const double broad = broad_share(directions.out);
  if (broad * density(Lobe::broad, directions) > (1.0 - broad) * density(Lobe::narrow, directions)) {
    const sampling::Point2 u = undraw(Lobe::broad, directions);
    return {broad * u.x, u.y};
  }
  const sampling::Point2 u = undraw(Lobe::narrow, directions);
  return {broad + (1.0 - broad) * u.x, u.y};
}

double TwoLobes::seam(const BsdfEvent& view) const {
  return broad_share(frame_of(view).local_from_outer(view.outgoing));
}

double TwoLobes::grey(const BsdfEvent& event) const {
  const Directions directions = directions_of(event);
  return directions.are_above() ? grey_bsdf(directions) : 0.0;
}

double TwoLobes::lobe_share(const BsdfEvent& event) const {
  const Directions directions = directions_of(event);
  const double all = directions.are_above() ? grey_bsdf(directions) : 0.0;
  return all > 0.0 ? narrow_grey(directions) / all : 0.0;
}

double TwoLobes::widened_lobe(const BsdfEvent& event, double slope) const {
  const Directions directions = directions_of(event);
  return directions.are_above() ? widened_grey(directions, slope) : 0.0;
}

}  // namespace ifov::materials
