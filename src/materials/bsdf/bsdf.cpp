#include "materials/bsdf/bsdf.h"

#include <numbers>
#include <stdexcept>

#include "math/frame.h"
#include "sampling/warp.h"

namespace ifov::materials {
namespace {

math::Normal3 axis_of(const BsdfEvent& event) {
  return event.side == Side::reflected ? event.normal : -event.normal;
}

}  // namespace

BsdfSample Bsdf::sample(const BsdfEvent& view, double u1, double u2) const {
  const math::Vec3 local = sampling::cosine_hemisphere({u1, u2});
  BsdfEvent event = view;
  event.incoming = math::frame_from_normal(axis_of(view)).outer_from_local(local);
  return {event.incoming, is_separable() ? 1.0 : std::numbers::pi, local.z / std::numbers::pi};
}

double Bsdf::pdf(const BsdfEvent& event) const {
  const double cosine = event.incoming_cosine();
  return cosine > 0.0 ? cosine / std::numbers::pi : 0.0;
}

UnitSquarePoint Bsdf::invert(const BsdfEvent& event) const {
  const math::Vec3 local = math::frame_from_normal(axis_of(event)).local_from_outer(event.incoming);
  const sampling::Point2 u = sampling::cosine_hemisphere_inverse(local);
  return {u.x, u.y};
}

double Bsdf::seam(const BsdfEvent&) const { return 0.0; }

double Bsdf::shape(const BsdfEvent& event) const {
  return event.incoming_cosine() > 0.0 && event.outgoing_cosine() > 0.0 ? 1.0 : 0.0;
}

double Bsdf::grey(const BsdfEvent& event) const {
  return is_separable() ? shape(event) : std::numbers::inv_pi;
}

void Bsdf::evaluate(const BsdfEvent&, ParameterSpectra, std::size_t, float*) const {
  throw std::logic_error("a separable BSDF has no spectra of its own");
}

void Bsdf::evaluate_mueller(const BsdfEvent&, ParameterSpectra, std::size_t, const MuellerRows&) const {
  throw std::logic_error("a BSDF that depolarizes has no Mueller matrix");
}

}  // namespace ifov::materials
