#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "geodesy/utc_time.h"

namespace ifov::session {

/// Times at which one document is rendered, in order.
struct SeriesTimes {
  struct One {
    geodesy::UtcTime time;
    std::string text;    ///< as a document has it: "2025-06-20T06:15Z"
    std::string folder;  ///< of its products: "2025-06-20T0615Z"
  };
  std::vector<One> all;

  /// "2025-06-20T00:00Z/PT15M/96": first time, step and how many, as ISO 8601 has them. InputError that quotes it and says what was
  /// expected.
  static SeriesTimes read(std::string_view written);
};

}  // namespace ifov::session
