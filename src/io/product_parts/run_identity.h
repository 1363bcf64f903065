#pragma once

#include <cstdint>
#include <string>

#include "io/quantities/acquisition.h"

namespace ifov::io {

/// What is known of a run before its first tile; every product carries it.
struct RunIdentity {
  std::string version;  ///< of the program
  std::string document_path;
  std::string document_text;  ///< the document as written
  std::uint64_t seed = 0;
  std::string sampler;         ///< "accuracy", "grid 10 x 10", ...
  std::string accuracy_asked;  ///< "0.1 K in channel B10"; empty where no accuracy is asked
  double confidence = 0.95;    ///< of the intervals whose half-widths are written
  Acquisition acquisition = {};
};

}  // namespace ifov::io
