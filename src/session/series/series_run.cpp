#include "session/series/series_run.h"

#include <algorithm>
#include <chrono>

#include "core/error.h"
#include "core/version.h"
#include "io/document/document.h"
#include "io/files/own_files.h"
#include "io/quantities/quantity_set.h"
#include "io/run_state/run_folder.h"
#include "session/runs/run_record_file.h"
#include "session/runs/runs_together.h"
#include "session/series/series_document.h"
#include "session/series/series_products.h"
#include "session/series/series_record.h"
#include "session/series/series_sun.h"
#include "session/series/series_voice.h"
#include "session/shared_scene.h"
#include "session/solved/shared_temperatures.h"
#include "session/solved/solved_temperatures.h"

namespace ifov::session {
namespace {

/// Times that are rendered together: those of the series in parts of so many, whoever of them are there already, so that what comes out
/// does not depend on where it was stopped.
constexpr std::size_t kTogether = 32;
constexpr std::size_t kMostShared_bytes = 256'000'000;

class SeriesRun {
 public:
  explicit SeriesRun(const SeriesRequest& request)
      : request_(request),
        count_(request.times.all.size()),
        log_(request.run.options.log),
        progress_(request.run.options.progress, count_) {}

  SeriesResult go() {
    const io::Document first = document(0);
    record_.version = version();
    record_.document = first.sources.file_name;
    record_.name = first.output.name;
    for (const SeriesTimes::One& one : request_.times.all) record_.times.push_back({one.text, one.folder});
    result_.folder = folder_of(first);
    if (count_ > 1) refuse_what_is_still(first);
    refuse_what_is_there();
    require_weather_at_ends(first);
    shares_ = count_ > 1 && SharedScene::serves(first) && !first.platform &&
              solved_temperature_at(first).has_value();
    tell_of_crossovers(first);
    std::filesystem::create_directories(result_.folder);
    record_.write(result_.folder);
    find_finished();
    for (std::size_t k = 0; k < count_; k += kTogether)
      if (!render(k, std::min(count_, k + kTogether))) return stopped_early();
    add_finished();
    const SeriesFiles made = make_series_products(
        {result_.folder, record_, shown_channels(first), is_of_views(first), place_of(first)}, &log_);
    result_.files = made.files;
    for (const ProductFile& file : made.files) record_.files.push_back(file.path.filename().string());
    record_.complete = true;
    record_.write(result_.folder);
    return finished();
  }

 private:
  io::Document document(std::size_t k) const {
    const Call call{request_.inputs, request_.load.cancel};
    const CallScope scope(call);
    return request_.document(request_.times.all[k].text);
  }

  std::optional<geodesy::Geodetic> place_of(const io::Document& document) const {
    const Call call{request_.inputs, request_.load.cancel};  // the weather's file may tell
    const CallScope scope(call);
    return place_of_series(document);
  }

  std::filesystem::path folder_of(const io::Document& document) const {
    if (!request_.run.options.output_folder.empty()) return request_.run.options.output_folder;
    io::refuse_links_below(std::filesystem::path(document.sources.file_name).parent_path(),
                           document.output.folder);
    return document.output.folder;
  }
  std::filesystem::path folder_at(std::size_t k) const { return result_.folder / record_.times[k].folder; }

  /// What goes wrong at a time names it.
  template <class Action>
  auto named(std::size_t k, Action&& action) const {
    const auto text = [&](const std::exception& error) {
      return format("at {} ({} of {} times): {}", record_.times[k].time, k + 1, count_, error.what());
    };
    try {
      return action();
    } catch (const InputError& error) {
      throw InputError(text(error), error.position());
    } catch (const SystemError& error) {
      throw SystemError(text(error));
    }
  }

  /// Nothing finished is thrown away unasked, and what was begun is not begun again.
  void refuse_what_is_there() const {
    for (std::size_t k = 0; k < count_; ++k) io::refuse_links_below(result_.folder, folder_at(k));
    if (request_.run.start != RunStart::fresh) return;
    std::error_code ignored;
    const auto earlier = SeriesRecord::in(result_.folder);
    bool begun = earlier && !earlier->complete;
    for (std::size_t k = 0; k < count_; ++k)
      begun = begun || std::filesystem::exists(io::plan_file(folder_at(k)), ignored);
    if (begun)
      throw InputError(format(
          "'{}' holds a series that is not finished: --resume goes on with it, --restart throws it away and begins",
          result_.folder.string()));
  }

