#pragma once

#include "thermal/solid.h"
#include "thermal/surface_balance.h"

namespace ifov::thermal {

/// The seven numbers by which DIRSIG's THERM knows a material: a uniform slab that begins at the temperature of the air.
struct ThermSlab {
  double density_kg_m3 = 0.0, specific_heat_j_kg_k = 0.0, conductivity_w_m_k = 0.0, thickness_m = 0.0;
  double solar_absorption = 0.0, emissivity = 0.0;
  double exposed_area = 0.5;  ///< share of both faces that the air reaches: 0.5 is the front alone, 1 both
};

/// One layer, insulated behind; the air takes heat from `exposed_area` of both faces, at the front.
Solid solid_of(const ThermSlab& slab);
Skin skin_of(const ThermSlab& slab);

}  // namespace ifov::thermal
