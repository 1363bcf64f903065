#include "session/response_assembly.h"

#include "io/document/document.h"
#include "sampling/pixel_footprint.h"
#include "sensor/along_track.h"
#include "sensor/camera.h"
#include "sensor/psf.h"
#include "sensor/psf_wings.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/loaded/parts.h"

namespace ifov::session {

void assemble_response(Parts& parts) {
  const std::unique_ptr<sensor::Psf> psf = assemble_psf(parts.document.sources, parts.document.sensor);
  const double fill_factor = parts.document.sensor.fill_factor;
  const sensor::AlongTrack along = parts.camera->along_track();
  parts.footprint =
      std::make_unique<sampling::PixelFootprint>(sensor::make_footprint(psf.get(), fill_factor, along));
  if (psf == nullptr) return;
  // Wings are those of a square: along the track of a longer element the cut stands in the interval.
  if (psf->has_wings() && parts.plan.knows_errors && along.plain())
    parts.wings = std::make_unique<sensor::PsfWings>(*psf, fill_factor);
  else
    parts.psf_cut = 1.0 - psf->kept();
}

}  // namespace ifov::session
