#include "io/document/named_files.h"

#include <algorithm>
#include <filesystem>

#include "io/document/json_adapter.h"
#include "io/document/kind.h"
#include "io/document/record_walk.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;

/// Goes through a value beside its description. Where several are possible all are tried: a text that only
/// might be the name of a file is sorted out by looking for the file.
void visit(const DocumentNode& node, const ValueDescription& description, std::vector<std::string>& files) {
  static const std::string file_kind = file().description->short_name;
  for (const ValueDescriptionPtr& one : description.alternatives) visit(node, *one, files);
  if (description.form == Form::text && node.type() == DocumentNode::Type::text &&
      description.short_name == file_kind)
    files.push_back(node.source().resolve(node.text()));
  if (description.form == Form::list && node.type() == DocumentNode::Type::list)
    for (const DocumentNode& item : node.items()) visit(item, *description.items, files);
  if (node.type() != DocumentNode::Type::object) return;
  if (description.form == Form::map)
    for (const DocumentNode& member : node.members()) visit(member, *description.items, files);
  if (description.form == Form::record)
    for (const FieldDescription& field : description.fields)
      if (const DocumentNode* member = node.find(field.key)) visit(*member, *field.value, files);
}

}  // namespace

std::vector<std::string> named_files(const Document& document) {
  const DocumentTree tree = parse_json(*document.text, document.file_name);
  std::vector<std::string> files, found;
  visit(*tree.root, document_description(), files);
  std::error_code ignored;
  for (const std::string& file : files)
    if (std::filesystem::is_regular_file(file, ignored) &&
        std::find(found.begin(), found.end(), file) == found.end())
      found.push_back(file);
  return found;
}

}  // namespace ifov::io
