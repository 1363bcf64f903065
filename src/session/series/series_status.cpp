#include "session/series/series_status.h"

#include "core/format.h"
#include "io/run_state/run_folder.h"
#include "session/runs/run_record_file.h"
#include "session/runs/run_status.h"
#include "session/series/series_record.h"

namespace ifov::session {
namespace {

std::string long_duration(double seconds) {
  if (seconds < 60.0) return format("{:.1f} s", seconds);
  if (seconds < 3600.0) return format("{:.1f} min", seconds / 60.0);
  return format("{:.1f} h", seconds / 3600.0);
}

/// Lines of a status without its first one, which names the folder.
std::string without_head(const std::string& text) {
  const std::size_t end = text.find('\n');
  return end == std::string::npos ? std::string() : text.substr(end + 1);
}

RunStatus series_status(const std::filesystem::path& folder, const SeriesRecord& series) {
  RunStatus status;
  std::size_t made = 0;
  double made_s = 0.0;
  std::string begun, begun_text;
  for (const SeriesRecord::One& one : series.times) {
    const std::filesystem::path at = folder / one.folder;
    std::error_code ignored;
    if (std::filesystem::exists(io::plan_file(at), ignored)) {
      status = status_of(at);
      begun = one.time, begun_text = without_head(status.text);
    } else if (const auto record = complete_run(at, series.name)) {
      ++made;
      made_s += RunRecordFile(*record).root()["cost"]["elapsed_s"].number();
    }
  }
  status.complete = series.complete && made == series.times.size();
  status.document = series.document, status.version = series.version;
  status.times_done = made, status.times_wanted = series.times.size();
  std::string text =
      format("{}: series of {}, ifov {}, {} times from {} to {}\n", folder.string(), series.document,
             series.version, series.times.size(), series.times.front().time, series.times.back().time);
  text += format("{:<10} {} of {} times{}\n", "times", made, series.times.size(),
                 status.complete ? ", and the products of the series" : "");
  const std::size_t left = series.times.size() - made;
  if (made > 0 && left > 0)
    text += format("{:<10} {} times, about {} at this rate\n", "left", left,
                   long_duration(made_s / static_cast<double>(made) * static_cast<double>(left)));
  if (!begun.empty())
    text += format("{:<10} {}\n{}", "begun", begun, begun_text);
  else if (!status.complete)
    text += "no time is begun but not finished; --resume goes on\n";
  status.text = std::move(text);
  return status;
}

}  // namespace

RunStatus status_of_any(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(io::plan_file(folder), ignored))
    if (const auto series = SeriesRecord::in(folder)) return series_status(folder, *series);
  return status_of(folder);
}

}  // namespace ifov::session
