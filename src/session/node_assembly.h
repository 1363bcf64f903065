#pragma once

#include "session/session.h"

namespace ifov::atmosphere {
class KeptSolutions;
}

namespace ifov::session {

/// Spectral nodes for what light can do in the scene (how often it is reflected, how hot things are), behind a modelled atmosphere: fills
/// nodes, spectral scene and air of parts whose scene, camera, channels and sampling are there. `log` and `kept` may be null.
void assemble_nodes(Parts& parts, LogSink* log, const LoadOptions& options, atmosphere::KeptSolutions* kept);

/// Where nodes stand for a channel less well than they should, without a modelled atmosphere, which knows its own error.
void warn_of_node_errors(const Parts& parts, LogSink& log);

}  // namespace ifov::session
