#pragma once

#include "io/document/scene_document.h"
#include "io/document/schema/kind.h"

namespace ifov::io {

/// The tables of keys of the shapes that are no primitives.
Kind<MeshShape> mesh_kind();
Kind<CityShape> city_kind();
Kind<InstanceShape> instance_kind();
Kind<InstancesShape> instances_kind();
Kind<ScatterShape> scatter_kind();

}  // namespace ifov::io
