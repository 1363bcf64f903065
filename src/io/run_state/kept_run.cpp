#include "io/run_state/kept_run.h"

#include <algorithm>

#include "core/error.h"
#include "io/json/json_adapter.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_packs.h"

namespace ifov::io {

std::filesystem::path kept_folder(const std::filesystem::path& folder) { return folder / "run.kept"; }

RunPlan read_kept_plan(const std::filesystem::path& folder) {
  return read_plan(kept_folder(folder) / "state.json");
}

KeptTiles::KeptTiles(const std::filesystem::path& folder, const RunPlan& plan, LogSink* log)
    : index_(plan), log_(log) {
  for (const auto& pack : packs_in(kept_folder(folder) / "tiles")) index_.add(pack);
}

bool KeptTiles::read(std::size_t index, sampling::TileResult& tile) {
  if (index_.read(index, {}, tile).empty() && !tile.memory.empty()) return true;
  if (log_ != nullptr)
    log_->warn(
        format("tile {} of the kept run is damaged or missing: it is rendered from the beginning", index));
  return false;
}

namespace {

using Type = DocumentNode::Type;

DocumentTree document_of(const std::string& text) {
  JsonRules rules;
  rules.max_bytes = rules.max_values = text.size();
  try {
    DocumentTree tree = parse_json(text, "", rules);
    if (tree.root->type() == Type::object) return tree;
  } catch (const InputError&) {
  }
  throw SystemError("the document of a kept run cannot be read");
}

bool counts(const DocumentNode& member) {
  return member.key() != "error" || member.path() != "sampling.accuracy.error";
}

/// Members may stand in any order.
bool alike(const DocumentNode& one, const DocumentNode& other) {
  if (one.type() != other.type()) return false;
  switch (one.type()) {
    case Type::null: return true;
    case Type::boolean: return one.boolean() == other.boolean();
    case Type::number:
      if (one.is_integer() && other.is_integer()) return one.integer() == other.integer();
      return one.is_integer() == other.is_integer() && one.number() == other.number();
    case Type::text: return one.text() == other.text();
    case Type::list:
      return std::equal(one.items().begin(), one.items().end(), other.items().begin(), other.items().end(),
                        alike);
    case Type::object: break;
  }
  const auto count = [](const DocumentNode& node) {
    return std::count_if(node.members().begin(), node.members().end(), counts);
  };
  return count(one) == count(other) &&
         std::all_of(one.members().begin(), one.members().end(), [&](const DocumentNode& member) {
           const DocumentNode* same = other.find(member.key());
           return !counts(member) || (same != nullptr && alike(member, *same));
         });
}

}  // namespace

bool differ_in_error_alone(const std::string& one, const std::string& other) {
  return alike(*document_of(one).root, *document_of(other).root);
}

}  // namespace ifov::io
