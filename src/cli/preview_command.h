#pragma once

#include <string>

#include "cli/document_arguments.h"
#include "cli/exit_code.h"

namespace ifov::cli {

struct PreviewArguments {
  std::string document, output;  ///< output: a PNG; beside the document if empty
  DocumentArguments input;
  double seconds = 3.0;
  int pixels = 256, threads = 0;
  bool quiet = false, no_cache = false, strict = false;
};

/// Makes a small picture without a promise, and says of the scene what `ifov check` does.
ExitCode preview(const PreviewArguments& arguments);

}  // namespace ifov::cli
