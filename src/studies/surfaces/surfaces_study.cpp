#include "studies/surfaces/surfaces_study.h"

#include <vector>

#include "studies/common/study_files.h"
#include "studies/common/study_sections.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {

StudyOutcome run_surfaces_study(const StudyOptions& options) {
  make_folder(options.output_folder);
  const auto measured = {models_section, lobes_section, fresnel_section,    furnace_section,
                         sea_section,    domes_section, model_speed_section};
  return write_sections("Surfaces", measure_sections(measured, options, options), options);
}

}  // namespace ifov::studies
