#pragma once

#include <cstddef>

#include "materials/bsdf/event/bsdf_event.h"
#include "materials/bsdf/microfacet/facet_reflection.h"

namespace ifov::materials {

/// From the frames of a MuellerRows to the plane of both directions and back, cos and sin of twice the angles: in that plane
/// lies the normal of a facet that reflects from one direction into the other, so that Fresnel's matrix is about it.
struct FacetPlane {
  double cos_in, sin_in;    ///< of light that arrives: Q' = cos Q + sin U, U' = -sin Q + cos U
  double cos_out, sin_out;  ///< of light that leaves: the same, back to its own frame

  explicit FacetPlane(const BsdfEvent& event);
};

/// The matrix of facets about the plane of both directions, in wavelengths (equation 9 of docs/theory/polarization.md, times what
/// facets do besides):
///   [ whole  along  0     0    ]   whole = (|r_p|^2 + |r_s|^2) / 2    along = (|r_p|^2 - |r_s|^2) / 2
///   [ along  whole  0     0    ]   cosine = Re(r_p r_s*)              sine = Im(r_p r_s*)
///   [ 0      0      cosine sine]
///   [ 0      0     -sine cosine]
struct FacetSpectra {
  const float *whole, *along, *cosine, *sine;
};

/// Writes all elements that are asked for, about the frames of the event.
void write_facets(const FacetPlane& plane, const FacetSpectra& facets, std::size_t count,
                  const MuellerRows& rows);

/// The same of facets that reflect once by FresnelRows: `fresnel` has those of_index(), `polarization` the three times as many of
/// polarization_of_index().
void write_facets(const FacetPlane& plane, const FacetReflection& once, ParameterSpectra fresnel,
                  ParameterSpectra polarization, std::size_t count, const MuellerRows& rows);

}  // namespace ifov::materials
