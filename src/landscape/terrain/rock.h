#pragma once

#include "geometry/triangle_mesh.h"
#include "landscape/shapes/random_stream.h"

namespace ifov::landscape {

/// A boulder about 1 m across, sunk into the ground by a third; slot: rock.
geometry::TriangleMesh rock_mesh(const RandomStream& random);

}  // namespace ifov::landscape
