#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/run_control.h"
#include "io/document/scene_document.h"
#include "session/assembly/shared/map_scale.h"
#include "session/assembly/shared/raster_assembly.h"
#include "session/assembly/surfaces/file_colours.h"
#include "session/assembly/surfaces/scattering_assembly.h"
#include "session/assembly/surfaces/texture_assembly.h"

namespace ifov::geometry {
class CutOut;
}
namespace ifov::io {
struct DocumentSources;
}
namespace ifov::materials {
class ClassMap;
class MixtureMap;
class OpacityMap;
class TemperatureMap;
}  // namespace ifov::materials
namespace ifov::scene {
class Pattern;
struct Scene;
struct SurfaceAssignment;
class SurfaceCutOut;
struct SurfaceState;
}  // namespace ifov::scene

namespace ifov::session {

/// Turns the materials, maps and temperatures of a document into the scene's materials, states and surface assignments. Each
/// file is read once, each map made once.
class AssignmentAssembly {
 public:
  /// Reads all materials into the scene: those of the document in its order, then the further curves of textured ones.
  /// Keeps all references; `seed` as of TextureAssembly; `log` may be null.
  AssignmentAssembly(const io::DocumentSources& sources, const std::vector<io::MaterialDocument>& materials,
                     std::uint64_t seed, const MapFrame& frame, scene::Scene& scene, LogSink* log);

  /// Index of the surface assignment for a binding on one slot of an object (`slot_name` as in a mesh file, else empty);
  /// `temperature` replaces the materials' own; `mesh_slot` of a mesh whose materials are those of its file.
  std::uint32_t assignment(const io::MaterialBinding& binding, const std::string& slot_name,
                           const std::optional<io::TemperatureDocument>& temperature,
                           const MeshSlot& mesh_slot = {});

  /// Of a surface of one state, without maps.
  std::uint32_t assignment(scene::SurfaceState surface);

  std::size_t count() const;  ///< of surface assignments made so far

  /// By surface assignment made so far: whether any of its materials is a mirror; empty where none is.
  std::vector<bool> mirrors() const;
  std::vector<bool> lobes() const;
  std::vector<std::shared_ptr<const geometry::CutOut>> cut_outs() const;
  /// Whether light is refracted into what some material covers.
  bool any_medium() const;
  /// Throws where a binding has a material that light is refracted into: for objects without an inside.
  void refuse_media(const io::MaterialBinding& binding) const;
  /// Throws where a binding has a material with holes: for shapes that are not made of triangles, or (`by_place`) with holes by
  /// texture coordinates, for those that have none.
  void refuse_holes(const io::MaterialBinding& binding, bool by_place) const;

  /// Throws where one of these surface assignments (by index) cannot cover what moves.
  void refuse_moving(const std::vector<bool>& covers) const;

  /// How large the cells of the maps are that were made so far.
  const std::vector<MapScale>& map_scales() const { return textures_.map_scales(); }
  /// Reflectances that were made of colours.
  const std::vector<ColourGuess>& colour_guesses() const { return colours_.guesses(); }

 private:
  using Holes = std::shared_ptr<const materials::OpacityMap>;
  /// A material at its temperature.
  struct Surface {
    std::uint32_t state = 0, material = 0;
    double fixed_k = 0.0;
    std::uint32_t solved = 0;  ///< as of SurfaceState
    std::shared_ptr<const materials::TemperatureMap> temperature;
    Holes holes;                          ///< null: it has none
    std::shared_ptr<const Surface> back;  ///< of a material with two sides; null: as `behind_` says
  };
  using Pattern = std::shared_ptr<const scene::Pattern>;

