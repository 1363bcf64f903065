#pragma once

namespace ifov::io {
struct DocumentSources;
struct SceneDocument;
}  // namespace ifov::io
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// Throws an error at the first material that mirrors or refracts, where the sensor tells polarizations apart and its model does not: such
/// surfaces polarize light more than any other. `scene` is assembled from `written`.
void check_polarized(const io::DocumentSources& sources, const io::SceneDocument& written,
                     const scene::Scene& scene);

}  // namespace ifov::session
