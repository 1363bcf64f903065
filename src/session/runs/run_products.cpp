#include "session/runs/run_products.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

#include "core/format.h"
#include "io/product_parts/run_record.h"
#include "io/run_state/run_plan.h"
#include "session/messages.h"

namespace ifov::session {
namespace {

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

io::ProductOptions options_of(const io::RunPlan& plan, const std::filesystem::path& folder, bool go_on) {
  io::ProductOptions options = plan.products(folder);
  options.go_on = go_on;
  return options;
}

}  // namespace

RunProducts::RunProducts(const io::RunPlan& plan, const std::filesystem::path& folder, bool go_on)
    : plan_(plan),
      folder_(folder),
      writer_(options_of(plan, folder, go_on), plan.identity),
      detection_(writer_),
      one_value_(detection_),
      image_errors_(one_value_) {
  writer_.begin(plan.image);
}

void RunProducts::write_missing(sampling::PixelRect pixels, sampling::Reason reason) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  sampling::TileResult tile;
  tile.reset(pixels, static_cast<int>(plan_.image.channels.size()), plan_.knows_errors);
  for (auto* values : {&tile.mean, &tile.variance_geometry, &tile.variance_path, &tile.half_width,
                       &tile.worst_ratio, &tile.missable_fraction})
    std::fill(values->begin(), values->end(), kNone);
  std::fill(tile.reasons.begin(), tile.reasons.end(), bit(reason));
  for (std::uint32_t p = 0; p < tile.samples.size(); ++p)
    for (std::uint32_t m = 0; m < plan_.image.materials.size(); ++m)
      tile.abundances.push_back({p, m, kNone, kNone});
  writer_.write(tile);
}

RunSummary RunProducts::finish(const Progress& totals, const sampling::ReasonCounts& reasons, int threads,
                               const std::string& why_gaps) {
  io::RunOutcome outcome;
  outcome.image_errors = image_errors_.errors();
  outcome.accuracy_statement = accuracy_statement(plan_, totals, reasons, why_gaps, outcome.image_errors);
  const bool one_value = one_value_.holds() && !plan_.image.views;
  if (one_value) {
    const char* const empty =
        "All pixels hold the same value in every channel: is what is meant in the picture?";
    if (!outcome.accuracy_statement.empty()) outcome.accuracy_statement += ' ';
    outcome.accuracy_statement += empty;
  }
  outcome.detection_statement = detection_.statement();
  outcome.notes = plan_.notes;
  outcome.elapsed_s = totals.elapsed_s;
  outcome.threads = threads;
  outcome.date = now_utc();
  const io::RunRecord record = writer_.finish(outcome);
  RunSummary summary;
  summary.folder = folder_;
  summary.totals = totals;
  for (const io::ProductFile& file : record.files) summary.files.push_back({file.path, file.what});
  summary.accuracy_statement = outcome.accuracy_statement;
  for (std::size_t k = outcome.notes.size(); k < record.outcome.notes.size(); ++k)
    summary.accuracy_statement += format("\n{}.", record.outcome.notes[k]);
  summary.judged = plan_.judged;
  summary.one_value = one_value;
  return summary;
}

}  // namespace ifov::session
