#include "viewer/answers/answers.h"

#include "core/error.h"
#include "io/envi/colour_map.h"
#include "io/json/json_writer.h"
#include "viewer/sources/checked_document.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/run_watch.h"
#include "viewer/sources/scene_source.h"

namespace ifov::viewer {
namespace {

constexpr std::size_t kMostOpen = 20;  // times of a series

struct Row {
  std::string_view name;
  Answer (Answers::*answer)(const Query& query);
  bool is_large;  ///< takes memory beyond what it sends
};

constexpr Row kRows[] = {
    {"sources", &Answers::sources, false},
    {"band", &Answers::band, true},
    {"spread", &Answers::spread, true},
    {"pixel", &Answers::pixel, false},
    {"region", &Answers::region, true},
    {"projection", &Answers::projection, true},
    {"tile", &Answers::tile, true},
    {"document", &Answers::document, false},
    {"materials", &Answers::materials, false},
    {"colours", &Answers::colours, false},
    {"stop", &Answers::stop, false},
    {"scene", &Answers::scene, false},
    {"look", &Answers::look, false},
    {"pick", &Answers::pick, false},
};

const Row* row_of(std::string_view name) {
  for (const Row& row : kRows)
    if (row.name == name) return &row;
  return nullptr;
}

}  // namespace

Answers::Answers(ShownFolders shown, std::unique_ptr<CheckedDocument> document,
                 std::unique_ptr<SceneSource> scene)
    : times_(std::move(shown.times)), document_(std::move(document)), scene_(std::move(scene)) {
  for (std::filesystem::path& folder : shown.folders)
    sources_.push_back(std::make_unique<Source>(std::move(folder)));
}

Answers::~Answers() = default;

Answer Answers::answer(std::string_view name, const Query& query) {
  const Row* row = row_of(name);
  if (row == nullptr) throw Refused(404, "there is no such thing");
  if (!row->is_large) return (this->*row->answer)(query);
  large_.acquire();
  const Turn turn(large_);
  return (this->*row->answer)(query);
}

bool Answers::changes(std::string_view name) { return name == "stop"; }

std::uint64_t Answers::document_version() {
  if (!document_) return 0;
  const std::uint64_t version = document_->look();
  if (scene_) scene_->follow(version);
  return version;
}

Source& Answers::source(const Query& query) {
  if (sources_.empty()) throw Refused(404, "no folder is shown");
  const auto asked =
      static_cast<std::size_t>(query.integer("source", 0, static_cast<int>(sources_.size()) - 1));
  static_cast<void>(look_at(asked));
  return *sources_[asked];
}

Source::Now Answers::look_at(std::size_t source) {
  Source::Now now = sources_[source]->now();
  if (times_.empty()) return now;
  const std::lock_guard lock(recent_mutex_);
  std::erase(recent_, source);
  recent_.insert(recent_.begin(), source);
  if (recent_.size() > kMostOpen) {
    sources_[recent_.back()]->close();
    recent_.pop_back();
  }
  return now;
}

std::shared_ptr<const OpenRun> Answers::run(const Query& query) {
  const Source::Now now = source(query).now();
  if (!now.run) throw Refused(409, now.fault.empty() ? "the products are not whole yet" : now.fault);
  const int generation = query.integer("generation", 0, 1 << 30);
  if (static_cast<std::uint64_t>(generation) != now.generation)
    throw Refused(409, format("{}: the products were made anew", now.run->folder.string()));
  return now.run;
}

Answer Answers::stop(const Query& query) {
  Source& asked = source(query);
  if (!asked.now().watch) throw Refused(409, "there is no unfinished run to be stopped");
  request_stop(asked.folder());
  return {.body = "{\"stopping\":true}"};
}

Answer Answers::colours(const Query&) {
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  const auto put = [&](const char* name, const io::ColourMap& map) {
    std::vector<int> codes;
    for (const io::Rgb& colour : map) codes.insert(codes.end(), {colour.r, colour.g, colour.b});
    json.member(name, codes);
  };
  json.object([&] {
    put("sequential", io::sequential_colours());
    put("heat", io::heat_colours());
  });
  return {.body = json.written()};
}

}  // namespace ifov::viewer
