#include "session/runs/refinement.h"

#include "core/error.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_state.h"
#include "sampling/pixel_sampler.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

/// Share of the earlier error that a refined run may ask for at most.
constexpr double kMostError = 0.75;

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

[[noreturn]] void refuse_without_kept_run(const std::filesystem::path& folder) {
  if (is_there(io::plan_file(folder)))
    throw InputError(
        format("{}: the run in this folder is not finished. Finish it first (--resume), then refine it.",
               folder.string()));
  if (io::holds_complete_run(folder))
    throw InputError(format(
        "{}: the run in this folder is complete, but what a refinement goes on from was not kept. Render it "
        "with --keep; --refine can take that further.",
        folder.string()));
  throw InputError(format("{}: this folder holds no run that could be refined. Render with --keep first.",
                          folder.string()));
}

/// What differs beside the error asked for.
std::vector<std::string> other_differences(const io::RunPlan& was, const io::RunPlan& is) {
  io::RunPlan same = is;
  if (io::differ_in_error_alone(was.identity.document_text, is.identity.document_text))
    same.identity.document_text = was.identity.document_text;
  same.base = was.base;
  same.keeps_memory = was.keeps_memory;
  return io::differences(was, same);
}

}  // namespace

void plan_refinement(const std::filesystem::path& folder, const Parts& parts, io::RunPlan& plan) {
  require_refinable(parts);
  if (!is_there(io::kept_folder(folder) / "state.json")) refuse_without_kept_run(folder);
  const io::RunPlan was = io::read_kept_plan(folder);
  const std::vector<std::string> lines = other_differences(was, plan);
  if (!lines.empty()) {
    std::string message =
        format("{}: a refinement changes nothing but the error that is asked for (sampling.accuracy.error):",
               folder.string());
    for (const std::string& line : lines) message += format("\n  {}", line);
    throw InputError(message + "\nPut back what has changed, or render anew (without --refine).");
  }
  if (was.error_unit != plan.error_unit || plan.error > kMostError * was.error)
    throw InputError(
        format("{}: a refinement goes to a tighter accuracy, at most {:g} of the error before. The run was "
               "for {}; the "
               "document asks for {}. Change sampling.accuracy.error.",
               folder.string(), kMostError, was.identity.accuracy_asked, plan.identity.accuracy_asked));
  plan.keeps_memory = true;
  plan.base = was.key();
  plan.refined_from = was.refined_from;
  plan.refined_from.push_back(was.identity.accuracy_asked);
  plan.notes.push_back(
      format("refined from: {}; rays and tests of all runs count", plan.refined_from.back()));
}

void resume_refinement(const std::filesystem::path& folder, io::RunPlan& plan) {
  if (!is_there(io::plan_file(folder))) return;
  const io::RunPlan was = io::read_plan(io::plan_file(folder));
  plan.keeps_memory = plan.keeps_memory || was.keeps_memory;
  if (plan.base != 0) return;
  plan.base = was.base;
  plan.refined_from = was.refined_from;
}

std::unique_ptr<io::KeptTiles> open_kept(const std::filesystem::path& folder, const io::RunPlan& plan,
                                         LogSink* log) {
  if (plan.base == 0) return nullptr;
  const io::RunPlan kept = io::read_kept_plan(folder);
  if (kept.key() != plan.base)
    throw InputError(format("{}: the run that is refined is not there any more. Render anew (--restart).",
                            folder.string()));
  return std::make_unique<io::KeptTiles>(folder, kept, log);
}

void require_refinable(const Parts& parts) {
  if (!parts.plan.sampler->can_refine())
    throw InputError(
        format("only a run to an accuracy can be kept and refined (sampling.accuracy); the document's "
               "sampling is: {}",
               parts.plan.method));
}

}  // namespace ifov::session
