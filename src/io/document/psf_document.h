#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "io/document/document_values.h"

namespace ifov::io {

struct PupilDocument;

struct GaussianPsf {
  double sigma_px = 0.0;
};
/// Diffraction of a circular aperture. Its size in pixels takes focal length and pitch: of the camera, or of optics and detector.
struct AiryPsf {
  std::optional<double> aperture_m, wavelength_um;  ///< that of the optics, each channel's own if not given
  std::optional<double> obscuration;  ///< that of the optics where the aperture is theirs, else 0
};
struct KernelPsf {
  DocumentFile file;               ///< an image, its centre at the pixel's centre
  double samples_per_pixel = 1.0;  ///< kernel samples along one pixel side
};
using PsfPart = std::variant<GaussianPsf, AiryPsf, KernelPsf, std::shared_ptr<const PupilDocument>,
                             std::shared_ptr<const struct DiffusionDocument>,
                             std::shared_ptr<const struct CrosstalkDocument>>;  // (carriers_document.h)

/// What blurs, one after the other; at least one part.
struct PsfDocument {
  std::vector<PsfPart> parts;
};

}  // namespace ifov::io
