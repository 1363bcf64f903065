#include "io/document/json_adapter.h"

#include <json/reader.h>
#include <json/value.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/format.h"
#include "io/document/json_tokens.h"

namespace ifov::io {

/// Copies the library's values into nodes that know their place.
class NodeBuilder {
 public:
  NodeBuilder(const DocumentSource& source, const JsonTokens& tokens) : source_(source), tokens_(tokens) {}

  std::unique_ptr<const DocumentNode> build(const Json::Value& value) const {
    auto root = std::unique_ptr<DocumentNode>(new DocumentNode());
    fill(*root, value);
    root->read_ = true;
    return root;
  }

 private:
  // Children are allocated before they are filled, so that pointers to parents stay valid.
  void fill(DocumentNode& node, const Json::Value& value) const {
    node.source_ = &source_;
    node.offset_ = static_cast<std::size_t>(value.getOffsetStart());
    const auto key = tokens_.key_of_value.find(node.offset_);
    node.key_offset_ = key == tokens_.key_of_value.end() ? node.offset_ : key->second;
    switch (value.type()) {
      case Json::nullValue:
        break;
      case Json::booleanValue:
        node.type_ = DocumentNode::Type::boolean;
        node.boolean_ = value.asBool();
        break;
      case Json::intValue:
      case Json::uintValue:
      case Json::realValue:
        fill_number(node, value);
        break;
      case Json::stringValue:
        node.type_ = DocumentNode::Type::text;
        node.text_ = value.asString();
        break;
      case Json::arrayValue:
        node.type_ = DocumentNode::Type::list;
        fill_items(node, value);
        break;
      case Json::objectValue:
        node.type_ = DocumentNode::Type::object;
        fill_members(node, value);
        break;
    }
  }

  void fill_number(DocumentNode& node, const Json::Value& value) const {
    node.type_ = DocumentNode::Type::number;
    node.number_ = value.asDouble();
    if (!std::isfinite(node.number_)) {
      throw source_.error(source_.position(node.offset_), "this number is too large");
    }
    node.is_integer_ = value.type() == Json::intValue || (value.type() == Json::uintValue && value.isInt64());
    if (node.is_integer_) node.integer_ = value.asInt64();
  }

  void fill_items(DocumentNode& node, const Json::Value& value) const {
    reserve_children(node, value.size());
    for (Json::ArrayIndex i = 0; i < value.size(); ++i) {
      DocumentNode& child = node.children_[i];
      child.parent_ = &node;
      child.index_ = i;
      fill(child, value[i]);
    }
  }

  void fill_members(DocumentNode& node, const Json::Value& value) const {
    std::vector<std::pair<std::ptrdiff_t, std::string>> order;
    for (const std::string& name : value.getMemberNames()) {
      order.emplace_back(value[name].getOffsetStart(), name);
    }
    std::sort(order.begin(), order.end());
    reserve_children(node, order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      DocumentNode& child = node.children_[i];
      child.parent_ = &node;
      child.key_ = order[i].second;
      fill(child, value[child.key_]);
    }
  }

  static void reserve_children(DocumentNode& node, std::size_t count) {
    node.children_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) node.children_.push_back(DocumentNode());
  }

  const DocumentSource& source_;
  const JsonTokens& tokens_;
};

namespace {

Json::CharReaderBuilder strict_reader(const JsonRules& rules) {
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  builder["allowComments"] = rules.comments;
  builder["collectComments"] = false;
  builder["strictRoot"] = false;
  builder["allowTrailingCommas"] = false;
  builder["rejectDupKeys"] = rules.unique_keys;
  builder["skipBom"] = false;
  builder["stackLimit"] = rules.max_depth + 2;
  return builder;
}

/// The library's sentences in the words of this program's messages.
std::string plain_words(const std::string& what) {
  static const std::pair<const char*, const char*> kWords[] = {
      {"Missing ',' or ']' in array declaration", "expected ',' or ']' after a value of a list"},
      {"Missing ',' or '}' in object declaration", "expected ',' or '}' after a value of an object"},
      {"Missing '}' or object member name",
       "expected a key in double quotes or '}' (no comma may stand before a closing bracket)"},
      {"Missing ':' after object member name", "expected ':' after the key"},
      {"Syntax error: value, object or array expected",
       "expected a value (no comma may stand before a closing bracket)"},
      {"Extra non-whitespace after JSON value", "expected nothing more after the end of the document"},
  };
  for (const auto& [theirs, ours] : kWords) {
    if (what == theirs) return ours;
  }
  const std::string_view twice = "Duplicate key: ";
  if (what.starts_with(twice)) return format("the key {} is given twice", what.substr(twice.size()));
  return format("not valid JSON: {}", what);
}

/// JsonCpp reports text: "* Line 3, Column 5\n  What is wrong.\n...". The first error counts.
InputError syntax_error(const DocumentSource& source, const JsonTokens& tokens, const std::string& report) {
  std::size_t line = 1, column = 1;
  const auto number_after = [&](std::string_view word, std::size_t from, std::size_t& value) {
    const std::size_t at = report.find(word, from);
    if (at == std::string::npos) return from;
    const char* begin = report.data() + at + word.size();
    const auto result = std::from_chars(begin, report.data() + report.size(), value);
    return static_cast<std::size_t>(result.ptr - report.data());
  };
  std::size_t at = number_after("Line ", 0, line);
  at = number_after("Column ", at, column);
  const std::size_t begin = std::min(report.find_first_not_of(" \n", at), report.size());
  std::string what = report.substr(begin, std::min(report.find('\n', begin), report.size()) - begin);
  if (what.ends_with('.')) what.pop_back();
  std::size_t offset = 0;
  for (std::size_t i = 1; i < line; ++i)
    offset = std::min(source.text().find('\n', offset) + 1, source.text().size());
  offset += column - 1;
  if (offset >= tokens.end && !tokens.still_open.empty())
    return source.error(source.position(tokens.end),
                        format("the file ends here, within {}", tokens.still_open));
  return source.error(source.position(offset), plain_words(what));
}

}  // namespace

DocumentTree parse_json(std::string text, const std::string& file_name, const JsonRules& rules) {
  DocumentTree tree;
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  auto source = std::make_shared<const DocumentSource>(std::move(text), file_name);
  const JsonTokens tokens = scan_json(*source, rules);
  const std::unique_ptr<Json::CharReader> reader(strict_reader(rules).newCharReader());
  Json::Value root;
  std::string report;
  const std::string& bytes = source->text();
  try {
    if (!reader->parse(bytes.data(), bytes.data() + bytes.size(), &root, &report)) {
      throw syntax_error(*source, tokens, report);
    }
  } catch (const Json::Exception& error) {
    throw source->error({}, format("not valid JSON: {}", error.what()));
  }
  tree.root = NodeBuilder(*source, tokens).build(root);
  tree.source = std::move(source);
  return tree;
}

}  // namespace ifov::io
