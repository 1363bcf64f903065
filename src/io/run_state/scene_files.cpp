#include "io/run_state/scene_files.h"

#include <algorithm>

#include "core/parallel.h"
#include "io/files/inputs.h"
#include "io/mesh/mesh_format.h"
#include "io/mesh/mesh_materials.h"

namespace ifov::io {
namespace {

std::vector<std::filesystem::path> companions_of(const std::filesystem::path& file) {
  if (const MeshFormat* mesh = mesh_format_of(file); mesh != nullptr) {
    std::vector<std::filesystem::path> companions = mesh_material_files(file);
    if (mesh->further_files != nullptr)
      for (auto& further : mesh->further_files(file)) companions.push_back(std::move(further));
    return companions;
  }
  std::vector<std::filesystem::path> companions{file.string() + ".aux.xml", file.string() + ".hdr"};
  for (const char* extension : {".aux.xml", ".hdr", ".prj", ".tfw", ".wld", ".img", ".bil", ".flt", ".sdat"})
    companions.push_back(std::filesystem::path(file).replace_extension(extension));
  return companions;
}

void stamp_asset(const std::string& name, std::vector<FileStamp>& stamps) {
  const Assets* const all = current_inputs().assets.get();
  const Assets::Asset* const asset = all != nullptr ? all->find(name) : nullptr;
  const bool known =
      std::any_of(stamps.begin(), stamps.end(), [&](const FileStamp& s) { return s.path == name; });
  if (asset != nullptr && !known) stamps.push_back({name, asset->bytes, 0, asset->hash});
}

}  // namespace

std::vector<FileStamp> stamp_scene_files(const std::vector<std::string>& named,
                                         const std::filesystem::path& folder,
                                         std::span<const FileStamp> known) {
  std::vector<std::filesystem::path> files;
  std::vector<FileStamp> assets;
  for (const std::string& file : named) {
    if (is_asset_name(file)) {
      stamp_asset(file, assets);
      if (input_exists(file))
        for (const auto& companion : companions_of(file)) stamp_asset(companion.string(), assets);
      continue;
    }
    files.emplace_back(file);
    std::error_code ignored;
    for (const auto& companion : companions_of(file))
      if (std::filesystem::is_regular_file(companion, ignored)) files.push_back(companion);
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  std::vector<FileStamp> stamps(files.size());
  parallel_for(static_cast<std::int64_t>(files.size()), 0, [&](std::int64_t k) {
    stamps[static_cast<std::size_t>(k)] = stamp_of(files[static_cast<std::size_t>(k)], folder, known);
  });
  stamps.insert(stamps.end(), assets.begin(), assets.end());
  std::sort(stamps.begin(), stamps.end(),
            [](const FileStamp& a, const FileStamp& b) { return a.path < b.path; });
  return stamps;
}

}  // namespace ifov::io
