#pragma once

#include "core/run_control.h"

namespace ifov::io {
struct DocumentSources;
struct SceneDocument;
}  // namespace ifov::io
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::session {

struct Parts;

/// Whether the document can mean what was loaded: says where things are, and warns of what is most likely not meant. Throws
/// InputError where nothing shines in any channel.
void check_plausibility(Parts& parts, LogSink& log);

/// What is sought of the light of what outshines the scene, and what is not.
void tell_of_emitters(const transport::SpectralScene& scene, LogSink& log);
/// Throws InputError where a lobe is so narrow that what it throws of sought emitters' light, or lets through of the Sun's, is found too seldom.
void refuse_rare_lobes(const io::DocumentSources& sources, const io::SceneDocument& written,
                       const transport::SpectralScene& scene);
/// The same of the Sun's highlights on glossy meshes.
void tell_of_highlights(const transport::SpectralScene& scene, LogSink& log);

}  // namespace ifov::session
