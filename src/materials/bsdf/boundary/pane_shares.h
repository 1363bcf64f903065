#pragma once

#include <complex>

#include "radiometry/fresnel.h"

namespace ifov::materials {

/// One face of a pane, for light that comes from outside and from within.
struct PaneFace {
  radiometry::PowerShares outside, within;
};

/// Without a coating, of a material of this index (k > 0 where it absorbs).
PaneFace bare_face(std::complex<double> index, double cosine);

/// Share of light that goes once through a pane: exp(-2 Im(k_z) d), Beer's law along the refracted ray.
double passes_once(std::complex<double> index, double cosine, double thickness_um, double um);

/// Light to and fro between two faces, summed without interference: geometric series, polarization by polarization. As seen
/// from before `front`.
radiometry::PowerShares pane_shares(const PaneFace& front, const PaneFace& back, double passes);

}  // namespace ifov::materials
