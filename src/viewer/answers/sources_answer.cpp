#include "io/json/json_writer.h"
#include "io/quantities/quantity.h"
#include "io/run_state/run_plan.h"
#include "viewer/answers/answers.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/run_watch.h"

namespace ifov::viewer {
namespace {

using io::JsonWriter;

const char* role_name(const io::Quantity* quantity) {
  if (quantity == nullptr) return "other";
  switch (quantity->role) {
    case io::Quantity::Role::radiance: return "radiance";
    case io::Quantity::Role::error: return "error";
    case io::Quantity::Role::share: return "share";
    case io::Quantity::Role::count: return "count";
    case io::Quantity::Role::judgement: return "judgement";
    case io::Quantity::Role::truth: return "truth";
  }
  return "other";
}

void put_cube(JsonWriter& json, const OpenRun::Cube& cube) {
  const io::EnviHeader& header = cube.reader.header();
  json.object([&] {
    json.member("name", cube.name);
    json.member("what", cube.what);
    json.member("role", role_name(cube.quantity));
    json.member("unit", header.data_units);
    json.member("bands", header.bands);
    json.member("names", header.band_names);
    json.member("spectral",
                cube.quantity != nullptr ? cube.quantity->is_spectral() : !header.wavelength.empty());
    json.member("classes", cube.classes);
    json.member("lookup", cube.class_colours);
  });
}

void put_run(JsonWriter& json, const OpenRun& run) {
  json.object("run", [&] {
    json.member("title", run.title);
    json.member("width", run.width_px);
    json.member("height", run.height_px);
    json.member("unit", run.unit);
    json.member("confidence", run.confidence);
    json.member("asked", run.asked);
    json.member("reached", run.reached);
    json.member("notes", run.notes);
    json.member("document", run.document);
    json.member("rgb", run.cubes.front().reader.header().default_bands);
    json.list("channels", [&] {
      for (const Channel& channel : run.channels)
        json.object([&] {
          json.member("name", channel.name);
          json.member("um", channel.centre_um);
          json.member("fwhm", channel.fwhm_um);
        });
    });
    json.list("cubes", [&] {
      for (const OpenRun::Cube& cube : run.cubes) put_cube(json, cube);
    });
  });
}

void put_watch(JsonWriter& json, const RunWatch& watch) {
  const RunStatus& status = watch.status();
  json.object("watch", [&] {
    json.member("width", watch.plan().image.width_px);
    json.member("height", watch.plan().image.height_px);
    json.member("unit", watch.plan().image.radiance_unit);
    json.member("document", status.document);
    json.member("asked", watch.plan().identity.accuracy_asked);
    json.member("tilesDone", status.tiles_done);
    json.member("tilesWanted", status.tiles_wanted);
    json.member("pixelsDone", status.pixels_done);
    json.member("pixelsWanted", status.pixels_wanted);
    json.member("pixelsConverged", status.pixels_converged);
    json.member("rays", status.rays);
    json.member("elapsed", status.elapsed_s);
    json.member("worst", status.worst_error_ratio);
    json.member("judged", watch.plan().judged);
    json.member("atWork", status.at_work);
    json.member("text", status.text);
    json.member("tile", watch.plan().tile_px);
    std::string done;
    for (const bool is_done : watch.done()) done += is_done ? '1' : '0';
    json.member("done", done);
    json.list("channels", [&] {
      for (const render::ChannelInfo& channel : watch.plan().image.channels)
        json.object([&] {
          json.member("name", channel.name);
          json.member("um", channel.centre_um);
        });
    });
  });
}

}  // namespace

/// Of a series those that are asked for, as "3,17"; the first where none are. Else all.
Answer Answers::sources(const Query& query) {
  std::vector<std::size_t> chosen;
  std::string made, working;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    if (times_.empty()) {
      chosen.push_back(k);
      continue;
    }
    const std::filesystem::path& folder = sources_[k]->folder();
    made += signature_of(folder).empty() ? '0' : '1';
    if (working.empty() && holds_unfinished_run(folder)) working = std::to_string(k);
  }
  if (!times_.empty()) {
    for (const char* name : {"a", "b", "c"})
      if (query.has(name))
        chosen.push_back(
            static_cast<std::size_t>(query.integer(name, 0, static_cast<int>(sources_.size()) - 1)));
    if (chosen.empty()) chosen.push_back(made.find('1') == std::string::npos ? 0 : made.find('1'));
  }
  JsonWriter json(JsonWriter::Layout::compact);
  json.object([&] {
    json.member("document", document_ != nullptr);
    json.member("documentVersion", document_version());
    json.member("times", times_);
    json.member("made", made);
    json.member("working", working);
    json.list("sources", [&] {
      for (const std::size_t k : chosen) {
        const Source::Now now = look_at(k);
        json.object([&] {
          json.member("index", k);
          json.member("folder", sources_[k]->folder().string());
          json.member("generation", now.generation);
          json.member("fault", now.fault);
          if (now.run) put_run(json, *now.run);
          if (now.watch) put_watch(json, *now.watch);
        });
      }
    });
  });
  return {.body = json.written()};
}

}  // namespace ifov::viewer
