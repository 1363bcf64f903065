#include "io/document/reading/named_files.h"

#include <algorithm>
#include <filesystem>

#include "io/document/reading/record_walk.h"
#include "io/document/schema/schema_type.h"
#include "io/files/inputs.h"
#include "io/json/json_writer.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;
using Type = DocumentNode::Type;
using FileNames = std::map<const DocumentNode*, std::string>;

void visit(const DocumentNode& node, const ValueDescription& description, FileNames& names) {
  static const std::string file_type = file().description->short_name;
  for (const ValueDescriptionPtr& one : description.alternatives) visit(node, *one, names);
  if (description.form == Form::text && node.type() == Type::text && description.short_name == file_type)
    names[&node] = is_asset_name(node.text()) ? node.text() : node.source().resolve(node.text());
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

/// Of a file that is there, the name from the folder of the whole text.
std::string name_of(const DocumentNode& node, const FileNames& names, const std::filesystem::path& folder) {
  const auto found = names.find(&node);
  if (found == names.end() || std::filesystem::path(node.text()).is_absolute() || !is_file(found->second))
    return node.text();
  return std::filesystem::path(found->second).lexically_relative(folder.empty() ? "." : folder).string();
}

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
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [](const std::string& name) { return is_asset_name(name) || is_file(name); });
  return found;
}

std::string whole_text(const DocumentNode& root, const std::string& file_name, const FileNames& names) {
  const std::filesystem::path folder = std::filesystem::path(file_name).parent_path();
  JsonWriter json(JsonWriter::Layout::indented);
  json.node(root, [&](const DocumentNode& node) { return name_of(node, names, folder); });
  return json.written();
}

}  // namespace ifov::io
