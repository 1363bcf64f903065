#include "io/document/named_files.h"

#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "io/document/json_text.h"
#include "io/document/kind.h"
#include "io/document/record_walk.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;
using Type = DocumentNode::Type;
using FileNames = std::map<const DocumentNode*, std::string>;

void visit(const DocumentNode& node, const ValueDescription& description, FileNames& names) {
  static const std::string file_kind = file().description->short_name;
  for (const ValueDescriptionPtr& one : description.alternatives) visit(node, *one, names);
  if (description.form == Form::text && node.type() == Type::text && description.short_name == file_kind)
    names[&node] = node.source().resolve(node.text());
  if (description.form == Form::list && node.type() == Type::list)
    for (const DocumentNode& item : node.items()) visit(item, *description.items, names);
  if (node.type() != Type::object) return;
  if (description.form == Form::map)
    for (const DocumentNode& member : node.members()) visit(member, *description.items, names);
  if (description.form == Form::record)
    for (const FieldDescription& field : description.fields)
      if (const DocumentNode* member = node.find(field.key)) visit(*member, *field.value, names);
}

bool is_file(const std::string& name) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(name, ignored);
}

class Writer {
 public:
  Writer(const FileNames& names, const std::string& file_name)
      : names_(names), folder_(std::filesystem::path(file_name).parent_path()) {}

  std::string text(const DocumentNode& node) const {
    switch (node.type()) {
      case Type::null:
        return "null";
      case Type::boolean:
        return node.boolean() ? "true" : "false";
      case Type::number:
        return node.is_integer() ? format("{}", node.integer()) : json_number(node.number());
      case Type::text:
        return json_string(name_of(node));
      case Type::list: {
        std::vector<std::string> items;
        for (const DocumentNode& item : node.items()) items.push_back(text(item));
        return json_list(items);
      }
      case Type::object: {
        JsonMembers members;
        for (const DocumentNode& member : node.members()) members.emplace_back(member.key(), text(member));
        return json_object(members);
      }
    }
    return {};
  }

 private:
  std::string name_of(const DocumentNode& node) const {
    const auto found = names_.find(&node);
    if (found == names_.end() || std::filesystem::path(node.text()).is_absolute() || !is_file(found->second))
      return node.text();
    return std::filesystem::path(found->second).lexically_relative(folder_.empty() ? "." : folder_).string();
  }

  const FileNames& names_;
  std::filesystem::path folder_;
};

}  // namespace

FileNames file_names(const DocumentNode& root) {
  FileNames names;
  visit(root, document_description(), names);
  return names;
}

std::vector<std::string> existing_files(const FileNames& names) {
  std::vector<std::string> all, found;
  for (const auto& [node, name] : names) all.push_back(name);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), is_file);
  return found;
}

std::string whole_text(const DocumentNode& root, const std::string& file_name, const FileNames& names) {
  return json_indented(Writer(names, file_name).text(root));
}

}  // namespace ifov::io
