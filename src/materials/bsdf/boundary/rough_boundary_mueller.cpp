#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "materials/bsdf/boundary/rough_boundary.h"
#include "materials/bsdf/boundary/rough_boundary_tables.h"
#include "materials/bsdf/microfacet/facet_mueller.h"
#include "radiometry/fresnel.h"

namespace ifov::materials {

using radiometry::Spectrum;

void RoughBoundaryTables::add_polarization(const Spectrum& n, const Spectrum& k, const Spectrum& factor,
                                           const std::vector<Spectrum>& fresnel) {
  const std::vector<Spectrum> elements = FresnelRows::polarization_of_index(n, k);
  for (const Spectrum& row : elements) {
    const Spectrum both[] = {row, factor};
    polarization.push_back(combined(both, [](std::span<const double> v) { return v[0] * v[1]; }));
  }
  // T_p = 1 - R_p and T_s = 1 - R_s: M_01 is that of reflection with the other sign, and M_22 = sqrt(T_p T_s).
  for (std::size_t row = 0; row < FresnelRows::kCount; ++row)
    polarization.push_back(elements[row].scaled(-1.0));
  for (std::size_t row = 0; row < FresnelRows::kCount; ++row) {
    const Spectrum both[] = {fresnel[row], elements[row]};
    polarization.push_back(combined(both, [](std::span<const double> v) {
      return std::sqrt(std::max(0.0, (1.0 - v[0]) * (1.0 - v[0]) - v[1] * v[1]));
    }));
  }
}

std::span<const Spectrum> RoughBoundary::polarization_spectra() const { return tables_->polarization; }

void RoughBoundary::evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                                     const MuellerRows& rows) const {
  constexpr std::size_t kTogether = 64;  // wavelengths: what they need lies on the stack
  const Local at = local(event);
  if (!at.is_possible()) {
    for (std::size_t column = 0; column < rows.columns(); ++column)
      for (std::size_t row = 0; row < 4; ++row) std::fill_n(rows.at(row, column), count, 0.0f);
    return;
  }
  const Once found = once(tables_->facets, at);
  const RowWeights fresnel = FresnelRows::at(found.outside);
  std::array<float, 4> w;
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(found.bsdf * fresnel.weight[i]);
  const ParameterSpectra polarization = parameters.subspan(tables_->spectra.size());
  const float* const* const whole_rows =
      &parameters[at.through ? RoughBoundaryTables::kThrough : RoughBoundaryTables::kReflected];
  const float* const* const along_rows =
      &polarization[at.through ? RoughBoundaryTables::kThroughAlong : RoughBoundaryTables::kReflectedAlong];
  const float* const* const cosine_rows =
      &polarization[at.through ? RoughBoundaryTables::kThroughCosine : RoughBoundaryTables::kReflectedCosine];
  // What is reflected totally is turned in phase alone: r_p conj(r_s) = exp(i delta), by the index that bends light.
  std::complex<double> turn = 0.0;
  if (from_within_ && !at.through && !(found.outside > 0.0)) {
    const radiometry::FresnelAmplitudes r = radiometry::fresnel_reflection_amplitudes(
        1.0 / tables_->index, std::min(1.0, math::dot(at.out, math::normalized(at.out + at.in))));
    turn = r.p * std::conj(r.s);
  }
  const bool total = std::norm(turn) > 0.0;
  const float turn_cosine = static_cast<float>(turn.real()), turn_sine = static_cast<float>(turn.imag());

  const FacetPlane plane(event);
  std::array<std::array<float, kTogether>, 4> spectra{};
  const auto between = [&](const float* const* table, std::size_t n) {
    const float* const* const r = table + fresnel.first;
    return w[0] * r[0][n] + w[1] * r[1][n] + w[2] * r[2][n] + w[3] * r[3][n];
  };
  for (std::size_t first = 0; first < count; first += kTogether) {
    const std::size_t here = std::min(kTogether, count - first);
    for (std::size_t n = 0; n < here; ++n) {
      const float whole = std::max(0.0f, between(whole_rows, first + n));
      float along = 0.0f, cosine = turn_cosine * whole, sine = turn_sine * whole;
      if (!total) {
        // Between rows elements may leave what a matrix can be by as much as they err.
        along = std::clamp(between(along_rows, first + n), -whole, whole);
        cosine = between(cosine_rows, first + n);
        sine = at.through ? 0.0f : between(&polarization[RoughBoundaryTables::kReflectedSine], first + n);
        const float most = std::sqrt(std::max(0.0f, whole * whole - along * along)),
                    size = std::sqrt(cosine * cosine + sine * sine);
        if (size > most) cosine *= most / size, sine *= most / size;
      }
      spectra[0][n] = whole, spectra[1][n] = along, spectra[2][n] = cosine, spectra[3][n] = sine;
    }
    write_facets(plane, {spectra[0].data(), spectra[1].data(), spectra[2].data(), spectra[3].data()}, here,
                 {rows.values + first, rows.stride, rows.all});
  }
  add_again(at, parameters, count, rows.at(0, 0));
}

}  // namespace ifov::materials
