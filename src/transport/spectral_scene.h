#pragma once

#include <memory>
#include <span>
#include <vector>

#include "materials/spectral_materials.h"
#include "radiometry/spectral_nodes.h"
#include "radiometry/spectrum_block.h"
#include "scene/resolved_surface.h"

namespace ifov::atmosphere {
class ImportedAtmosphere;
class SensorAtmosphere;
}  // namespace ifov::atmosphere
namespace ifov::radiometry {
class PlanckTable;
}
namespace ifov::scene {
class RadiationPattern;
struct Scene;
struct SurfaceState;
}  // namespace ifov::scene

namespace ifov::transport {

class AdjacentGround;
class EmitterMirrors;
class Emitters;
struct GroundAround;
class SkyDome;
class SunLobes;
class SunMirrors;
class SurroundingsLight;
class ViewTable;

/// The scene's spectra in the spectral nodes of a sensor: what a path multiplies and adds.
class SpectralScene {
 public:
  /// Keeps references to both; they must outlive this. `polarized`: what the polarization of light needs is kept.
  SpectralScene(const scene::Scene& scene, const radiometry::SpectralNodes& nodes, bool polarized = false);
  /// With an atmosphere in place of the scene's uniform sky and its tables of transmittance and path radiance. Light
  /// that goes back and forth between air and ground counts once, over ground as the scene's surroundings.
  SpectralScene(const scene::Scene& scene, const atmosphere::SensorAtmosphere& atmosphere,
                bool polarized = false);
  /// With what another code computed, under a uniform sky of its irradiance; where it has none, under the scene's own.
  SpectralScene(const scene::Scene& scene, const atmosphere::ImportedAtmosphere& atmosphere,
                bool polarized = false);
  ~SpectralScene();

  const scene::Scene& scene() const { return scene_; }
  /// Whether paths tell the polarization of their light (PolarizedPathLight).
  bool polarized() const { return polarized_; }
  const radiometry::SpectralNodes& nodes() const { return nodes_; }
  std::size_t node_count() const { return nodes_.node_count(); }
  std::size_t stride() const { return light_.stride(); }

  const materials::SpectralMaterials& materials() const { return materials_; }
  const SunMirrors* sun_mirrors() const { return mirrors_.get(); }  ///< null: the Sun lights none
  const SunLobes* sun_lobes() const { return lobes_.get(); }  ///< narrow ones; null: the Sun lights none

  const float* absorption(std::uint32_t material) const;  ///< of the medium behind it, 1/m; null: none
  /// Planck's radiance of a constituent's temperature, in `scratch` (stride() floats); null: none.
  const float* black(const scene::Constituent& constituent, float* scratch) const;

  /// What of the light that meets a material goes on in any node, at most; 0 marks a black surface, which ends paths.
  double brightest(std::uint32_t material) const {
    return materials_.maximum_reflectance(material) + materials_.maximum_transmittance(material);
  }

  /// Whether the spectra of a surface have to be computed: materials side by side, a temperature from a map, or a model or a lamp that depends on direction.
  bool is_mixed(const scene::ResolvedSurface& surface) const {
    return surface.count > 1 || surface.constituents[0].mapped_temperature_k > 0.0 ||
           materials_.directional(surface.constituents[0].material) != nullptr ||
           (!patterned_.empty() && patterned_[surface.constituents[0].state] != nullptr);
  }
  /// What the lamp of a state gives off in its brightest direction, W m-2 sr-1 um-1, and how that depends on the direction; null: it has no lamp, it does not.
  const float* lamp_radiance(std::uint32_t state) const;
  const scene::RadiationPattern* lamp_pattern(std::uint32_t state) const {
    return patterned_.empty() ? nullptr : patterned_[state];
  }
  /// Emitted radiance of a resolved surface towards a direction (unit, away from it), W m-2 sr-1 um-1; null where it emits
  /// nothing. `scratch` (3 stride() floats, 64-byte aligned) is used where the surface is_mixed().
  const float* emission(const scene::ResolvedSurface& surface, math::Vec3 outgoing, float* scratch) const;
  /// Its Q about radiometry::surface_frame() of the direction and the shading normal, into `scratch` (as above; U and V are 0).
  /// False where it is unpolarized.
  bool emission_q(const scene::ResolvedSurface& surface, math::Vec3 outgoing, float* scratch) const;

