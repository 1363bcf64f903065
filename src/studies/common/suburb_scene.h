#pragma once

#include "studies/common/study_options.h"

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

/// The document of the options, or that of a residential area, which is generated into the output folder; `quick`: a
/// small one.
io::Document suburb_document(const StudyOptions& options, bool quick);

}  // namespace ifov::studies
