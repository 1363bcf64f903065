#include "session/runs/run_record_file.h"

#include "core/error.h"
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

}  // namespace ifov::session
