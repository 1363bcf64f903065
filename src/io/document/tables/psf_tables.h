#pragma once

#include <vector>

#include "io/document/psf_document.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {

/// And where they stand.
struct PlacedPsf {
  std::vector<PsfPart> parts;
  SourcePosition position;
};

SchemaType<PlacedPsf> psf_type();

}  // namespace ifov::io
