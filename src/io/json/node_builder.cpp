#include "io/json/node_builder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLongestKey = 60;  ///< of a key that is shown

/// Infinite where it is too large. Too small for a double is 0 or its neighbour.
double decimal(std::string_view digits) {
  double value = 0.0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return result.ec == std::errc() ? value : std::strtod(std::string(digits).c_str(), nullptr);
}

}  // namespace

void NodeBuilder::fail(std::size_t offset, std::string_view message) const {
  throw source_.error(source_.position(offset), message);
}

void NodeBuilder::count(std::size_t offset) {
  if (++values_ > rules_.max_values)
    fail(offset, format("the document has more than {} values", rules_.max_values));
}

DocumentNode& NodeBuilder::add(Type type, std::size_t offset) {
  count(offset);
  DocumentNode& node = nodes_.emplace_back(DocumentNode());
  node.source_ = &source_;
  node.type_ = type;
  node.offset_ = node.key_offset_ = offset;
  if (open_.empty()) return node;
  if (is_list(open_.back())) {
    node.index_ = nodes_.size() - open_.back() - 2;
  } else {
    node.key_ = std::move(key_);
    node.key_offset_ = key_offset_;
  }
  return node;
}

void NodeBuilder::number(std::size_t offset, std::string_view digits) {
  DocumentNode& node = add(Type::number, offset);
  const char* const end = digits.data() + digits.size();
  const auto whole = std::from_chars(digits.data(), end, node.integer_);
  node.is_integer_ = whole.ec == std::errc() && whole.ptr == end;
  node.number_ = node.is_integer_ ? static_cast<double>(node.integer_) : decimal(digits);
  if (!std::isfinite(node.number_)) fail(offset, "this number is too large");
}

void NodeBuilder::key(std::size_t offset, std::string_view name) {
  count(offset);
  key_ = name;
  key_offset_ = offset;
}

void NodeBuilder::begin(std::size_t offset, bool is_list) {
  if (open_.size() >= static_cast<std::size_t>(rules_.max_depth))
    fail(offset, format("lists and objects are nested more than {} deep", rules_.max_depth));
  add(is_list ? Type::list : Type::object, offset);
  open_.push_back(nodes_.size() - 1);
}

// A node gets its lasting place when what it stands in ends; those within it learn then where it is.
void NodeBuilder::end() {
  const std::size_t parent = open_.back();
  open_.pop_back();
  std::vector<DocumentNode>& children = nodes_[parent].children_;
  children.reserve(nodes_.size() - parent - 1);
  for (std::size_t k = parent + 1; k < nodes_.size(); ++k) {
    DocumentNode& child = children.emplace_back(std::move(nodes_[k]));
    for (DocumentNode& inner : child.children_) inner.parent_ = &child;
  }
  while (nodes_.size() > parent + 1) nodes_.pop_back();
  if (rules_.unique_keys && !is_list(parent)) require_unique(children);
}

void NodeBuilder::require_unique(const std::vector<DocumentNode>& members) const {
  std::vector<const DocumentNode*> order;
  order.reserve(members.size());
  for (const DocumentNode& member : members) order.push_back(&member);
  std::sort(order.begin(), order.end(), [](const DocumentNode* a, const DocumentNode* b) {
    const int compared = a->key_.compare(b->key_);
    return compared != 0 ? compared < 0 : a->offset_ < b->offset_;
  });
  const DocumentNode* twice = nullptr;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (order[k]->key_ == order[k - 1]->key_ && (twice == nullptr || order[k]->offset_ < twice->offset_))
      twice = order[k];
  if (twice != nullptr) fail(twice->key_offset_, format("the key '{}' is given twice", twice->key_));
}

std::unique_ptr<const DocumentNode> NodeBuilder::root() {
  auto root = std::unique_ptr<DocumentNode>(new DocumentNode(std::move(nodes_.front())));
  for (DocumentNode& child : root->children_) child.parent_ = root.get();
  root->read_ = true;
  return root;
}

std::string NodeBuilder::still_open(std::string closing) const {
  if (open_.empty()) return {};
  std::string path;
  for (std::size_t k = 1; k < open_.size(); ++k) {
    const DocumentNode& node = nodes_[open_[k]];
    path +=
        is_list(open_[k - 1]) ? format("[{}]", node.index_) : format(".{}", node.key_.substr(0, kLongestKey));
  }
  if (path.starts_with('.')) path.erase(0, 1);
  for (auto node = open_.rbegin(); node != open_.rend(); ++node) closing += is_list(*node) ? ']' : '}';
  return format("the {}{} that begins at {}; still to close: {}", is_list(open_.back()) ? "list" : "object",
                path.empty() ? "" : format(" '{}'", path), position_text(nodes_[open_.back()].offset_),
                closing);
}

std::string NodeBuilder::position_text(std::size_t offset) const {
  const SourcePosition position = source_.position(offset);
  return format("{}:{}", position.line, position.column);
}

}  // namespace ifov::io
