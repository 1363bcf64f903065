#pragma once

namespace ifov::io {
struct Document;
}
namespace ifov::scene {
struct Scene;
}

namespace ifov::session {

/// Sun or Moon, sky, surroundings and the view path of a document, into the scene (whose materials gain the
/// surroundings').
void assemble_light(const io::Document& document, scene::Scene& scene);

}  // namespace ifov::session
