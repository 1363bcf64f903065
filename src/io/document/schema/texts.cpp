#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "io/document/schema/schema_type.h"
#include "io/files/inputs.h"

namespace ifov::io {
namespace {

constexpr std::size_t kLongestLabel = 200;
constexpr std::size_t kLongestPath = 4096;

/// The value as a text, if it is one that is read.
Written written_text(const std::string& value, std::size_t longest) {
  const bool fits = !value.empty() && value.size() <= longest && value.find('\0') == std::string::npos;
  return fits ? Written(value) : std::nullopt;
}

}  // namespace

void Writing::is_within(std::string_view key) {
  const bool ends = fault.empty() || fault.front() == '[';
  fault = format("{}{}{}", key, ends ? "" : ".", fault);
}

void Writing::is_within(std::size_t index) { fault = format("[{}]{}", index, fault); }

std::string file_from(const std::string& folder, const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path named(path);
  if (path.empty() || is_asset_name(path)) return path;
  const std::string relative = named.lexically_relative(folder.empty() ? "." : folder).string();
  // What a document elsewhere names by its whole path may be anywhere; what lies beside or below it goes where it goes.
  if (named.is_absolute()) return relative.empty() || relative.starts_with("..") ? path : relative;
  return relative.empty() ? fs::absolute(named).string() : relative;
}

SchemaType<std::string> label() {
  ValueDescription d;
  d.expected = format("a text of 1 to {} bytes", kLongestLabel);
  d.short_name = "text";
  d.pattern = "^[^\\u0000-\\u001F]+$";
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            const std::string& text = text_of(node, *description);
            const bool printable = std::all_of(text.begin(), text.end(),
                                               [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
            if (text.empty() || text.size() > kLongestLabel || !printable)
              node.fail_expected(description->expected);
            return text;
          },
          [](const std::string& text, Writing&) { return written_text(text, kLongestLabel); }};
}

SchemaType<std::string> text_like(std::string pattern, std::string expected, std::string short_name) {
  ValueDescription d;
  d.expected = std::move(expected);
  d.short_name = std::move(short_name);
  d.pattern = std::move(pattern);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description, [description](const DocumentNode& node) { return text_of(node, *description); },
          [](const std::string& text, Writing&) { return Written(text); }};
}

SchemaType<DocumentName> name_of(const std::string& what) {
  ValueDescription d;
  d.expected = format("the name of {}", what);
  d.short_name = d.expected.substr(4);
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            return DocumentName{text_of(node, *description), node.position()};
          },
          [](const DocumentName& name, Writing&) { return Written(name.name); }};
}

SchemaType<DocumentFile> file() {
  ValueDescription d;
  d.expected = "the name of a file, relative to the document";
  d.short_name = "file name";
  d.pattern = "^[^\\u0000]+$";
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            const std::string& path = text_of(node, *description);
            const bool usable =
                !path.empty() && path.size() <= kLongestPath && path.find('\0') == std::string::npos;
            if (!usable) node.fail_expected(description->expected);
            return DocumentFile{is_asset_name(path) ? path : node.source().resolve(path), node.position()};
          },
          [](const DocumentFile& file, Writing& writing) {
            return written_text(file_from(writing.folder, file.path), kLongestPath);
          }};
}

}  // namespace ifov::io