  /// Weather that does not reach is told before the first ray, not after hours.
  void require_weather_at_ends(const io::Document& first) const {
    for (const std::size_t k : {std::size_t{0}, count_ - 1})
      named(k, [&] {
        const Call call{request_.inputs, request_.load.cancel};
        const CallScope scope(call);
        require_weather(k == 0 ? first : document(k));
      });
  }

  /// What is not asked for cannot be had after hours either.
  void tell_of_crossovers(const io::Document& first) {
    const auto& products = first.output.products;
    if (products && solved_temperature_at(first) && !products->has(*io::find_quantity("abundance")))
      log_.warn("no crossovers of materials will be told: 'output.products' leaves out \"abundance\"");
  }

  void find_finished() {
    finished_.assign(count_, false);
    if (request_.run.start != RunStart::resume) return;
    for (std::size_t k = 0; k < count_; ++k) {
      const auto path = complete_run(folder_at(k), record_.name);
      if (!path) continue;
      const RunRecordFile file(*path);
      if (file.root()["document"]["text"].text() != *document(k).text ||
          file.root()["program"]["version"].text() != version())
        throw InputError(format(
            "'{}' holds products of another document, or of another version of ifov: --restart makes all times anew",
            folder_at(k).string()));
      finished_[k] = true;
    }
    const auto there = std::count(finished_.begin(), finished_.end(), true);
    if (there > 0) log_.info(format("{} of {} times are done already", there, count_));
  }

  bool is_over() const {
    return request_.run.deadline && std::chrono::steady_clock::now() >= *request_.run.deadline;
  }

  /// Times from one to before another, together where they can. False where the deadline came first.
  bool render(std::size_t first, std::size_t end) {
    const auto left = [&](std::size_t from) {
      return static_cast<std::size_t>(
          std::count(finished_.begin() + static_cast<std::ptrdiff_t>(from), finished_.end(), false));
    };
    if (left(first) == left(end)) return true;
    if (is_over()) return false;
    std::vector<Session> sessions;
    std::unique_ptr<const scene::TemperaturesOfTimes> shared;
    // Two tell whether it is worth loading all.
    for (const std::size_t until : {std::min(end, first + 2), end}) {
      if (!shares_) break;
      while (first + sessions.size() < until)
        sessions.push_back(loaded(first + sessions.size(), left(first + sessions.size() + 1)));
      std::vector<const Parts*> all;
      for (const Session& session : sessions) all.push_back(&session.parts());
      std::string why_not = cannot_run_together(all);
      if (why_not.empty() && (shared = share_temperatures(all)) == nullptr)
        why_not = "the steps of their temperatures do not fall on each other";
      if (why_not.empty()) continue;
      shared.reset();
      shares_ = end - first < 2 && shares_;
      log_.info(format("each time has paths of its own: {}", why_not));
      break;
    }
    if (shared != nullptr) return render_together(first, sessions, *shared, left(end));
    for (std::size_t k = first; k < end; ++k) {
      if (finished_[k]) continue;
      if (is_over()) return false;
      const bool is_loaded = k - first < sessions.size();
      const Session session = is_loaded ? std::move(sessions[k - first]) : loaded(k, left(k + 1));
      if (!render_alone(k, session, left(k + 1))) return false;
    }
    return true;
  }

  /// With what is said of it; `more` times come after it.
  Session loaded(std::size_t k, std::size_t more) {
    progress_.time(k, record_.times[k].time, more);
    log_.info(format("time {} ({} of {})", record_.times[k].time, k + 1, count_));
    return named(k, [&] {
      Session session = load(k);
      if (request_.strict && !session.warnings().empty())
        throw InputError(format("{} warning{} on loading, which --strict makes {}", session.warnings().size(),
                                session.warnings().size() == 1 ? "" : "s",
                                session.warnings().size() == 1 ? "an error" : "errors"));
      for (const std::string& warning : session.warnings())
        if (std::find(result_.warnings.begin(), result_.warnings.end(), warning) == result_.warnings.end())
          result_.warnings.push_back(warning);
      if (request_.load.cancel != nullptr && request_.load.cancel->cancelled()) throw Cancelled();
      return session;
    });
  }

