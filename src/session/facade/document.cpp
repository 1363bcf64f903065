#include "ifov/document.h"

#include "io/files/input_file.h"
#include "session/facade/document_inside.h"

namespace ifov {
namespace {

std::vector<io::DocumentOverride> overrides_of(const std::vector<std::string>& set) {
  std::vector<io::DocumentOverride> overrides;
  for (const std::string& written : set) overrides.push_back(io::read_override(written));
  return overrides;
}

}  // namespace

Document Document::read(const std::filesystem::path& file, const std::vector<std::string>& set) {
  return Document(
      std::make_shared<const Inside>(Inside{io::read_document(file.string(), overrides_of(set))}));
}

Document Document::parse(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder, const std::vector<std::string>& set) {
  return Document(std::make_shared<const Inside>(
      Inside{io::parse_document(text, (folder / name).string(), overrides_of(set))}));
}

std::string Document::name() const { return inside_->document.file_name; }

std::filesystem::path Document::output_folder() const { return inside_->document.output.folder; }

std::string document_schema() { return io::schema_json(); }

void confine_inputs(const std::filesystem::path& folder) { io::confine_inputs(folder); }

}  // namespace ifov
