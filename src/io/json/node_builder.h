#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/json/json_adapter.h"

namespace ifov::io {

/// Makes nodes that know their place of the values of a text, in the order in which they stand there; throws InputError
/// where the rules are broken.
class NodeBuilder {
 public:
  NodeBuilder(const DocumentSource& source, const JsonRules& rules) : source_(source), rules_(rules) {}

  void null(std::size_t offset) { add(Type::null, offset); }
  void boolean(std::size_t offset, bool value) { add(Type::boolean, offset).boolean_ = value; }
  void number(std::size_t offset, std::string_view digits);
  void text(std::size_t offset, std::string_view value) { add(Type::text, offset).text_ = value; }
  void key(std::size_t offset, std::string_view name);
  void begin(std::size_t offset, bool is_list);
  void end();  ///< of the list or object that began last

  /// After the last value.
  std::unique_ptr<const DocumentNode> root();

  /// "the list 'a.b[3]' that begins at 1:20; still to close: ]]}"; empty where nothing is open. `closing`: what has to be
  /// closed before.
  std::string still_open(std::string closing = {}) const;

  std::string position_text(std::size_t offset) const;  ///< "line:column"
  [[noreturn]] void fail(std::size_t offset, std::string_view message) const;

 private:
  using Type = DocumentNode::Type;

  DocumentNode& add(Type type, std::size_t offset);
  void count(std::size_t offset);
  void require_unique(const std::vector<DocumentNode>& members) const;
  bool is_list(std::size_t node) const { return nodes_[node].type_ == Type::list; }

  const DocumentSource& source_;
  const JsonRules& rules_;
  std::size_t values_ = 0, key_offset_ = 0;
  std::string key_;                  ///< of the value that comes next, in an object
  std::vector<DocumentNode> nodes_;  ///< each list or object that is open, and behind it what it holds so far
  std::vector<std::size_t> open_;    ///< of nodes_, the outermost first
};

}  // namespace ifov::io
