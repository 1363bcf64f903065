#include "studies/common/suburb_scene.h"

#include <filesystem>

#include "io/document/document.h"
#include "landscape/landscapes.h"

namespace ifov::studies {

namespace {

constexpr double kSize_m = 200.0, kQuickSize_m = 60.0;
constexpr std::uint64_t kSeed = 7;
constexpr const char* kDocument = "render_vswir.json";

}  // namespace

io::Document suburb_document(const StudyOptions& options, bool quick) {
  // Files are called by whole names: studies write documents elsewhere that are made of this one.
  if (!options.scene.empty()) return io::read_document(std::filesystem::absolute(options.scene).string());
  landscape::MakeOptions scene;
  scene.folder = std::filesystem::absolute(options.output_folder / "scene");
  scene.size_m = quick ? kQuickSize_m : kSize_m;
  scene.seed = kSeed;
  scene.replace = true;
  landscape::make_suburb(scene);
  return io::read_document((scene.folder / kDocument).string());
}

}  // namespace ifov::studies
