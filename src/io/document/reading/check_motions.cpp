#include "io/document/reading/check_motions.h"

#include "core/error.h"
#include "io/document/cameras/flight_path.h"
#include "io/document/document.h"
#include "io/document/platform_document.h"
#include "io/document/shapes/flat_primitives.h"

namespace ifov::io {

void check_motions(const Document& document) {
  for (const ObjectDocument& object : document.scene.objects) {
    if (!object.motion) continue;
    const SourcePosition& at = object.motion->position;
    const auto refuse = [&](const char* why) { throw document_error(document.sources, at, why); };
    if (is_primitive(object.shape, PlanePrimitive::kModel))
      refuse("a plane has no end: it is the same wherever it moves; expected a shape with an end");
    if (std::holds_alternative<TerrainShape>(object.shape)) refuse("terrain cannot move");
    if (std::holds_alternative<CityShape>(object.shape))
      refuse("a city cannot move; expected a shape, or copies of a prototype");
    if (object.present)
      refuse(
          "'motion' and 'present' cannot stand together yet: what moves is there at all times, where its path says");
    if (document.scene.periodic)
      refuse("in a scene that repeats ('periodic') nothing can move: all copies of it would");
    try {
      check_flight({*object.motion, document.time, document.scene.origin, document.seed});
    } catch (const InputError& error) {
      throw document_error(document.sources, at, error.what());
    }
  }
}

}  // namespace ifov::io
