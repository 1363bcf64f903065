#pragma once

namespace ifov::io {
struct DocumentSources;
struct SceneDocument;
}  // namespace ifov::io
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// Throws an error at the first material with a smooth boundary, pane or film, where the sensor tells polarizations
/// apart: they polarize light more than anything else, and how is not worked out. `scene` is assembled from `written`.
void check_polarized(const io::DocumentSources& sources, const io::SceneDocument& written,
                     const scene::Scene& scene);

}  // namespace ifov::session
