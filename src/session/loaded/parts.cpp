#include "session/loaded/parts.h"

#include "atmosphere/imported_atmosphere.h"
#include "io/document/document.h"
#include "io/scene_cache/file_stamp.h"
#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tile.h"
#include "sensor/camera.h"
#include "sensor/psf_wings.h"
#include "session/assembly/shared/colour_guess.h"
#include "session/assembly/shared/map_scale.h"
#include "transport/spectral_scene.h"

namespace ifov::session {

Parts::Parts(const io::Document& of)
    : kept_document(std::make_unique<const io::Document>(of)), document(*kept_document) {}

Parts::~Parts() = default;

bool Parts::has_sky() const {
  return scene.sky.radiance || scene.sky.temperature_k || atmosphere || (imported && imported->has_sky());
}

}  // namespace ifov::session
