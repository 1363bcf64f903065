#include "session/runs/runs_together.h"

#include <algorithm>

#include "core/error.h"
#include "render/image_renderer.h"
#include "render/series/series_renderer.h"
#include "session/loaded/parts.h"
#include "session/runs/stop_request.h"
#include "session/runs/time_limit.h"

namespace ifov::session {

std::string cannot_run_together(std::span<const Parts* const> by_time) {
  if (by_time.size() < 2) return "there is one";
  std::vector<render::RenderJob> jobs;
  std::vector<const render::RenderJob*> all;
  jobs.reserve(by_time.size());
  for (const Parts* parts : by_time) all.push_back(&jobs.emplace_back(parts->job()));
  return render::cannot_share_paths(all);
}

std::vector<RunResult> render_runs(std::span<const RunOfTime> runs,
                                   const scene::TemperaturesOfTimes& temperatures, const RunTogether& how) {
  std::vector<std::unique_ptr<OneRun>> begun;
  std::vector<render::RenderJob> jobs;
  std::vector<render::ImageOfTime> images;
  std::vector<std::unique_ptr<StopRequest>> stops;
  const CancelToken* cancel = how.cancel;
  std::optional<TimeLimit::Clock::time_point> end = how.deadline;
  jobs.reserve(runs.size());
  for (const RunOfTime& run : runs) jobs.push_back(run.session->parts().job());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].request == nullptr) {
      begun.push_back(nullptr);
      continue;
    }
    begun.push_back(std::make_unique<OneRun>(*runs[k].session, *runs[k].request));
    OneRun& run = *begun.back();
    run.keeping([&] { run.begin(); });
    if (end) *end -= run.time_for_products();
    stops.push_back(std::make_unique<StopRequest>(run.stop_file(), cancel));
    cancel = stops.back()->token();
  }
  for (std::size_t k = 0; k < runs.size(); ++k)
    images.push_back(begun[k] != nullptr ? begun[k]->image()
                                         : render::ImageOfTime{jobs[k], nullptr, nullptr, {}});
  if (how.progress != nullptr) how.progress->phase("");
  const TimeLimit limit(end, cancel);
  render::RenderControl control;
  control.threads = how.threads;
  control.cancel = limit.token();
  std::vector<double> seconds(runs.size(), 0.0);
  try {
    const auto trace = [&] { seconds = render::render_times(images, temperatures, control, how.most_bytes); };
    if (const auto any =
            std::find_if(begun.begin(), begun.end(), [](const auto& run) { return run != nullptr; });
        any != begun.end())
      (*any)->keeping(trace);
  } catch (const Cancelled&) {
    if (!limit.reached()) throw;
  }
  std::vector<RunResult> results(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (begun[k] != nullptr) begun[k]->keeping([&] { results[k] = begun[k]->end(seconds[k]); });
  return results;
}

}  // namespace ifov::session
