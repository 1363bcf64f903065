#pragma once

#include <optional>
#include <string>

namespace ifov::thermal {

/// What the atmosphere of a document stands in with for what weather does not tell.
struct AirOfDocument {
  /// Long-wave of its sky at the ground over that by Prata for its own temperature and vapour there.
  std::optional<double> longwave_over_prata;
  std::string clouds;  ///< of its own, in words, where the weather tells none; else empty
};

}  // namespace ifov::thermal
