#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/json/document_override.h"

namespace ifov::session {

/// A mistake of a document, and what is left out of it so that the rest can be looked at.
struct DocumentFault {
  std::string text;  ///< the message, with its excerpt
  SourcePosition position;
  std::string instead;  ///< "scene.objects[2] is left out"; empty: nothing was done about it
};

/// Takes out of a document what is wrong with it, one mistake after another: the object, the material or the section that a
/// message points to. What is left is for looking at alone.
class DocumentCuts {
 public:
  /// `overrides`: as of io::parse_document.
  DocumentCuts(std::string text, std::string file_name, std::span<const io::DocumentOverride> overrides);

  const std::string& text() const { return text_; }
  /// Those that were given, and then the cuts.
  const std::vector<io::DocumentOverride>& overrides() const { return overrides_; }

  /// What is to be left out because of a mistake, which is left out from here on; none where the message does not point to
  /// anything that the document can do without, or comes again though that was left out.
  std::optional<DocumentFault> cut_out(const InputError& error);

 private:
  std::string text_, file_name_;
  std::vector<io::DocumentOverride> overrides_;
  std::set<std::string> met_;
};

}  // namespace ifov::session
