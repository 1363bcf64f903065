#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "exposure/solved_surface.h"
#include "session/assembly/surfaces/thermal_assembly.h"

namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// What a material is solved from, and its classes.
struct SolvedMaterial {
  ThermalMaterial thermal;
  std::shared_ptr<const thermal::SurfaceClasses> classes;
};
using ByMaterial = std::map<std::uint32_t, SolvedMaterial>;

/// A point that is solved in full by itself. `beside`: what comes from all but the sky, where it is known.
thermal::SurfaceSolution full_solution(const SolvedMaterial& solved, const thermal::OutdoorsSeries& series,
                                       thermal::Stand stand, math::Vec3 normal,
                                       const exposure::SolvedSurface::Exposure& exposure,
                                       std::vector<thermal::FromBeside> beside = {});

/// What there is to ask of everything about a point.
struct Neighbourhood {
  const scene::Scene& scene;
  const exposure::PastScene& past;
  const ByMaterial& by_material;
  const thermal::OutdoorsSeries& series;
  const thermal::Stand& stand;
  double sun_radius_rad;
};

/// By what a point that is solved in full becomes warmer where what it sees of the scene is not level ground as warm as the air, but what is
/// there: each of a few surfaces, met by rays, solved in full by itself (first pass), and this point again with their light and their heat
/// (second). What has a temperature of its own has that, and reflects as the ground does.
double second_pass_k(const Neighbourhood& about, const SolvedMaterial& solved,
                     const geometry::SurfacePoint& point, std::uint64_t key,
                     const exposure::SolvedSurface::Exposure& exposure, double first_pass_k);

}  // namespace ifov::session
