#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/run_control.h"
#include "session/assembly/shared/colour_guess.h"

namespace ifov::io {
struct DocumentSources;
struct FileMaterial;
struct FileMaterials;
struct MeshMaterials;
struct Picture;
}  // namespace ifov::io
namespace ifov::materials {
class ClassMap;
class ColourImage;
struct MapGrid;
class OpacityMap;
}  // namespace ifov::materials
namespace ifov::radiometry {
class Spectrum;
}
namespace ifov::scene {
class Pattern;
struct Scene;
}  // namespace ifov::scene

namespace ifov::session {

/// A slot of a mesh file that is made of what the file says.
struct MeshSlot {
  std::string file;            ///< the mesh's
  std::string name;            ///< as in the file
  std::size_t without_uv = 0;  ///< triangles of the slot without texture coordinates
};

/// Makes reflectances, patterns and maps of classes of the colours in mesh files. Each file is read once, each picture kept once.
/// Keeps all references; `log` may be null.
class FileColours {
 public:
  FileColours(const io::DocumentSources& sources, scene::Scene& scene, LogSink* log);
  ~FileColours();

  /// A material whose reflectance is made of colours, at a fixed temperature or (0) without.
  struct Surface {
    std::uint32_t state = 0;
    std::shared_ptr<const scene::Pattern> pattern;  ///< null: one colour
  };
  Surface upsampled(const io::FileMaterials& source, const MeshSlot& slot, double fixed_k, bool mapped_k);

  /// Which of the colours of `source` stands where. Says how far the colours are from those of the file.
  std::shared_ptr<const materials::ClassMap> classes(const io::FileMaterials& source, const MeshSlot& slot);

  /// Where the file says that the slot is not there; null: it has no holes. What is transparent in part counts as a hole where
  /// more than half of the light comes through.
  std::shared_ptr<const materials::OpacityMap> holes(const MeshSlot& slot);

  const std::vector<ColourGuess>& guesses() const { return guesses_; }

 private:
  const io::MeshMaterials& file(const std::string& path);
  const io::FileMaterial& material(const MeshSlot& slot);
  std::shared_ptr<const materials::ColourImage> image(const io::FileMaterial& material);
  std::uint32_t add_material(const std::string& name, const std::array<double, 3>& colour,
                             const radiometry::Spectrum* beyond, std::optional<std::uint32_t> curve_of,
                             double fixed_k);
  ColourGuess& guess_of(const io::FileMaterials& source, const MeshSlot& slot);
  void note(const io::FileMaterials& source, const MeshSlot& slot, bool emits);
  void say(const MeshSlot& slot, const io::FileMaterial& material, const std::string& more);

  const io::DocumentSources& sources_;
  scene::Scene& scene_;
  LogSink* log_;
  std::map<std::string, std::unique_ptr<const io::MeshMaterials>> files_;
  std::map<std::tuple<const io::Picture*, int, int>, std::shared_ptr<const materials::ColourImage>> images_;
  std::map<std::string, Surface> surfaces_;
  std::map<std::string, std::shared_ptr<const materials::ClassMap>> classes_;
  std::map<std::string, std::shared_ptr<const materials::OpacityMap>> holes_;
  std::map<const io::FileMaterials*, std::shared_ptr<const radiometry::Spectrum>> beyond_;
  std::vector<std::string> said_;
  std::vector<ColourGuess> guesses_;
};

}  // namespace ifov::session
