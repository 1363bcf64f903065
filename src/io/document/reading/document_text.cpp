#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "io/document/reading/document_kind.h"
#include "io/json/json_writer.h"

namespace ifov::io {
namespace {

/// Whether a document beside the folder may name it.
bool can_be_named(const std::string& folder) {
  const std::filesystem::path path(folder);
  return !folder.empty() && path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
}

std::string comment_lines(const std::string& comment) {
  std::string text;
  for (std::size_t from = 0; from < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', from), comment.size());
    text += format("// {}\n", comment.substr(from, end - from));
    from = end + 1;
  }
  return text;
}

}  // namespace

std::string document_text(const Document& document, const std::string& file_name, const DocumentText& how) {
  Document told = document;
  Writing writing{std::filesystem::path(file_name).parent_path().string(), how.all_keys, how.sections};
  if (!writing.sections.empty()) writing.sections.push_back("ifov");
  std::string& folder = told.output.folder;
  if (folder == usual_output_folder(document.sources.file_name) ||
      !can_be_named(file_from(writing.folder, folder)))
    folder.clear();
  const Written written = whole_document_type().write(told, writing);
  if (!written)
    throw InputError(format("the document cannot be written as '{}': '{}' is missing or cannot be told",
                            file_name, writing.fault));
  JsonValue::Members members = std::get<JsonValue::Members>(written->any());
  if (how.include.size() == 1) members.insert(members.begin() + 1, {"include", how.include.front()});
  if (how.include.size() > 1)
    members.insert(members.begin() + 1, {"include", JsonValue::List(how.include.begin(), how.include.end())});
  JsonWriter json(JsonWriter::Layout::indented);
  json.object([&] {
    for (const auto& [key, value] : members) json.member(key, value);
  });
  return comment_lines(how.comment) + json.written();
}

}  // namespace ifov::io
