#include "materials/bsdf/boundary/delta_boundary.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/bsdf/boundary/boundary_rows.h"

namespace ifov::materials {

DeltaBoundary::DeltaBoundary(std::vector<radiometry::Spectrum> shares, Properties properties)
    : shares_(std::move(shares)), properties_(std::move(properties)) {
  if (!properties_.transmits) shares_.resize(properties_.rows);
}

math::Vec3 refracted(math::Vec3 towards, math::Vec3 normal, double ratio) {
  const math::Vec3 along = (towards - math::dot(towards, normal) * normal) / ratio;
  const double left = 1.0 - math::dot(along, along);
  if (!(left > 0.0)) return {};
  return math::normalized(-along - std::sqrt(left) * normal);
}

BsdfSample DeltaBoundary::sample(const BsdfEvent& view, double, double) const {
  const math::Vec3 normal = view.normal.as_vector();
  if (view.side == Side::reflected)
    return {math::normalized(2.0 * math::dot(normal, view.outgoing) * normal - view.outgoing), 1.0, 0.0};
  if (!properties_.transmits) return {};
  if (properties_.passage == Passage::straight) return {-view.outgoing, 1.0, 0.0};
  const double ratio = properties_.passage == Passage::into ? properties_.index : 1.0 / properties_.index;
  const math::Vec3 incoming = refracted(view.outgoing, normal, ratio);
  return {incoming, math::dot(incoming, incoming) > 0.0 ? 1.0 : 0.0, 0.0};
}

void DeltaBoundary::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                             float* share) const {
  double cosine = event.outgoing_cosine();
  bool total = false;
  if (properties_.passage == Passage::out_of) {
    // A ray in the medium and the one that it becomes outside are reflected alike.
    const double square = 1.0 - properties_.index * properties_.index * (1.0 - cosine * cosine);
    total = !(square > 0.0);
    cosine = total ? 0.0 : std::sqrt(square);
  }
  const bool through = event.side == Side::transmitted;
  if (through && (total || !properties_.transmits)) {
    std::fill_n(share, count, 0.0f);
    return;
  }
  const RowWeights rows = boundary_rows::at(cosine, properties_.rows);
  const float* const* r = &parameters[rows.first + (through ? properties_.rows : 0)];
  float w[4];
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(rows.weight[i]);
  for (std::size_t n = 0; n < count; ++n)
    share[n] = std::clamp(w[0] * r[0][n] + w[1] * r[1][n] + w[2] * r[2][n] + w[3] * r[3][n], 0.0f, 1.0f);
}

}  // namespace ifov::materials
