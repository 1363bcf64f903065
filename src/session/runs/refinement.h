#pragma once

#include <filesystem>
#include <memory>

#include "core/run_control.h"
#include "core/run_start.h"

namespace ifov::io {
class KeptTiles;
struct RunPlan;
}  // namespace ifov::io

namespace ifov::session {

struct Parts;

/// Makes the plan that of a run which takes the kept run in the folder to the plan's tighter accuracy. Throws
/// InputError where there is none, where it differs in anything but the error asked for, and where that is
/// not tighter by a quarter at least; then looks of both runs would be at nearly the same values, and their
/// intervals could not count both.
void plan_refinement(const std::filesystem::path& folder, const Parts& parts, io::RunPlan& plan);

/// An unfinished run that is resumed keeps its tiles, and refines another, if it was begun so.
void resume_refinement(const std::filesystem::path& folder, io::RunPlan& plan);

/// The tiles that the plan's run goes on from; null where it begins from nothing. `log` (may be null) is told of damage.
/// Throws InputError where they are not there any more.
std::unique_ptr<io::KeptTiles> open_kept(const std::filesystem::path& folder, const io::RunPlan& plan,
                                         LogSink* log);

/// InputError where the document's sampling leaves nothing that --refine could go on from.
void require_refinable(const Parts& parts);

}  // namespace ifov::session
