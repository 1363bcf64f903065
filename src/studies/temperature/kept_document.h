#pragma once

#include <string>

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

struct StudyOptions;

/// The document as it is read again from the study's folder, where it is kept by this name.
io::Document kept_document(const io::Document& document, const std::string& name,
                           const StudyOptions& options);

}  // namespace ifov::studies
