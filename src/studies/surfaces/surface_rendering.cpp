#include "studies/surfaces/surface_rendering.h"

#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {

SurfaceImage render_surface(const io::Document& document, const StudyOptions& options) {
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(document), options.output_folder, choices, image);
  SurfaceImage result{image.width(), image.height(), image.mean(), image.half_width(), image.samples(), {}};
  for (std::size_t p = 0; p < result.radiance.size(); ++p) result.converged.push_back(image.converged(p));
  return result;
}

}  // namespace ifov::studies
