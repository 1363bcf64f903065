#pragma once

#include "io/document/scene_document.h"
#include "io/document/schema/kind.h"

namespace ifov::io {

/// The tables of keys of the shapes.
Kind<PlaneShape> plane_kind();
Kind<BoxShape> box_kind();
Kind<SphereShape> sphere_kind();
Kind<HemisphereShape> hemisphere_kind();
Kind<CylinderShape> cylinder_kind();
Kind<DiskShape> disk_kind();
Kind<PolygonShape> polygon_kind();
Kind<MeshShape> mesh_kind();
Kind<CityShape> city_kind();
Kind<InstanceShape> instance_kind();
Kind<InstancesShape> instances_kind();
Kind<ScatterShape> scatter_kind();

}  // namespace ifov::io
