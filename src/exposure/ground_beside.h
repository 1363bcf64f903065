#pragma once

#include "math/vec3.h"

namespace ifov::exposure {

class PastScene;

/// How high a place is above the ground that lies around it at the foot of a drop, where nothing below it faces up: a roof over a hole of
/// the terrain. Drops are sought in eight directions up to 60 m away; 0 where fewer than five have one. A slope is none.
/// By a thousand rays: for measuring what PastScene::height_above_ground_m may be off by, which tells 0 there.
double height_above_ground_beside_m(const PastScene& scene, math::Point3 place_m, double least_m);

}  // namespace ifov::exposure
