#pragma once

#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/simulation.h"

namespace ifov {

enum class Severity {
  statement,  ///< what was loaded, where it is, what was assumed: a line of what `ifov check` prints
  warning,    ///< something is left out, or most likely not meant
  error,      ///< the document or a file that it names is wrong
  failure,    ///< a file cannot be read
};

struct Message {
  Severity severity = Severity::statement;
  std::string text;         ///< as the command line prints it, without "ifov: warning: "
  SourcePosition position;  ///< of errors: where they are, as far as it is known
};

/// What `ifov check` says of a document and of all files that it names: warnings, then statements or the one error that was
/// met. Throws Cancelled. A document that cannot be read is an exception of Document already.
IFOV_API std::vector<Message> check(const Document& document, const LoadOptions& options = {});

}  // namespace ifov
