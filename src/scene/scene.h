#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/material.h"
#include "radiometry/spectrum.h"
#include "scene/resolved_surface.h"

namespace ifov::geometry {
struct SurfacePoint;
class World;
}  // namespace ifov::geometry
namespace ifov::materials {
class ClassMap;
class NumberedMap;
class TemperatureMap;
}  // namespace ifov::materials

namespace ifov::scene {

/// The Sun over the scene, or the Moon where it lights the night. Its disc is uniform in radiance.
struct Sun {
  math::Vec3 direction;         ///< unit, from the scene towards the Sun (ENU)
  double half_angle_rad = 0.0;  ///< of the disc; 0: a point, without penumbra
  /// W m-2 um-1 on a surface that faces the Sun, outside the atmosphere, at the Sun's actual distance.
  radiometry::Spectrum irradiance;
  radiometry::Spectrum transmittance = radiometry::Spectrum::constant(1.0);  ///< from there to the surface
  bool is_moon = false;

  double zenith_rad() const;                        ///< of `direction`, 0 to pi
  double elevation_rad() const;                     ///< above the horizon, -pi/2 to pi/2
  double azimuth_rad() const;                       ///< clockwise from north, -pi to pi
  bool is_up() const { return direction.z > 0.0; }  ///< above the horizon
  /// The Sun up to 6 degrees below the horizon: air above still lights the ground.
  bool is_twilight() const;
};

/// The sky: the same radiance from everywhere above the horizon.
struct Sky {
  std::optional<radiometry::Spectrum> radiance;  ///< W m-2 sr-1 um-1
  std::optional<double> temperature_k;           ///< a black sky of this temperature
};

/// Between the surface and the sensor, for every pixel alike.
struct ViewPath {
  std::optional<radiometry::Spectrum> transmittance;
  std::optional<radiometry::Spectrum> radiance;  ///< W m-2 sr-1 um-1, added
};

struct Lamp;
class SolvedTemperature;
class SurfaceCutOut;

/// A material at a temperature; 0 K emits nothing.
struct SurfaceState {
  std::uint32_t material = 0;
  double temperature_k = 0.0;
  std::uint32_t lamp = 0;    ///< 1 + index into Scene::lamps, whose light it gives off as well; 0: none
  std::uint32_t solved = 0;  ///< 1 + index into Scene::solved, which tells its temperature; 0: none
  friend bool operator==(const SurfaceState&, const SurfaceState&) = default;
};

/// Lowest and highest of some temperatures above 0 K, kelvins.
struct TemperatureRange {
  double coldest_k = 0.0, hottest_k = 0.0;
};

/// What changes a surface assignment from point to point beyond classes and temperatures: mixtures, textures, bumps. Called
/// for every hit, from many threads; must not allocate, and depend on the point alone.
class Pattern {
 public:
  virtual ~Pattern() = default;

  /// Rewrites what was resolved so far: splits or replaces constituents, sets their temperatures, tilts the shading normal. Leaves it as ResolvedSurface says it must be.
  virtual void apply(const geometry::SurfacePoint& point, ResolvedSurface& surface) const = 0;

  /// Whether constituents of unlike materials (see truth_materials) may come out side by side. Labels do not tell
  /// materials apart on such a surface assignment; abundances are estimated from the weights.
  virtual bool mixes_materials() const { return false; }
  /// Where it mixes, the materials that it brings in besides those of the surface assignment's own states; empty: any of the scene's. Each costs a column of numbers.
  virtual std::vector<std::uint32_t> mixed_materials() const { return {}; }

  /// The states that `apply` puts in the place of a state of the surface assignment, where these may emit or scatter otherwise.
  virtual std::vector<std::uint32_t> replacing(std::uint32_t) const { return {}; }
  /// Whether `apply` may tilt the shading normal.
  virtual bool bends_normals() const { return false; }

