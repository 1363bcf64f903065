#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/document/scene_document.h"
#include "landscape/output/scene_folder.h"
#include "landscape/shapes/plane.h"
#include "math/vec3.h"

namespace ifov::io {
struct AtmosphereDocument;
struct LightDocument;
}  // namespace ifov::io

namespace ifov::landscape {

/// The scene's part of a document, collected piece by piece.
class SceneMaker {
 public:
  /// The folder takes the maps of textured materials.
  explicit SceneMaker(SceneFolder& folder) : folder_(folder) {}

  /// Materials come from the table of materials, in the order in which they are first named. Returns the name.
  io::DocumentName material(const std::string& name);
  io::MaterialBinding only(const std::string& material_name) { return {material(material_name), {}}; }
  /// Materials for pairs of slot and material.
  io::MaterialBinding slots(const std::vector<std::pair<std::string, std::string>>& materials);
  /// Materials by the numbers, from 1 on, of a map that lies on a square from -half to half.
  io::MaterialBinding classes(const std::string& map_file, double half_m,
                              const std::vector<std::string>& materials);

  void prototype(const std::string& name, std::vector<io::ObjectDocument> objects);
  void object(io::ObjectDocument object) { scene_.objects.push_back(std::move(object)); }

  /// The document that all views include: the scene, and what lights it.
  std::string document(std::string_view title, const io::LightDocument& light,
                       const io::AtmosphereDocument& atmosphere) const;
  std::size_t material_count() const { return scene_.materials.size(); }

 private:
  SceneFolder& folder_;
  io::SceneDocument scene_;
};

inline constexpr const char* kSceneFile = "scene.json";

/// As documents state lengths here.
double to_millimetre(double value_m);
math::Point3 to_millimetre(math::Point3 point_m);

/// A mesh of the folder, with no name where that is empty.
io::ObjectDocument mesh_object(const std::string& name, const std::string& file,
                               io::MaterialBinding material);
/// The object with its origin at a point.
io::ObjectDocument moved(io::ObjectDocument object, math::Point3 to_m);
/// The object with its x along the stand's.
io::ObjectDocument standing(io::ObjectDocument object, const Stand& stand, double z_m);

}  // namespace ifov::landscape
