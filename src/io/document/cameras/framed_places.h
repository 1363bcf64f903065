#pragma once

#include "geodesy/frames.h"
#include "math/vec3.h"

namespace ifov::io {

struct FramedPoint;
struct OriginDocument;

/// Of a scene whose origin has latitude and longitude.
geodesy::FrameTransform<geodesy::Ecef, geodesy::Enu> ecef_from_scene(const OriginDocument& origin);

/// A place in the scene; `offset_m` is subtracted from coordinates of the scene.
math::Point3 scene_point(const FramedPoint& point, const OriginDocument& origin, math::Vec3 offset_m);

}  // namespace ifov::io
