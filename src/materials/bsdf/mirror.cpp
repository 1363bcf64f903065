#include "materials/bsdf/mirror.h"

#include <algorithm>

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

void Mirror::evaluate_mueller(const BsdfEvent&, ParameterSpectra, std::size_t count,
                              const MuellerRows& rows) const {
  constexpr float kDiagonal[] = {1.0f, 1.0f, -1.0f, -1.0f};  // r_p = -r_s
  for (std::size_t c = 0; c < rows.columns(); ++c)
    for (std::size_t r = 0; r < 4; ++r) std::fill_n(rows.at(r, c), count, r == c ? kDiagonal[r] : 0.0f);
}

}  // namespace ifov::materials
