#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "landscape/output/scene_folder.h"
#include "landscape/shapes/plane.h"
#include "math/vec3.h"

namespace ifov::landscape {

/// A document that includes the scene's: what looks at it, and how.
struct View {
  std::string file;                      ///< such as "render_vswir.json"
  std::string purpose;                   ///< a comment at its top; lines without "//"
  std::string sensor, sampling, output;  ///< JSON
};

/// What shines on the scene, and through what air.
struct SceneLight {
  std::string light, atmosphere;  ///< JSON
};

/// The scene's part of a document, collected piece by piece, as JSON with comments.
class SceneText {
 public:
  /// The folder takes the maps of textured materials.
  explicit SceneText(SceneFolder& folder) : folder_(folder) {}

  /// Materials come from the table of materials, in the order in which they are first named. Returns the name in
  /// quotes.
  std::string material(const std::string& name);
  /// "{"slots": {"roof": "tile, red", ...}}" for pairs of slot and material.
  std::string slots(const std::vector<std::pair<std::string, std::string>>& materials);

  void prototype(const std::string& name, const std::vector<std::string>& objects);
  void object(const std::string& json) { objects_.push_back(json); }
  /// Above the next object.
  void heading(const std::string& comment) { objects_.push_back("// " + comment); }

  /// The document that all views include: the scene, and what lights it.
  std::string document(std::string_view title, const SceneLight& light) const;
  std::size_t material_count() const { return materials_.size(); }

 private:
  SceneFolder& folder_;
  std::vector<std::string> materials_, prototypes_, objects_;
  std::set<std::string> known_;
};

inline constexpr const char* kSceneFile = "scene.json";

/// A view's document, which includes kSceneFile.
std::string view_text(const View& view, std::string_view title);

/// "12.5 m"
std::string metres(double value_m);
std::string point_text(double x_m, double y_m, double z_m);
std::string mesh_text(const std::string& file);
/// `"transform": {...}` that puts an object with its x along the stand's.
std::string transform_text(const Stand& stand, double z_m);

}  // namespace ifov::landscape
