#include "session/series/series_record.h"

#include "core/error.h"
#include "core/format.h"
#include "io/files/own_files.h"
#include "io/json/json_adapter.h"
#include "io/json/json_view.h"
#include "io/json/json_writer.h"

namespace ifov::session {
namespace {

constexpr std::string_view kSeriesEnding = "_series.json";

SeriesRecord series_in(const std::filesystem::path& path) {
  io::JsonRules rules;
  rules.comments = false;
  const io::DocumentTree tree = io::parse_json(io::read_own_file(path), path.string(), rules);
  const io::JsonView root(tree);
  SeriesRecord record;
  record.version = root["program"]["version"].text();
  record.document = root["document"].text();
  record.name = root["name"].text();
  record.complete = root["complete"].boolean();
  for (const io::JsonView& one : root["times"].items()) {
    record.times.push_back({one["time"].text(), one["folder"].text()});
    // It may have come with somebody's archive.
    const std::filesystem::path folder = record.times.back().folder;
    if (folder.has_parent_path() || folder == ".." || folder == ".")
      throw SystemError(
          format("'{}' is damaged: '{}' is no folder beside it", path.string(), folder.string()));
  }
  for (const io::JsonView& file : root["files"].items()) record.files.push_back(file.text());
  if (record.times.empty()) throw SystemError(format("'{}' is damaged: it names no times", path.string()));
  return record;
}

}  // namespace

std::optional<SeriesRecord> SeriesRecord::in(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().ends_with(kSeriesEnding)) return series_in(entry->path());
  return std::nullopt;
}

void SeriesRecord::write(const std::filesystem::path& folder) const {
  io::JsonWriter json(io::JsonWriter::Layout::indented);
  json.object([&] {
    json.object("program", [&] {
      json.member("name", "ifov");
      json.member("version", version);
    });
    json.member("document", document);
    json.member("name", name);
    json.member("complete", complete);
    json.list("times", [&] {
      for (const One& one : times)
        json.object([&] {
          json.member("time", one.time);
          json.member("folder", one.folder);
        });
    });
    json.member("files", files);
  });
  io::write_new_file(folder / (name + std::string(kSeriesEnding)), json.written());
}

std::optional<std::filesystem::path> complete_run(const std::filesystem::path& folder,
                                                  const std::string& name) {
  std::filesystem::path record = folder / (name + "_run.json");
  std::error_code ignored;
  if (!std::filesystem::exists(record, ignored)) return std::nullopt;
  return record;
}

}  // namespace ifov::session
