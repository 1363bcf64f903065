#pragma once

#include <vector>

#include "io/document/psf_document.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {

template <class T>
class Record;
struct SensorDocument;

/// And where they stand.
struct PlacedPsf {
  std::vector<PsfPart> parts;
  SourcePosition position;
};

SchemaType<PlacedPsf> psf_type();

/// The row of a sensor's own mounts.
void add_own_mounts(Record<SensorDocument>& record);

}  // namespace ifov::io
