#include "cli/run_record_file.h"

#include "core/error.h"
#include "io/document/json_adapter.h"
#include "io/files/input_file.h"

namespace ifov::cli {
namespace {

using Type = io::DocumentNode::Type;

io::DocumentTree parsed(const std::filesystem::path& path) {
  io::JsonRules rules;
  rules.comments = false;
  return io::parse_json(io::read_input(path), path.string(), rules);
}

}  // namespace

Record Record::operator[](const std::string& key) const {
  return Record(node_ != nullptr && node_->type() == Type::object ? node_->find(key) : nullptr);
}

std::string Record::text() const { return node_ != nullptr && node_->type() == Type::text ? node_->text() : "?"; }

std::vector<Record> Record::items() const {
  std::vector<Record> all;
  if (node_ == nullptr || node_->type() != Type::list) return all;
  for (const io::DocumentNode& item : node_->items()) all.emplace_back(&item);
  return all;
}

RunRecordFile::RunRecordFile(const std::filesystem::path& path) : tree_(parsed(path)) {
  if (root()["program"]["name"].text() == "ifov") return;
  throw InputError(
      format("{}: this is not the record of a run (it has no \"program\": {{\"name\": \"ifov\"}})", path.string()),
      {path.string(), 0, 0});
}

}  // namespace ifov::cli
