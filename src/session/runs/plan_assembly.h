#pragma once

namespace ifov::io {
struct RunPlan;
}
namespace ifov::render {
struct RenderJob;
}

namespace ifov::session {

struct Parts;

/// What the tiles and the products of a document's run depend on. Looks at every file of the scene, where it is to be
/// `with_files`. Throws SystemError where one cannot be read.
io::RunPlan assemble_plan(const Parts& parts, bool with_files = true);

/// What the run's tiles are to hold.
void set_contents(const io::RunPlan& plan, render::RenderJob& job);

}  // namespace ifov::session
