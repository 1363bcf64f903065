#include "session/sense/sense.h"

#include "core/format.h"
#include "session/loaded/parts.h"
#include "session/sense/light_warnings.h"
#include "session/sense/place_lines.h"
#include "session/sense/sense_warnings.h"
#include "transport/emitters.h"
#include "transport/mirrors/emitter_mirrors.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

void tell_of_emitters(const transport::SpectralScene& scene, LogSink& log) {
  const transport::Emitters* emitters = scene.emitters();
  if (emitters == nullptr) return;
  if (emitters->count() > 0)
    log.info(
        format("emitters: faces that outshine the scene and whose light is sought: {}", emitters->count()));
  if (emitters->leaves_some())
    log.warn(format(
        "light of some surfaces that outshine the scene is found by chance alone: it is not sought from planes and "
        "terrain, nor from more than {} faces; of those beyond that number, pixels are marked that they may light",
        transport::Emitters::kMost));
  if (emitters->count() > 0 && transport::EmitterMirrors::leave_some(scene.scene()))
    log.warn(
        "light of surfaces that outshine the scene is sought by way of one mirror that is flat, a ball or a round "
        "column, not of other shapes or of several in turn: what those throw of it on other surfaces is found by chance "
        "alone, and pixels near them may be less sure than they say");
}

void make_sense(Parts& parts, LogSink& log) {
  const SceneLook look = look_at(parts);
  parts.places = place_lines(parts, look);
  for (const std::string& line : parts.places) log.info(line);
  require_light(parts, look);
  warn_of_places(parts, look, log);
  warn_of_standing(parts, log);
  warn_of_values(parts, look, log);
}

}  // namespace ifov::session
