#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geometry/body.h"
#include "geometry/placements.h"

namespace ifov::io {
struct Instance;
class SceneCache;
}  // namespace ifov::io

namespace ifov::session {

// What a scene cache keeps, and how: without a cache (null) everything is read, and so is what comes from a program's
// memory (assets). Records below a quarter of a mebibyte are quicker to make than to keep.

/// What a mesh is made of: `files`, the first of which it is named after, by `more`, which tells it apart
/// from others of the same files.
struct MeshSource {
  std::vector<std::string> files;
  std::string more;
  /// Files that `files` name, asked for where the mesh is read; may be empty.
  std::function<std::vector<std::string>()> further;
};

/// The body of the mesh that `read` makes of its source. `words`, where given, is what `read` puts there,
/// also where the cache has the mesh. What the cache has is used where it lies.
geometry::Body cached_mesh(io::SceneCache* cache, const MeshSource& source,
                           const std::function<geometry::TriangleMesh()>& read, std::string* words = nullptr);

/// The list of instances that `make` makes of `files`, which `more` tells apart from others of the same
/// files. The list must not outlive the cache.
std::shared_ptr<const geometry::Placements> cached_instances(
    io::SceneCache* cache, const std::vector<std::string>& files,
    const std::function<std::vector<io::Instance>()>& make, const std::string& more = {});

}  // namespace ifov::session
