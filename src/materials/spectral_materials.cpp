#include "materials/spectral_materials.h"

#include <algorithm>

namespace ifov::materials {

SpectralMaterials::SpectralMaterials(std::span<const Material> materials,
                                     const radiometry::SpectralNodes& nodes)
    : reflectance_(materials.size(), nodes.node_count()),
      emissivity_(materials.size(), nodes.node_count()) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const Material& material = materials[m];
    nodes.average_surface(material.reflectance, reflectance_.values(m));
    nodes.average_surface(material.reflectance.complement(), emissivity_.values(m));
    float highest = 0.0f;
    for (float value : reflectance_.values(m)) highest = std::max(highest, value);
    maximum_reflectance_.push_back(highest);
  }
}

}  // namespace ifov::materials
