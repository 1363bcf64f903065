#include "io/document/document.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/format.h"
#include "io/document/check_references.h"
#include "io/document/json_adapter.h"
#include "io/document/tables.h"

namespace ifov::io {
namespace {

const Kind<Document>& table() {
  static const Kind<Document> kind = document_kind();
  return kind;
}

std::string read_text(const std::string& path) {
  if (std::filesystem::is_directory(path))
    throw EnvironmentError(format("cannot read '{}': it is a folder", path));
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw EnvironmentError(format("cannot read '{}': {}", path, std::strerror(errno)));
  const std::streamoff size = file.tellg();
  const auto most = static_cast<std::streamoff>(JsonRules().max_bytes);
  if (size > most) {
    throw InputError(format("{}: the document has {} bytes, more than the {} allowed", path, size, most),
                     {path, 0, 0});
  }
  file.seekg(0);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (size < 0 || file.bad()) throw EnvironmentError(format("cannot read '{}'", path));
  return text;
}

/// A section that was not written stands where the document begins.
void place_defaults(Document& document, const SourcePosition& root) {
  for (SourcePosition* position :
       {&document.light.position, &document.atmosphere.position, &document.sampling.position,
        &document.output.position, &document.scene.origin.position, &document.sensor.psf_position}) {
    if (position->file != root.file || position->line == 0) *position = root;
  }
}

}  // namespace

Document parse_document(std::string text, const std::string& file_name) {
  const DocumentTree tree = parse_json(std::move(text), file_name);
  Document document = table().read(*tree.root);
  reject_unread(*tree.root);
  place_defaults(document, tree.root->position());
  document.file_name = file_name;
  document.text = std::shared_ptr<const std::string>(tree.source, &tree.source->text());
  if (document.output.folder.empty()) {
    const std::size_t slash = file_name.find_last_of('/');
    const std::size_t dot = file_name.find_last_of('.');
    const bool has_extension =
        dot != std::string::npos && dot > 0 && (slash == std::string::npos || dot > slash + 1);
    document.output.folder = file_name.substr(0, has_extension ? dot : std::string::npos) + ".out";
  }
  check_references(document);
  return document;
}

Document read_document(const std::string& path) { return parse_document(read_text(path), path); }

InputError document_error(const Document& document, const SourcePosition& position,
                          std::string_view message) {
  return located_error(document.text ? std::string_view(*document.text) : std::string_view(),
                       document.file_name, position, message);
}

}  // namespace ifov::io
