#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>

#include "exposure/solved_surface.h"
#include "session/assembly/surfaces/thermal_assembly.h"

namespace ifov::io {
struct Document;
}
namespace ifov::scene {
struct Scene;
}
namespace ifov::sensor {
class Camera;
}

namespace ifov::session {

/// What a material is solved from, and its classes.
struct SolvedMaterial {
  ThermalMaterial thermal;
  std::shared_ptr<const thermal::SurfaceClasses> classes;
  std::shared_ptr<const exposure::SolvedSurface> surface{};  ///< what images ask
};
using ByMaterial = std::map<std::uint32_t, SolvedMaterial>;

/// Has images spend as many rays on each surface's points as they are worth (image_spending.cpp). `firsts`: whose classes a material has.
void choose_spending(scene::Scene& scene, const sensor::Camera& camera, ByMaterial& by_material,
                     const std::map<std::uint32_t, std::uint32_t>& firsts, int threads);

/// What the camera sees, evenly over the image, and what rays meet that go on from there.
std::vector<geometry::SurfacePoint> seen_evenly(const scene::Scene& scene, const sensor::Camera& camera);
std::vector<geometry::SurfacePoint> met_from(const scene::Scene& scene, const exposure::PastScene& past,
                                             std::span<const geometry::SurfacePoint> seen);

/// Of a scene whose temperatures are solved, by the number of the material. `deep_k`: as assemble_thermal.
ByMaterial solved_materials(const io::Document& document, const scene::Scene& scene, double deep_k);

/// A point that is solved in full by itself. `beside`: what comes from all but the sky, where it is known.
thermal::SurfaceSolution full_solution(const SolvedMaterial& solved, const thermal::OutdoorsSeries& series,
                                       thermal::Stand stand, math::Vec3 normal,
                                       const exposure::SolvedSurface::Exposure& exposure,
                                       std::vector<thermal::FromBeside> beside = {});

/// The balance of a point under a skin that is told.
thermal::SurfaceBalance face_balance(const SolvedMaterial& solved, const thermal::Skin& skin,
                                     const thermal::OutdoorsSeries& series, thermal::Stand stand,
                                     math::Vec3 normal, const exposure::SolvedSurface::Exposure& exposure,
                                     std::vector<thermal::FromBeside> beside);

/// What there is to ask of everything about a point.
struct Neighbourhood {
  const scene::Scene& scene;
  const exposure::PastScene& past;
  const ByMaterial& by_material;
  const thermal::OutdoorsSeries& series;
  const thermal::Stand& stand;
  double sun_radius_rad;
  int rays_beyond = 2;  ///< from each surface that is met
};

/// What comes to a point from all but the sky, by row of the series: its view of that times the mean of what surfaces send that `rays` meet, each solved in full by itself, with what comes to it
/// likewise by a few rays `depth` times more. What has a temperature of its own has that, what has none that of the air, and they reflect as the ground does. Empty where hardly anything but sky
/// is seen. `two_faces`: of a sheet, to both.
std::vector<thermal::FromBeside> beside_of(const Neighbourhood& about, const geometry::SurfacePoint& point,
                                           const exposure::SolvedSurface::Exposure& exposure,
                                           std::uint64_t key, int rays, int depth, bool two_faces = false);

/// What images make of the surfaces about a point, against two full solutions with what is about it, each by `rays` of its own: two estimates of by how much they are off. And by how much they
/// would change with one more surface behind those that are met.
struct BesideOff {
  std::array<double, 2> off_k{};
  std::array<double, 2> taken_k{};  ///< of these, what images add: without it they are off by what is left
  double further_k = 0.0;
};
BesideOff beside_off(const Neighbourhood& about, const exposure::SolvedSurface& surface,
                     const SolvedMaterial& solved, const geometry::SurfacePoint& point, std::uint64_t key,
                     const exposure::SolvedSurface::Exposure& exposure, double full_k, int rays = 6);

}  // namespace ifov::session
