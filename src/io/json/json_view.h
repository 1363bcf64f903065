#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/node.h"

namespace ifov::io {

/// Looks through JSON, such as the record of a run, that may lack anything.
class JsonView {
 public:
  explicit JsonView(const DocumentNode* node) : node_(node) {}
  explicit JsonView(const DocumentTree& tree) : node_(tree.root.get()) {}

  JsonView operator[](std::string_view key) const;
  std::vector<JsonView> items() const;

  bool is_there() const { return node_ != nullptr && node_->type() != DocumentNode::Type::null; }
  bool is_number() const { return is(DocumentNode::Type::number); }
  /// "?" where there is none, unless it is said otherwise.
  std::string text(std::string_view otherwise = "?") const;
  /// 0 where there is none; so are the integers.
  double number() const { return is_number() ? node_->number() : 0.0; }
  std::int64_t integer() const { return is_number() && node_->is_integer() ? node_->integer() : 0; }
  int small_integer() const { return static_cast<int>(integer()); }
  std::uint64_t natural() const { return static_cast<std::uint64_t>(integer()); }
  bool boolean() const { return is(DocumentNode::Type::boolean) && node_->boolean(); }

 private:
  bool is(DocumentNode::Type type) const { return node_ != nullptr && node_->type() == type; }

  const DocumentNode* node_;
};

}  // namespace ifov::io
