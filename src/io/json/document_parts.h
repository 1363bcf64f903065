#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/json/document_override.h"
#include "io/json/json_adapter.h"

namespace ifov::io {

/// A document with what it includes and what the command line puts in place of its values.
///
/// Objects are put together key by key; of anything else the including document's value counts, and a null there takes
/// the key away. An override comes last and replaces the whole value; a null takes the key or the list's item away, and
/// numbers go on counting items as they were written. Of several `instruments` the one that `instrument` names is the `sensor`, in which
/// overrides of that count; both keys are gone then. Values keep the place where they were written, so messages name the
/// right file and paths are relative to the file that names them.
struct DocumentParts {
  std::vector<std::shared_ptr<const DocumentSource>> sources;  ///< the document, what it includes, overrides
  std::vector<std::string> included;                           ///< the files, as found
  std::unique_ptr<const DocumentNode> root;
  bool is_one_text = true;  ///< nothing included, nothing replaced
  std::string instrument;   ///< which of several is the `sensor` of `root`; empty: there are not several
};

/// Throws InputError with the place of the `include` for files that include each other, more than 256 of them, or text
/// beyond the limits of JsonRules; SystemError where one cannot be read.
DocumentParts put_together(std::string text, const std::string& file_name,
                           std::span<const DocumentOverride> overrides);

/// Of a document with `instruments`, of which it chooses none (`instrument`): their names. Errors likewise.
std::vector<std::string> names_of_instruments(std::string text, const std::string& file_name,
                                              std::span<const DocumentOverride> overrides);

/// The text of a file, at most `max_bytes`; SystemError, InputError as read_document.
std::string read_document_text(const std::string& path, std::size_t max_bytes = JsonRules().max_bytes);

}  // namespace ifov::io
