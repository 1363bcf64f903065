#include "materials/bsdf/microfacet/facet_mueller.h"

#include <algorithm>
#include <array>

#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "radiometry/polarization_frame.h"

namespace ifov::materials {

namespace {

using radiometry::PolarizationFrame;

/// Twice the angle by which x of one frame is turned from that of another of the same direction.
void twice_turned(const PolarizationFrame& from, const PolarizationFrame& to, double& cosine, double& sine) {
  const double c = math::dot(to.x, from.x), s = math::dot(to.x, from.y()), square = c * c + s * s;
  cosine = (c * c - s * s) / square;
  sine = 2.0 * c * s / square;
}

}  // namespace

FacetPlane::FacetPlane(const BsdfEvent& event) {
  const math::Vec3 normal = event.normal.as_vector();
  const PolarizationFrame in = radiometry::surface_frame(-event.incoming, normal),
                          out = radiometry::surface_frame(event.outgoing, normal);
  radiometry::ScatteringFrames facet = radiometry::scattering_frames(in.direction, out.direction);
  // Of light that goes straight on, or back, the plane of its own incidence serves.
  if (math::length(math::cross(in.direction, out.direction)) < 1e-9) facet = {in, out};
  twice_turned(in, facet.before, cos_in, sin_in);
  twice_turned(facet.after, out, cos_out, sin_out);
}

void write_facets(const FacetPlane& plane, const FacetSpectra& facets, std::size_t count,
                  const MuellerRows& rows) {
  const float co = static_cast<float>(plane.cos_out), so = static_cast<float>(plane.sin_out);
  const float* __restrict whole = facets.whole, * __restrict along = facets.along;
  float* __restrict i = rows.at(0, 0), * __restrict q = rows.at(1, 0), * __restrict u = rows.at(2, 0);
  for (std::size_t n = 0; n < count; ++n) {
    i[n] = whole[n];
    q[n] = co * along[n];
    u[n] = -so * along[n];
  }
  std::fill_n(rows.at(3, 0), count, 0.0f);
  if (!rows.all) return;
  const float ci = static_cast<float>(plane.cos_in), si = static_cast<float>(plane.sin_in);
  const float* __restrict cosine = facets.cosine, * __restrict sine = facets.sine;
  // Of light along x of the event's frame, and along the middle between its axes.
  const float into_q[] = {ci, si}, into_u[] = {-si, ci};
  for (std::size_t k = 0; k < 2; ++k) {
    const float a = into_q[k], b = into_u[k];
    float* __restrict to_i = rows.at(0, 1 + k), * __restrict to_q = rows.at(1, 1 + k), * __restrict to_u = rows.at(2, 1 + k), * __restrict to_v = rows.at(3, 1 + k);
    for (std::size_t n = 0; n < count; ++n) {
      const float in_plane = a * whole[n], across = b * cosine[n];
      to_i[n] = a * along[n];
      to_q[n] = co * in_plane + so * across;
      to_u[n] = -so * in_plane + co * across;
      to_v[n] = -b * sine[n];
    }
  }
  float* __restrict to_q = rows.at(1, 3), * __restrict to_u = rows.at(2, 3), * __restrict to_v = rows.at(3, 3);
  std::fill_n(rows.at(0, 3), count, 0.0f);
  for (std::size_t n = 0; n < count; ++n) {
    to_q[n] = so * sine[n];
    to_u[n] = co * sine[n];
    to_v[n] = cosine[n];
  }
}

void write_facets(const FacetPlane& plane, const FacetReflection& once, ParameterSpectra fresnel,
                  ParameterSpectra polarization, std::size_t count, const MuellerRows& rows) {
  constexpr std::size_t kTogether = 64;  // wavelengths: what they need lies on the stack
  const RowWeights at = FresnelRows::at(once.cosine);
  std::array<float, 4> w;
  for (std::size_t i = 0; i < 4; ++i) w[i] = static_cast<float>(once.bsdf * at.weight[i]);
  std::array<std::array<float, kTogether>, 4> spectra{};
  const std::size_t elements = rows.all ? 4 : 2;
  for (std::size_t first = 0; first < count; first += kTogether) {
    const std::size_t here = std::min(kTogether, count - first);
    for (std::size_t e = 0; e < elements; ++e) {
      const float* const* const table =
          e == 0 ? fresnel.data() + at.first : polarization.data() + (e - 1) * FresnelRows::kCount + at.first;
      const float* __restrict a = table[0] + first, * __restrict b = table[1] + first, * __restrict c = table[2] + first, * __restrict d = table[3] + first;
      float* __restrict out = spectra[e].data();
      for (std::size_t n = 0; n < here; ++n) out[n] = w[0] * a[n] + w[1] * b[n] + w[2] * c[n] + w[3] * d[n];
    }
    write_facets(plane, {spectra[0].data(), spectra[1].data(), spectra[2].data(), spectra[3].data()}, here,
                 {rows.values + first, rows.stride, rows.all});
  }
}

}  // namespace ifov::materials
