#include "io/run_state/kept_run.h"

#include <json/json.h>

#include "core/error.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io {

std::filesystem::path kept_folder(const std::filesystem::path& folder) { return folder / "run.kept"; }

RunPlan read_kept_plan(const std::filesystem::path& folder) {
  return read_plan(kept_folder(folder) / "state.json");
}

KeptTiles::KeptTiles(const std::filesystem::path& folder, const RunPlan& plan, LogSink* log) : index_(plan), log_(log) {
  for (const auto& pack : packs_in(kept_folder(folder) / "tiles")) index_.add(pack);
}

bool KeptTiles::read(std::size_t index, sampling::TileResult& tile) {
  if (index_.read(index, {}, tile).empty() && !tile.memory.empty()) return true;
  if (log_ != nullptr)
    log_->warn(
        format("tile {} of the kept run is damaged or missing: it is rendered from the beginning", index));
  return false;
}

bool differ_in_error_alone(const std::string& one, const std::string& other) {
  const auto without_error = [](const std::string& text) {
    Json::Value root;
    std::string errors;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    if (!reader->parse(text.data(), text.data() + text.size(), &root, &errors) || !root.isObject())
      throw EnvironmentError("the document of a kept run cannot be read");
    Json::Value& sampling = root["sampling"];
    if (sampling.isObject() && sampling["accuracy"].isObject()) sampling["accuracy"].removeMember("error");
    return root;
  };
  return without_error(one) == without_error(other);
}

}  // namespace ifov::io
