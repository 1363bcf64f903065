#pragma once

#include "io/document/map_document.h"
#include "io/document/schema/kind.h"

namespace ifov::io {

/// The tables of keys of what lies on surfaces.
Kind<TemperatureMap> temperature_map_kind();
Kind<TextureDocument> texture_kind();
Kind<ReliefDocument> relief_kind();
Kind<MaterialBinding> binding_kind();
Kind<TerrainShape> terrain_kind();

}  // namespace ifov::io
