#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geometry/body.h"
#include "geometry/placings.h"
#include "io/instances/instance.h"
#include "io/scene_cache/scene_cache.h"

namespace ifov::session {

// What a scene cache keeps, and how: without a cache (null) everything is read. Records below a quarter of a
// mebibyte are quicker to make than to keep.

/// The body of the mesh in `file`, which `read` reads.
geometry::Body cached_mesh(io::SceneCache* cache, const std::string& file,
                           const std::function<geometry::TriangleMesh()>& read);

/// The list of instances that `make` makes of `files`, which `more` tells apart from others of the same files. The list must not outlive the cache.
std::shared_ptr<const geometry::Placings> cached_instances(io::SceneCache* cache, const std::vector<std::string>& files,
                                                           const std::function<std::vector<io::Instance>()>& make,
                                                           const std::string& more = {});

}  // namespace ifov::session
