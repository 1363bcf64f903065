#include "session/assembly/whole/element_sides.h"

#include "io/document/cameras/camera_settings.h"
#include "io/document/cameras/lens_tables.h"
#include "io/document/sensor_document.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

io::SensorDocument with_element_sides(const io::DocumentSources& sources, const io::SensorDocument& sensor) {
  io::SensorDocument sized = sensor;
  const auto told = with_position(sources, sensor.camera.position,
                                  [&] { return sensor.camera.settings->sensitive_side(); });
  if (!told) return sized;
  if (sensor.fill_factor != 1.0)
    throw io::document_error(
        sources, sensor.position,
        format(
            "the sensor's 'fill_factor' is {:g}, and the table of its elements tells how wide each looks: leave one of "
            "both out",
            sensor.fill_factor));
  sized.fill_factor = told->side * told->side;
  sized.sides_apart = told->spread;
  return sized;
}

}  // namespace ifov::session
