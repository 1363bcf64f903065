#include "session/runs/run_record_file.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/names.h"
#include "io/files/input_file.h"
#include "io/json/json_adapter.h"

namespace ifov::session {
namespace {

io::DocumentTree parsed(const std::filesystem::path& path) {
  io::JsonRules rules;
  rules.comments = false;
  return io::parse_json(io::read_input(path), path.string(), rules);
}

}  // namespace

RunRecordFile::RunRecordFile(const std::filesystem::path& path) : tree_(parsed(path)) {
  if (root()["program"]["name"].text() == "ifov") return;
  throw InputError(
      format("{}: this is not the record of a run (it has no \"program\": {{\"name\": \"ifov\"}})",
             path.string()),
      {path.string(), 0, 0});
}

std::string where_runs_are(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& inner : std::filesystem::directory_iterator(folder, ignored)) {
    if (!inner.is_directory(ignored)) continue;
    for (const auto& file : std::filesystem::directory_iterator(inner.path(), ignored))
      if (file.path().filename().string().ends_with("_run.json")) {
        names.push_back(inner.path().filename().string());
        break;
      }
  }
  if (names.empty()) return {};
  std::sort(names.begin(), names.end());
  return format("; its folder{} {} hold{} {}", names.size() == 1 ? "" : "s", list_names(names, "and"),
                names.size() == 1 ? "s" : "", names.size() == 1 ? "a run" : "runs");
}

}  // namespace ifov::session
