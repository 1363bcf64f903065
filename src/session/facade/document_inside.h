#pragma once

#include "ifov/document.h"
#include "io/document/document.h"

namespace ifov {

struct Document::Inside {
  io::Document document;
};

}  // namespace ifov
