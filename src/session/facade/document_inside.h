#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "io/document/document.h"

namespace ifov::io {
struct Inputs;
}

namespace ifov {

struct Document::Inside {
  io::Document document;
  std::shared_ptr<const io::Inputs> inputs;  ///< of all that is read for it; never null
  /// Reads it anew, with these values in place of what it says beside those that it was read with.
  std::function<io::Document(const std::vector<std::string>& set)> again;
};

}  // namespace ifov
