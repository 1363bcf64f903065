#include "materials/bsdf/mirror.h"

namespace ifov::materials {

const BsdfModel Mirror::kModel{"mirror", "a plane mirror", {}, [](const BsdfInputs&) { return shared(); }};

const std::shared_ptr<const Bsdf>& Mirror::shared() {
  static const std::shared_ptr<const Bsdf> object = std::make_shared<Mirror>();
  return object;
}

BsdfSample Mirror::sample(const BsdfEvent& view, double, double) const {
  const math::Vec3 incoming =
      2.0 * math::dot(view.normal, view.outgoing) * view.normal.as_vector() - view.outgoing;
  return {math::normalized(incoming), 1.0, 0.0};
}

}  // namespace ifov::materials
