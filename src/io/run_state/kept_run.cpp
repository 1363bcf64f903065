#include "io/run_state/kept_run.h"

#include <json/json.h>

#include <cstring>
#include <fstream>
#include <span>

#include "core/error.h"
#include "io/run_state/tile_packs.h"
#include "io/run_state/tile_record.h"

namespace ifov::io {

std::filesystem::path kept_folder(const std::filesystem::path& folder) { return folder / "run.kept"; }

RunPlan read_kept_plan(const std::filesystem::path& folder) {
  return read_plan(kept_folder(folder) / "state.json");
}

KeptTiles::KeptTiles(const std::filesystem::path& folder, const RunPlan& plan, LogSink* log)
    : run_(plan.key()),
      columns_(static_cast<int>(plan.image.channels.size())),
      grid_(plan.grid()),
      packs_(packs_in(kept_folder(folder) / "tiles")),
      places_(grid_.size()),
      log_(log) {
  for (std::size_t pack = 0; pack < packs_.size(); ++pack) {
    std::uint64_t offset = 0;
    read_headers(packs_[pack], {run_, columns_, grid_}, [&](const TileHeader& header) {
      places_[header.index] = {pack, offset, header.record_bytes()};
      offset += header.record_bytes();
    });
  }
}

bool KeptTiles::read(std::size_t index, sampling::TileResult& tile) {
  const Place& place = places_[index];
  if (place.bytes >= sizeof(TileHeader)) {
    std::vector<std::byte> record(place.bytes);
    std::ifstream file(packs_[place.pack], std::ios::binary);
    file.seekg(static_cast<std::streamoff>(place.offset));
    file.read(reinterpret_cast<char*>(record.data()), static_cast<std::streamsize>(record.size()));
    TileHeader header;
    std::memcpy(&header, record.data(), sizeof header);
    if (file && fault_of(header, {run_, columns_, grid_}).empty() && header.index == index &&
        decode_tile(header, std::span<const std::byte>(record).subspan(sizeof header), tile) &&
        !tile.memory.empty())
      return true;
  }
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
