#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/document/document.h"
#include "scene/scene.h"

namespace ifov::session {

/// Turns the materials, maps and temperatures of a document into the scene's materials, states and coverings. Each
/// file is read once.
class CoveringAssembly {
 public:
  /// Reads all materials into the scene. Keeps both references.
  CoveringAssembly(const io::Document& document, scene::Scene& scene);

  /// Index of the covering for a binding on one slot of an object (`slot_name` as in a mesh file, else empty);
  /// `temperature` replaces the materials' own. `draped_offset_m` is taken off the maps' coordinates.
  std::uint32_t covering(const io::MaterialBinding& binding, const std::string& slot_name,
                         const std::optional<io::TemperatureDocument>& temperature, math::Vec3 draped_offset_m);

 private:
  struct Temperature {
    double fixed_k = 0.0;
    std::shared_ptr<const materials::TemperatureMap> map;
  };
  std::uint32_t material_index(const std::string& name) const;
  Temperature temperature_of(std::uint32_t material, const std::optional<io::TemperatureDocument>& override_with,
                             math::Vec3 offset_m);
  std::uint32_t state(scene::SurfaceState wanted);
  void add_state(scene::Covering& covering, const io::DocumentName& material,
                 const std::optional<io::TemperatureDocument>& temperature, math::Vec3 offset_m);
  void add_classes(scene::Covering& covering, const io::MaterialMap& map, math::Vec3 offset_m);
  std::uint32_t add(scene::Covering covering);

  const io::Document& document_;
  scene::Scene& scene_;
  std::map<std::string, std::shared_ptr<const materials::TemperatureMap>> temperature_maps_;
  std::map<std::string, std::shared_ptr<const materials::ClassMap>> class_maps_;
};

}  // namespace ifov::session
