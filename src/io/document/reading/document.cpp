#include "io/document/document.h"

#include "io/document/reading/check_references.h"
#include "io/document/reading/document_kind.h"
#include "io/document/reading/mount_camera.h"
#include "io/document/reading/named_files.h"
#include "io/document/tables/tables.h"
#include "io/json/document_parts.h"
#include "io/json/document_source.h"

namespace ifov::io {
namespace {

/// A section that was not written stands where the document begins.
void position_defaults(Document& document, const SourcePosition& root) {
  for (SourcePosition* position :
       {&document.light.position, &document.atmosphere.position, &document.sampling.position,
        &document.output.position, &document.scene.origin.position, &document.sensor.psf_position}) {
    if (position->file.starts_with("default of ") || position->line == 0) *position = root;
  }
}

void gather_former_keys(const DocumentNode& node, std::vector<FormerKey>& keys) {
  const bool object = node.type() == DocumentNode::Type::object;
  if (!object && node.type() != DocumentNode::Type::list) return;
  for (const DocumentNode& child : object ? node.members() : node.items()) {
    if (object && child.name() != child.key())
      keys.push_back({child.key_position(), child.key(), std::string(child.name())});
    gather_former_keys(child, keys);
  }
}

}  // namespace

const SchemaType<Document>& whole_document_type() {
  static const SchemaType<Document> type = document_type();
  return type;
}

std::string usual_output_folder(const std::string& file_name) {
  const std::size_t slash = file_name.find_last_of('/');
  const std::size_t dot = file_name.find_last_of('.');
  const bool has_extension =
      dot != std::string::npos && dot > 0 && (slash == std::string::npos || dot > slash + 1);
  return file_name.substr(0, has_extension ? dot : std::string::npos) + ".out";
}

Document parse_document(std::string text, const std::string& file_name,
                        std::span<const DocumentOverride> overrides) {
  const DocumentParts parts = put_together(std::move(text), file_name, overrides);
  Document document = whole_document_type().read(*parts.root);
  reject_unread(*parts.root);
  gather_former_keys(*parts.root, document.former_keys);
  position_defaults(document, parts.root->position());
  document.sources = {file_name, parts.sources};
  const auto names = file_names(*parts.root);
  document.files = existing_files(names);
  document.files.insert(document.files.end(), parts.included.begin(), parts.included.end());
  if (parts.is_one_text)
    document.text = std::shared_ptr<const std::string>(parts.sources.front(), &parts.sources.front()->text());
  else
    document.text = std::make_shared<const std::string>(whole_text(*parts.root, file_name, names));
  if (!document.output.folder.empty()) {
    document.output.folder = parts.sources.front()->resolve(document.output.folder);
  } else {
    document.output.folder = usual_output_folder(file_name);
  }
  if (!parts.instrument.empty()) document.output.folder += "/" + parts.instrument;
  mount_camera(document);
  check_references(document);
  return document;
}

Document read_document(const std::string& path, std::span<const DocumentOverride> overrides) {
  return parse_document(read_document_text(path), path, overrides);
}

InputError document_error(const DocumentSources& sources, const SourcePosition& position,
                          std::string_view message) {
  for (const auto& source : sources.texts)
    if (source->file_name() == position.file) return source->error(position, message);
  return located_error({}, sources.file_name, position, message);
}

}  // namespace ifov::io