  /// Irradiance on a surface that faces the Sun (zero without one).
  const float* sun_irradiance() const { return light_.row(kSunIrradiance); }
  /// Of a uniform sky; under an atmosphere the mean over the sky, weighted as a level surface sees it.
  const float* sky_radiance() const { return light_.row(kSky); }
  const SkyDome* sky_dome() const { return dome_.get(); }  ///< null: the sky is uniform
  /// Of the surroundings, as of Lambertian ground; seen from above where they emit by direction.
  const float* surroundings_radiance() const { return light_.row(kSurroundings); }
  const SurroundingsLight* surroundings_light() const { return around_.get(); }  ///< null: Lambertian
  /// Towards a direction below the horizon, and what of that is emitted, of Sun and sky; rows have stride() floats.
  const float* surroundings_radiance(math::Vec3 direction, float* scratch) const;
  void split_surroundings(math::Vec3 direction, float* emitted, float* sun, float* sky) const;
  bool has_view_path() const { return has_view_path_; }
  const float* view_transmittance() const { return light_.row(kViewTransmittance); }
  const float* view_radiance() const { return light_.row(kViewRadiance); }
  /// Null where the two hold for all lines of sight and heights.
  const ViewTable* view_table() const { return view_table_.get(); }
  const float* view_diffuse() const { return light_.row(kDiffuse); }  ///< of ground of radiance 1
  /// The ground as the air sees it, place by place; null: as all around. To be set before light is asked for.
  const AdjacentGround* adjacent_ground() const { return adjacent_.get(); }
  void set_adjacent(std::shared_ptr<const AdjacentGround> ground) { adjacent_ = std::move(ground); }
  /// A table that tells the path's polarization, also where one line of sight holds for all; null where the atmosphere's tables are unpolarized.
  const ViewTable* polarized_path() const;

  /// Null where no surface outshines the others so much that its light has to be sought.
  const Emitters* emitters() const { return emitters_.get(); }
  std::vector<bool> sought_assignments() const;  ///< some of whose emission is sought; empty: none
  /// The planes of mirrors by way of which it is sought; null where there are none, or nothing to seek.
  const EmitterMirrors* emitter_mirrors() const { return emitter_mirrors_.get(); }

  /// Whether sunlight and skylight change with the height of what they fall on.
  bool light_by_height() const { return !heights_m_.empty(); }
  /// As sun_irradiance at a height; written to `scratch` (stride() floats, 64-byte aligned) where it changes.
  const float* sun_irradiance(double height_m, float* scratch) const;
  /// How much brighter than at the ground the sky is there.
  const float* sky_share(double height_m, float* scratch) const;

  /// By channel: radiance of a level white Lambertian under Sun and sky, through the view path's transmittance, and of one below the lamp that lights it most.
  std::vector<double> white_reflected() const;
  /// What the path to the sensor adds, by channel, W m-2 sr-1 um-1.
  std::vector<double> path_radiance() const;

 private:
  const float* emission(const scene::Constituent& constituent, double cosine, math::Vec3 outgoing,
                        float* scratch, float* work) const;
  /// What temperature makes it emit, without a lamp.
  const float* thermal_emission(const scene::Constituent& constituent, double cosine, float* scratch,
                                float* work) const;
  /// A black body of a constituent's temperature, where its model depends on direction or a map tells the temperature.
  bool black_body(const scene::Constituent& constituent, float* spectrum) const;
  void emit_surfaces();
  void light_lamps();
  void find_emitters();
  void find_mirrors();
  void emit(const scene::SurfaceState& state, float* spectrum) const;
  /// Planck's radiance of a constituent's mapped temperature, right on average where that is estimated.
  void mapped_black(const scene::Constituent& constituent, float* spectrum) const;
  void light_surroundings(const atmosphere::SensorAtmosphere* air = nullptr);
  void light_heights(const atmosphere::SensorAtmosphere& air);
  const float* between_heights(const radiometry::SpectrumBlock& rows, double height_m, float* scratch) const;
  void sky_of_scene();
  /// Rows of Sun, sky and view path over ground as the scene's surroundings; returns what that ground sends.
  /// `emitted`: by that ground, where the air's own light does not hold what it scatters of it already.
  template <class Air>
  GroundAround couple(const Air& air, std::span<const double> sky_irradiance, std::span<const float> emitted);
  GroundAround couple_directional(const atmosphere::SensorAtmosphere& air, std::span<const float> emitted);

  enum LightRow { kSunIrradiance, kSky, kSurroundings, kViewTransmittance, kViewRadiance, kDiffuse, kRows };
  const scene::Scene& scene_;
  const radiometry::SpectralNodes& nodes_;
  bool polarized_;
  materials::SpectralMaterials materials_;
  radiometry::SpectrumBlock emission_;  // by state; towards all sides alike
  radiometry::SpectrumBlock black_;     // by state, of directional materials: a black body of its temperature
  radiometry::SpectrumBlock lamps_;     // by lamp, in its brightest direction
  std::vector<const scene::RadiationPattern*> patterned_;  // by state; empty: all shine evenly
  radiometry::SpectrumBlock light_;                        // by LightRow
  std::unique_ptr<radiometry::PlanckTable> planck_;        // only where a temperature map needs it
  std::unique_ptr<const SkyDome> dome_;
  std::unique_ptr<const SurroundingsLight> around_;
  std::unique_ptr<const ViewTable> view_table_, single_view_;
  std::shared_ptr<const AdjacentGround> adjacent_;
  std::vector<double> heights_m_;                        // rising from 0; empty: all is as at the ground
  radiometry::SpectrumBlock sun_spectra_, sky_spectra_;  // by height
  bool has_view_path_ = false;
  std::shared_ptr<const Emitters> emitters_;
  std::shared_ptr<const EmitterMirrors> emitter_mirrors_;
  std::unique_ptr<const SunMirrors> mirrors_;
  std::unique_ptr<const SunLobes> lobes_;
};

}  // namespace ifov::transport
