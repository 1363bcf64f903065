#include "materials/bsdf/lambertian.h"

#include <numbers>

namespace ifov::materials {

const BsdfModel Lambertian::kModel{
    "lambertian", "the same radiance to all sides; also of what a leaf transmits", {}, [](const BsdfInputs&) {
      return shared();
    }};

const std::shared_ptr<const Bsdf>& Lambertian::shared() {
  static const std::shared_ptr<const Bsdf> object = std::make_shared<Lambertian>();
  return object;
}

double Lambertian::shape(const BsdfEvent& event) const {
  return event.incoming_cosine() > 0.0 && event.outgoing_cosine() > 0.0 ? std::numbers::inv_pi : 0.0;
}

}  // namespace ifov::materials
