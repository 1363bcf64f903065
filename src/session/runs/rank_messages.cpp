#include "session/runs/rank_messages.h"

namespace ifov::session {

using cluster::Payload;

Payload payload_of(const SharedRun& run) {
  Payload payload;
  payload.put(io::to_json(run.plan));
  payload.put(run.folder.string());
  payload.put(run.start);
  payload.put(run.seconds_left.has_value());
  payload.put(run.seconds_left.value_or(0.0));
  return payload;
}

SharedRun shared_run_in(Payload& payload) {
  SharedRun run;
  run.plan = io::plan_in(payload.take<std::string>(), "what the first rank says of the run");
  run.folder = payload.take<std::string>();
  run.start = payload.take<io::StoreStart>();
  const bool limited = payload.take<bool>();
  const auto seconds = payload.take<double>();
  if (limited) run.seconds_left = seconds;
  return run;
}

Payload payload_of(const Loaded& loaded) {
  Payload payload;
  put(payload, loaded.fault);
  payload.put(loaded.threads);
  return payload;
}

Loaded loaded_in(Payload& payload) {
  Loaded loaded;
  loaded.fault = cluster::take_fault(payload);
  loaded.threads = payload.take<int>();
  return loaded;
}

}  // namespace ifov::session
