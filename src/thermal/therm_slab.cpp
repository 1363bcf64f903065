#include "thermal/therm_slab.h"

namespace ifov::thermal {

Solid solid_of(const ThermSlab& slab) {
  return {{{slab.thickness_m, slab.conductivity_w_m_k, slab.density_kg_m3, slab.specific_heat_j_kg_k}},
          Insulated{}};
}

Skin skin_of(const ThermSlab& slab) {
  Skin skin;
  skin.solar_absorptance = slab.solar_absorption;
  skin.emissivity = slab.emissivity;
  skin.roughness = Roughness::smooth;
  skin.convecting_faces = 2.0 * slab.exposed_area;
  return skin;
}

}  // namespace ifov::thermal
