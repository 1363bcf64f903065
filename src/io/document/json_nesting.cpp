#include "io/document/json_nesting.h"

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLongestKey = 60;  ///< of a key that is shown

}  // namespace

void JsonNesting::begin(std::size_t offset, bool is_list, std::string_view key) {
  open_.push_back({offset, is_list, key});
}

void JsonNesting::end() {
  if (!open_.empty()) open_.pop_back();
}

void JsonNesting::next_item() {
  if (!open_.empty()) ++open_.back().items;
}

std::string JsonNesting::still_open(std::string closing) const {
  if (open_.empty()) return {};
  std::string path;
  for (std::size_t k = 1; k < open_.size(); ++k)
    path += open_[k - 1].is_list ? format("[{}]", open_[k - 1].items)
                                 : format(".{}", open_[k].key.substr(0, kLongestKey));
  if (path.starts_with('.')) path.erase(0, 1);
  for (auto open = open_.rbegin(); open != open_.rend(); ++open) closing += open->is_list ? ']' : '}';
  return format("the {}{} that begins at {}; still to close: {}", open_.back().is_list ? "list" : "object",
                path.empty() ? "" : format(" '{}'", path), place(open_.back().offset), closing);
}

std::string JsonNesting::place(std::size_t offset) const {
  const SourcePosition position = source_.position(offset);
  return format("{}:{}", position.line, position.column);
}

}  // namespace ifov::io
