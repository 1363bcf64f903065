#include "io/json/json_view.h"

namespace ifov::io {

JsonView JsonView::operator[](std::string_view key) const {
  return JsonView(is(DocumentNode::Type::object) ? node_->find(key) : nullptr);
}

std::vector<JsonView> JsonView::items() const {
  std::vector<JsonView> all;
  if (!is(DocumentNode::Type::list)) return all;
  for (const DocumentNode& item : node_->items()) all.emplace_back(&item);
  return all;
}

std::string JsonView::text(std::string_view otherwise) const {
  return is(DocumentNode::Type::text) ? node_->text() : std::string(otherwise);
}

}  // namespace ifov::io
