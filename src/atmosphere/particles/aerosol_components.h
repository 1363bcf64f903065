#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "atmosphere/particles/particle_mixture.h"

namespace ifov::atmosphere {

/// Spheres of one component of data/atmosphere/aerosol_components.txt at a relative humidity (per cent): at those of the table its
/// sizes, between them these linear in log(100 % - humidity), constant beyond. The index of what takes up water is that of the dry
/// substance and of water (Hale and Querry 1973) by volume, as OPAC has it (Hess, Koepke and Schult 1998, section 3a).
/// std::out_of_range for a name that there is not.
std::shared_ptr<const MieParticles> component_spheres(std::string_view component, double humidity_percent);

/// Types of aerosol that are mixtures of components: their names in the file.
const std::vector<std::string>& composed_aerosols();
/// std::out_of_range for a name that there is not.
std::shared_ptr<const ParticleMixture> composed_aerosol(std::string_view name, double humidity_percent);

}  // namespace ifov::atmosphere
