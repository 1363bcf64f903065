#include "session/runs/run.h"

#include "session/runs/one_run.h"

namespace ifov::session {

RunResult render_run(const Session& session, const RunRequest& request) { return Run(session, request).go(); }

RunSummary Session::render(const RunOptions& options) const {
  RunRequest request;
  request.options = options;
  return render_run(*this, request).summary;
}

}  // namespace ifov::session
