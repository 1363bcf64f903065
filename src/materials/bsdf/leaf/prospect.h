#pragma once

#include <cstdint>

#include "radiometry/spectrum.h"

namespace ifov::materials {

enum class ProspectVersion : std::uint8_t { five, d, pro };

/// What a leaf is made of, as PROSPECT counts it.
struct LeafContents {
  double layers = 1.5;        ///< N: compact layers, 1 or more
  double chlorophyll = 40.0;  ///< a and b, ug/cm2
  double carotenoids = 8.0;   ///< ug/cm2
  double anthocyanins = 0.0;  ///< ug/cm2; versions D and PRO
  double brown = 0.0;         ///< brown pigments, arbitrary units
  double water = 0.01;        ///< g/cm2 or cm
  double dry_matter = 0.009;  ///< g/cm2; versions 5 and D
  double proteins = 0.0;      ///< g/cm2; version PRO
  double carbon = 0.0;        ///< other carbon-based constituents, g/cm2; version PRO
};

/// Directional-hemispherical reflectance and transmittance of a leaf for light within 40 deg of its normal, 0.4 to 2.5 um.
struct LeafOptics {
  radiometry::Spectrum reflectance, transmittance;
  radiometry::Spectrum surface;  ///< the part of the reflectance that its upper surface makes
};

/// Allen's plates (Jacquemoud and Baret 1990, Remote Sens. Environ. 34, 75; Feret et al. 2008, 2017, 2021) with the coefficients
/// of data/leaf.
LeafOptics prospect(ProspectVersion version, const LeafContents& contents);

/// Mean transmittance of a smooth dielectric surface for unpolarized light from a cone of this half angle, over projected solid angle (Stern 1964,
/// Appl. Opt. 3, 111).
double cone_transmittance(double index, double half_angle_rad);

/// One plate, or N of them, from its index, its optical depth and the half angle of the cone.
struct PlateOptics {
  double reflectance, transmittance, surface;
};
PlateOptics plates(double index, double depth, double layers, double half_angle_rad);

}  // namespace ifov::materials
