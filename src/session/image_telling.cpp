#include "session/image_telling.h"

#include <algorithm>

#include "io/document/document.h"
#include "sampling/footprint_groups.h"
#include "sampling/means/region_interval.h"
#include "session/assembly/whole/noise_assembly.h"
#include "session/assembly/whole/sensor_assembly.h"
#include "session/loaded/parts.h"
#include "session/loaded/single_views.h"
#include "session/messages.h"

namespace ifov::session {

void tell_of_image(Parts& p) {
  const io::Document& document = p.document;
  p.info = image_info(document.scene.origin, *p.camera, p.channels, p.scene, p.map_offset_m);
  tell_irradiance(p);
  tell_noise(document.sources, document.sensor, p.channels, p.info.channels);
  p.info.stokes = document.sensor.stokes;
  p.info.footprint_px = sampling::response_area_px(*p.footprint);
  for (std::size_t g = 0; p.groups != nullptr && g < p.groups->size(); ++g)
    p.info.footprint_px = std::max(p.info.footprint_px, sampling::response_area_px((*p.groups)[g].footprint));
  for (std::size_t c = 0; c < p.air.size(); ++c) p.info.channels[c].air = p.air[c];
}

}  // namespace ifov::session
