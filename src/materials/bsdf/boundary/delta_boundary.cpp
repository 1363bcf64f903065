#include "materials/bsdf/boundary/delta_boundary.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "materials/bsdf/boundary/boundary_polarization.h"
#include "radiometry/fresnel.h"

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

double DeltaBoundary::outside_cosine(const BsdfEvent& event, bool& total) const {
  const double cosine = event.outgoing_cosine();
  total = false;
  if (properties_.passage != Passage::out_of) return cosine;
  // A ray in the medium and the one that it becomes outside are reflected alike.
  const double square = 1.0 - properties_.index * properties_.index * (1.0 - cosine * cosine);
  total = !(square > 0.0);
  return total ? 0.0 : std::sqrt(square);
}

void DeltaBoundary::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                             float* share) const {
  bool total = false;
  const double cosine = outside_cosine(event, total);
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

std::span<const radiometry::Spectrum> DeltaBoundary::polarization_spectra() const {
  std::call_once(made_, [&] {
    if (properties_.polarization) polarization_ = properties_.polarization();
  });
  return polarization_;
}

void DeltaBoundary::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                     const MuellerRows& rows) const {
  using boundary_polarization::kElements;
  float* __restrict whole = rows.at(0, 0);
  evaluate(event, parameters, count, whole);
  for (std::size_t c = 0; c < rows.columns(); ++c)
    for (std::size_t r = c == 0 ? 1 : 0; r < 4; ++r) std::fill_n(rows.at(r, c), count, 0.0f);
  bool total = false;
  const double cosine = outside_cosine(event, total);
  const bool through = event.side == Side::transmitted;
  if (through && (total || !properties_.transmits)) return;
  const ParameterSpectra own = parameters.subspan(shares_.size());
  if (total) return turn_totally(event, own.back(), count, rows);

  const std::size_t beside = boundary_polarization::rows_beside(properties_.rows);
  const RowWeights at = boundary_rows::at(cosine, beside);
  float w[4];
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(at.weight[i]);
  const auto element = [&](std::size_t k, std::size_t n) {
    const float* const* r = &own[((through ? kElements : 0) + k) * beside + at.first];
    return w[0] * r[0][n] + w[1] * r[1][n] + w[2] * r[2][n] + w[3] * r[3][n];
  };
  for (std::size_t n = 0; n < count; ++n) {
    const float sum = element(0, n), scale = sum > 1e-12f ? whole[n] / sum : 0.0f;
    // Between rows no more than a matrix can be: |M_01| <= M_00 and M_22^2 + M_23^2 <= M_00^2 - M_01^2.
    const float difference = std::clamp(scale * element(1, n), -whole[n], whole[n]);
    rows.at(1, 0)[n] = difference;
    if (!rows.all) continue;
    float real = scale * element(2, n), imaginary = scale * element(3, n);
    const float most = whole[n] * whole[n] - difference * difference,
                square = real * real + imaginary * imaginary;
    if (square > most) {
      const float less = std::sqrt(std::max(0.0f, most) / square);
      real *= less, imaginary *= less;
    }
    rows.at(0, 1)[n] = difference;
    rows.at(1, 1)[n] = whole[n];
    rows.at(2, 2)[n] = rows.at(3, 3)[n] = real;
    rows.at(2, 3)[n] = imaginary;
    rows.at(3, 2)[n] = -imaginary;
  }
}

/// All is reflected, p and s with phases of their own (Born and Wolf, section 1.5.4).
void DeltaBoundary::turn_totally(const BsdfEvent& event, const float* index, std::size_t count,
                                 const MuellerRows& rows) const {
  if (!rows.all) return;
  for (std::size_t n = 0; n < count; ++n) {
    const float whole = rows.at(0, 0)[n];
    const double inverse = index[n] > 0.0f ? 1.0 / static_cast<double>(index[n]) : 1.0;
    const radiometry::FresnelAmplitudes r =
        radiometry::fresnel_reflection_amplitudes(inverse, event.outgoing_cosine());
    const std::complex<double> both = r.p * std::conj(r.s);
    // Directions are bent by one index of all wavelengths: in others light may be at the limit of total reflection.
    const double size = std::abs(both);
    const std::complex<double> turn =
        std::norm(r.s) > 1.0 - 1e-9 && size > 0.0 ? both / size : std::complex<double>(1.0);
    rows.at(1, 1)[n] = whole;
    rows.at(2, 2)[n] = rows.at(3, 3)[n] = whole * static_cast<float>(turn.real());
    rows.at(2, 3)[n] = whole * static_cast<float>(turn.imag());
    rows.at(3, 2)[n] = -rows.at(2, 3)[n];
  }
}

}  // namespace ifov::materials
