#include "io/json/node.h"

#include <algorithm>
#include <stdexcept>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLongestShown = 60;

std::string shortened(std::string_view text) {
  if (text.size() <= kLongestShown) return std::string(text);
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return format("{}...", text.substr(0, end));
}

void require(bool right_type) {
  if (!right_type) throw std::logic_error("a document value was read as another type than it has");
}

}  // namespace

std::string DocumentNode::path() const {
  if (parent_ == nullptr) return {};
  const std::string before = parent_->path();
  if (parent_->type_ == Type::list) return format("{}[{}]", before, index_);
  return before.empty() ? key_ : format("{}.{}", before, key_);
}

bool DocumentNode::boolean() const {
  require(type_ == Type::boolean);
  return boolean_;
}

double DocumentNode::number() const {
  require(type_ == Type::number);
  return number_;
}

std::int64_t DocumentNode::integer() const {
  require(is_integer_);
  return integer_;
}

const std::string& DocumentNode::text() const {
  require(type_ == Type::text);
  return text_;
}

const std::vector<DocumentNode>& DocumentNode::items() const {
  require(type_ == Type::list);
  for (const DocumentNode& item : children_) item.read_ = true;
  return children_;
}

const std::vector<DocumentNode>& DocumentNode::members() const {
  require(type_ == Type::object);
  return children_;
}

const DocumentNode* DocumentNode::find(std::string_view key) const {
  require(type_ == Type::object);
  const auto found = std::find_if(children_.begin(), children_.end(),
                                  [&](const DocumentNode& m) { return m.name() == key; });
  if (found == children_.end()) return nullptr;
  found->read_ = true;
  return &*found;
}

void DocumentNode::take_former_name(std::string_view former, std::string_view name) const {
  require(type_ == Type::object);
  const auto written = [&](std::string_view key) {
    return std::find_if(children_.begin(), children_.end(),
                        [&](const DocumentNode& m) { return m.key_ == key; });
  };
  const auto found = written(former);
  if (found == children_.end()) return;
  if (written(name) != children_.end())
    found->fail_at_key(format("'{}' is the former name of '{}', which is there too", former, name));
  found->present_name_ = name;
}

const DocumentNode& DocumentNode::given(std::string_view key) const {
  const DocumentNode* member = find(key);
  return member != nullptr ? *member : *this;
}

std::string DocumentNode::found() const {
  switch (type_) {
    case Type::null: return "null";
    case Type::boolean: return boolean_ ? "true" : "false";
    case Type::number:
      return is_integer_ ? format("the number {}", integer_) : format("the number {}", number_);
    case Type::text: return format("the text \"{}\"", shortened(text_));
    case Type::list: return children_.empty() ? "an empty list" : format("a list of {}", children_.size());
    case Type::object: return children_.empty() ? "an empty object" : "an object";
  }
  throw std::logic_error("unknown type of document value");
}

std::string DocumentNode::title() const {
  return parent_ == nullptr ? "the document" : format("'{}'", shortened(path()));
}

void DocumentNode::fail(std::string_view message) const { throw source_->error(position(), message); }

void DocumentNode::fail_at_key(std::string_view message) const {
  throw source_->error(key_position(), message);
}

void DocumentNode::fail_expected(std::string_view expected) const {
  fail(format("{} is {}, expected {}", title(), found(), expected));
}

void reject_unread(const DocumentNode& root) {
  const bool object = root.type() == DocumentNode::Type::object;
  if (!object && root.type() != DocumentNode::Type::list) return;
  for (const DocumentNode& child : object ? root.members() : root.items()) {
    if (!child.was_read()) child.fail_at_key(format("{} is not used", child.title()));
    reject_unread(child);
  }
}

}  // namespace ifov::io
