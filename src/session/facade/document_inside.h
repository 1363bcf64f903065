#pragma once

#include <memory>

#include "ifov/document.h"
#include "io/document/document.h"

namespace ifov::io {
struct Inputs;
}

namespace ifov {

struct Document::Inside {
  io::Document document;
  std::shared_ptr<const io::Inputs> inputs;  ///< of all that is read for it; never null
};

}  // namespace ifov
