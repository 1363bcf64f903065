#pragma once

#include "io/document/scene_document.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {

/// The tables of keys of the shapes that are no primitives.
SchemaType<MeshShape> mesh_type();
SchemaType<CityShape> city_type();
SchemaType<InstanceShape> instance_type();
SchemaType<InstancesShape> instances_type();
SchemaType<RandomPlacement> random_placement_type();

}  // namespace ifov::io
