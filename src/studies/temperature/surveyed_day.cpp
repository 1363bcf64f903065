#include "io/document/document.h"
#include "session/temperatures/temperature_survey.h"
#include "studies/temperature/solved_documents.h"

namespace ifov::studies {

io::TemperatureReport surveyed_day(const io::Document& document, const std::string& name,
                                   const StudyOptions& options) {
  return session::survey_temperatures(kept_document(document, name, options), {});
}

}  // namespace ifov::studies