  void add_materials();
  std::uint32_t material_index(const std::string& name) const;
  Surface surface_of(const io::DocumentName& material,
                     const std::optional<io::TemperatureDocument>& temperature);
  /// Of a material that has no sides of its own.
  Surface plain_surface(std::uint32_t material, const std::optional<io::TemperatureDocument>& temperature);
  /// Throws where two materials cannot be the sides of one sheet.
  void check_sides(const io::DocumentName& front_name, const io::DocumentName& back_name) const;
  /// How a surface looks from its inner side.
  Surface seen_from_behind(const Surface& surface);
  std::shared_ptr<const materials::TemperatureMap> temperature_map(const io::TemperatureMap& map);
  /// Throws where nothing tells what a surface does with heat, as of what lets light through.
  void refuse_solved(std::uint32_t material) const;
  /// Throws where a sheet whose faces are as warm as each other is made of two materials.
  void check_faces(const Surface& surface, const std::pair<io::DocumentName, io::DocumentName>& sides) const;
  std::uint32_t state(scene::SurfaceState wanted);
  /// Of a surface, or of what stands in its place, at its temperature.
  std::uint32_t state(const Surface& of, std::uint32_t material);
  std::shared_ptr<const materials::ClassMap> class_map(const io::MaterialMap& map);
  Pattern mixture(const io::MixtureDocument& source, const std::vector<Surface>& surfaces);
  std::uint32_t coloured(const io::FileMaterials& source, const MeshSlot& slot,
                         const std::optional<io::TemperatureDocument>& temperature);
  void add_patterns(scene::SurfaceAssignment& assignment, const std::vector<Surface>& surfaces);
  /// What puts levels of parameters in the place of a surface, and of its curves; empty where no map gives any.
  std::vector<Pattern> level_patterns(const Surface& surface);
  /// Throws where more constituents may stand side by side than a surface holds.
  void check_room(const io::MaterialBinding& binding, const std::vector<Surface>& surfaces) const;
  /// Those of its materials, and of the slot of a file whose colours tell which these are.
  void add_holes(scene::SurfaceAssignment& assignment, const io::MaterialBinding& binding,
                 const std::vector<Surface>& surfaces, const Holes& of_file);
  /// What has holes; null where nothing has. `holes` as of SurfaceCutOut.
  std::shared_ptr<const scene::SurfaceCutOut> cut_out(
      const std::shared_ptr<const materials::ClassMap>& classes, const std::vector<Holes>& holes);
  /// How the inner side looks of surfaces that look otherwise there.
  void add_backs(scene::SurfaceAssignment& assignment, const std::vector<Surface>& surfaces);
  /// Throws where a material that is seen otherwise from behind stands for what it cannot.
  void check_one_sided(const io::MaterialBinding& binding, const std::vector<Surface>& surfaces) const;
  bool refracts(std::uint32_t material) const;
  std::uint32_t add(scene::SurfaceAssignment assignment);

  const io::DocumentSources& sources_;
  const std::vector<io::MaterialDocument>& written_;
  scene::Scene& scene_;
  LogSink* log_;
  TextureAssembly textures_;
  ScatteringAssembly scattering_;
  FileColours colours_;
  /// By material of the document with maps of parameters: its curves before they had a model.
  std::map<std::size_t, std::vector<materials::Material>> unscattered_;
  struct Levels {
    std::vector<materials::ParameterAxis> axes;
    std::vector<std::uint32_t> first;  ///< by curve: its first member among the scene's materials
  };
  std::map<std::uint32_t, Levels> levels_;
  /// By material of the document: the first of its further curves.
  std::vector<std::uint32_t> first_further_;
  /// By material of the document: how it is seen from behind; itself where that is the same.
  std::vector<std::uint32_t> behind_;
  std::map<std::string, std::shared_ptr<const materials::TemperatureMap>> temperature_maps_;
  std::map<std::string, std::shared_ptr<const materials::ClassMap>> class_maps_;
  std::map<std::string, std::shared_ptr<const materials::MixtureMap>> mixture_maps_;
  std::map<std::string, Pattern> patterns_;
  std::map<std::string, std::shared_ptr<const scene::SurfaceCutOut>> cut_outs_;
};

}  // namespace ifov::session