  RunRequest request_of(std::size_t k, ProgressSink* progress) {
    RunRequest run = request_.run;
    run.options.output_folder = folder_at(k);
    run.options.log = &log_;
    run.options.progress = progress;
    return run;
  }
  /// Whether it is whole.
  bool add(std::size_t k, RunResult run, const Session& session) {
    const bool whole = run.tiles_left == 0;
    result_.times.push_back(
        {record_.times[k].time, folder_at(k), false, std::move(run), session.warnings().size()});
    return whole;
  }

  bool render_alone(std::size_t k, const Session& session, std::size_t more) {
    progress_.time(k, record_.times[k].time, more);
    return named(k, [&] {
      const RunRequest run = request_of(k, &progress_);
      const Call call{request_.inputs};  // what is finished is put away undisturbed
      const CallScope scope(call);
      return add(k, render_run(session, run), session);
    });
  }

  bool render_together(std::size_t first, const std::vector<Session>& sessions,
                       const scene::TemperaturesOfTimes& temperatures, std::size_t more) {
    log_.info(format("{} times go along the same paths; each thread keeps {} MB of these at most",
                     sessions.size(), kMostShared_bytes / 1'000'000));
    std::vector<RunRequest> requests;
    std::vector<std::unique_ptr<ProgressSink>> parts;
    std::vector<RunOfTime> runs;
    requests.reserve(sessions.size());
    SumOfProgress sum(progress_);
    for (std::size_t k = 0; k < sessions.size(); ++k) {
      parts.push_back(sum.part());
      requests.push_back(request_of(first + k, parts.back().get()));
      runs.push_back({&sessions[k], finished_[first + k] ? nullptr : &requests.back()});
    }
    progress_.times(first, sessions.size(), record_.times[first].time, more);
    const Call call{request_.inputs};
    const CallScope scope(call);
    std::vector<RunResult> made = named(first, [&] {
      return render_runs(runs, temperatures,
                         {.threads = request_.run.options.threads,
                          .cancel = request_.run.options.cancel,
                          .progress = &progress_,
                          .deadline = request_.run.deadline,
                          .most_bytes = kMostShared_bytes});
    });
    bool whole = true;
    for (std::size_t k = 0; k < sessions.size(); ++k)
      if (!finished_[first + k]) whole = add(first + k, std::move(made[k]), sessions[k]) && whole;
    return whole;
  }

  Session load(std::size_t k) {
    const Call call{request_.inputs, request_.load.cancel};
    const CallScope scope(call);
    LoadOptions options = request_.load;
    options.shared = &scene_;
    options.progress = &progress_;
    return Session::load(document(k), &log_, options);
  }

  /// Those of earlier starts, told by their records.
  void add_finished() {
    for (std::size_t k = 0; k < count_; ++k) {
      if (!finished_[k]) continue;
      const RunRecordFile file(*complete_run(folder_at(k), record_.name));
      const Record accuracy = file.root()["accuracy"];
      SeriesResult::OfTime one{record_.times[k].time, folder_at(k), true, {}, 0};
      one.run.summary.judged = !accuracy["asked"].text("").empty();
      one.run.summary.totals.pixels_done = accuracy["pixels"].integer();
      one.run.summary.totals.pixels_converged = accuracy["pixels_converged"].integer();
      for (const Record& note : file.root()["notes"].items())
        if (note.text().starts_with("warning: ")) ++one.warnings;
      result_.times.insert(result_.times.begin() + static_cast<std::ptrdiff_t>(k), std::move(one));
    }
  }

  SeriesResult stopped_early() {
    const auto there = static_cast<std::size_t>(std::count(finished_.begin(), finished_.end(), true));
    const auto whole = static_cast<std::size_t>(
        std::count_if(result_.times.begin(), result_.times.end(),
                      [](const SeriesResult::OfTime& one) { return one.run.tiles_left == 0; }));
    result_.times_left = count_ - there - whole;
    return finished();
  }

  SeriesResult finished() {
    result_.totals = progress_.all();
    return std::move(result_);
  }

  const SeriesRequest& request_;
  std::size_t count_;
  SeriesLog log_;
  SeriesProgress progress_;
  SharedScene scene_;
  SeriesRecord record_;
  std::vector<bool> finished_;
  bool shares_ = false;  ///< as far as is known, times can be rendered together
  SeriesResult result_;
};

}  // namespace

SeriesResult render_series(const SeriesRequest& request) { return SeriesRun(request).go(); }

}  // namespace ifov::session
