#include "io/run_state/run_folder.h"

namespace ifov::io {

std::filesystem::path state_folder(const std::filesystem::path& folder) { return folder / "run.part"; }
std::filesystem::path plan_file(const std::filesystem::path& folder) {
  return state_folder(folder) / "state.json";
}

std::filesystem::path stop_file(const std::filesystem::path& folder) { return state_folder(folder) / "stop"; }

}  // namespace ifov::io
