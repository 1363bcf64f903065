#include "io/run_state/scene_files.h"

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "io/files/input_file.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"

namespace ifov::io {
namespace {

/// Names of the buffers beside a .gltf file; whether it is right is for its reader to say.
std::vector<std::filesystem::path> buffers_of(const std::filesystem::path& gltf) {
  std::vector<std::filesystem::path> buffers;
  const std::string text = read_input(gltf);
  JsonRules rules;
  rules.max_bytes = rules.max_values = text.size();
  try {
    const DocumentTree tree = parse_json(text, gltf.string(), rules);
    for (const JsonView& buffer : JsonView(tree)["buffers"].items()) {
      const std::string uri = buffer["uri"].text("data:");
      if (!uri.starts_with("data:")) buffers.push_back(gltf.parent_path() / uri);
    }
  } catch (const InputError&) {
  }
  return buffers;
}

std::vector<std::filesystem::path> companions_of(const std::filesystem::path& file) {
  if (file.extension() == ".gltf") return buffers_of(file);
  std::vector<std::filesystem::path> companions{file.string() + ".aux.xml", file.string() + ".hdr"};
  for (const char* extension : {".aux.xml", ".hdr", ".prj", ".tfw", ".wld", ".img", ".bil", ".flt", ".sdat"})
    companions.push_back(std::filesystem::path(file).replace_extension(extension));
  return companions;
}

}  // namespace

std::vector<FileStamp> stamp_scene_files(const std::vector<std::string>& named,
                                         const std::filesystem::path& folder,
                                         std::span<const FileStamp> known) {
  std::vector<std::filesystem::path> files;
  for (const std::string& file : named) {
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
  std::sort(stamps.begin(), stamps.end(),
            [](const FileStamp& a, const FileStamp& b) { return a.path < b.path; });
  return stamps;
}

}  // namespace ifov::io
