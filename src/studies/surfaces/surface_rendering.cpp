#include "studies/surfaces/surface_rendering.h"

#include <memory>
#include <string>

#include "io/document/cameras/frame_camera.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"

namespace ifov::studies {

io::CameraDocument square_camera(int pixels, double half, math::Point3 position_m, math::Point3 target_m) {
  io::FrameCamera camera;
  camera.focal_length_m = 0.02;
  camera.pitch_m = 2.0 * half * camera.focal_length_m / pixels;
  camera.size = {pixels, pixels};
  camera.position_m = position_m;
  camera.orientation = io::LookAt{target_m, {}};
  return {std::string(io::FrameCamera::kModel.key), std::make_shared<const io::FrameCamera>(camera), {}};
}

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