  /// Lowest and highest temperature that `apply` sets; none where it sets none.
  virtual std::optional<TemperatureRange> temperatures() const { return std::nullopt; }
  virtual void add_maps(std::vector<const materials::NumberedMap*>&) const {}  ///< that `apply` looks up
};

/// What covers a part of an object (SurfacePoint::material is an index into Scene::assignments): one state, or a map
/// of classes draped from above, each with its state. Where a state has a temperature map, that replaces its temperature. Patterns then apply in their order.
struct SurfaceAssignment {
  std::vector<std::uint32_t> states;  ///< indices into Scene::states; one, or by class index of the map
  std::shared_ptr<const materials::ClassMap> classes;
  std::vector<std::shared_ptr<const materials::TemperatureMap>> temperatures;  ///< by state; empty: none
  std::vector<std::shared_ptr<const Pattern>> patterns;
  std::vector<std::uint32_t> back_states{};  ///< seen from the inner side; empty: `states`
  /// Maps of temperatures of `back_states`; empty: `temperatures`.
  std::vector<std::shared_ptr<const materials::TemperatureMap>> back_temperatures{};
  std::shared_ptr<const SurfaceCutOut>
      cut_out{};  ///< where it is not there, from either side; null: no holes
  friend bool operator==(const SurfaceAssignment&, const SurfaceAssignment&) = default;

  bool mixes_materials() const;  ///< by one of its patterns
  bool bends_normals() const;    ///< by one of its patterns
  const materials::TemperatureMap* temperature_map(std::size_t index, bool inner) const;  ///< null: none
  std::vector<const materials::NumberedMap*> maps() const;  ///< all, once, in the order given; holes count
};

/// The immutable assembly of geometry, materials and light. Answers "what is at this point" and "what lights it"; knows nothing of sensors.
struct Scene {
  Scene();
  Scene(Scene&&) noexcept;
  explicit Scene(const Scene&);  ///< of the same worlds and maps, to be lit otherwise
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  std::shared_ptr<const geometry::World> world;     ///< scenes of several times may share one
  std::shared_ptr<const geometry::World> departed;  ///< what is there before the picture alone; null: nothing
  std::vector<materials::Material> materials;
  std::vector<SurfaceState> states;
  std::vector<SurfaceAssignment> assignments;
  std::vector<Lamp> lamps;
  std::vector<std::shared_ptr<const SolvedTemperature>> solved;  ///< null where no state has it
  std::optional<Sun> sun;
  Sky sky;
  /// An open, level plain of this state, met by rays that leave below the horizon.
  SurfaceState surroundings;
  ViewPath view_path;

  /// `draw`, `share`: by whose chance solved temperatures are estimated, and for how much light (SolvedTemperature::at).
  ResolvedSurface resolve(const geometry::SurfacePoint& at, std::uint64_t draw = 0, double share = 2.0) const;
  /// The same where nobody asks for temperatures: solved ones, which take rays, are not there.
  ResolvedSurface resolve_without_temperature(const geometry::SurfacePoint& point) const;
  /// By surface assignment: whether any of its materials is a mirror. Empty where none is.
  std::vector<bool> mirror_assignments() const;
  /// The same of materials whose lobe is narrow (has_narrow_lobe).
  std::vector<bool> lobe_assignments() const;

  /// All temperatures at which anything of the scene may emit: states, maps, patterns, surroundings and sky; none
  /// where nothing does. Whoever needs to know asks here (scene_temperatures.cpp), so that nothing is forgotten.
  std::optional<TemperatureRange> temperatures() const;
  bool all_emit() const;  ///< every surface, what lies around the scene included
  /// Of those the ones that differ from point to point: solved ones, of maps and of patterns.
  std::optional<TemperatureRange> mapped_temperatures() const;
  /// The lamp of a state; null: none.
  const Lamp* lamp_of(std::uint32_t state) const;
  /// Whether a state emits somewhere: as a lamp, by its own temperature, or by that of a map or pattern on some surface assignment.
  bool emits(std::uint32_t state) const;

 private:
  ResolvedSurface resolve_own(const geometry::SurfacePoint& point) const;
  void solve(const geometry::SurfacePoint& at, std::uint64_t draw, double share, ResolvedSurface& of) const;
};

/// The materials that truth tells apart: all but those that are further curves of another (Material::curve_of), which count as that one.
struct TruthMaterials {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_material;  ///< index into `names`, by index into Scene::materials
};
TruthMaterials truth_materials(const Scene& scene);

}  // namespace ifov::scene
