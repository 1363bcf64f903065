#include "cli/info/product_info.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "cli/terminal/progress_line.h"
#include "core/error.h"
#include "core/format.h"
#include "ifov/products.h"
#include "ifov/series.h"

namespace ifov::cli {
namespace {

constexpr std::size_t kMostLinesShown = 12;

void add_line(std::string& text, std::string_view name, const std::string& value) {
  if (!value.empty() && value != "?") text += format("{:<10} {}\n", name, value);
}

std::string known(const std::string& text) { return text.empty() ? "?" : text; }

std::string wavelength(double um) {
  return um < 3.0 ? format("{:.6g} nm", 1e3 * um) : format("{:.6g} um", um);
}

/// The first lines and the last, where there are many.
std::string shown(std::string_view name, const std::vector<std::string>& lines) {
  std::string text;
  const std::size_t first = lines.size() > kMostLinesShown ? kMostLinesShown / 2 : lines.size();
  for (std::size_t i = 0; i < first; ++i) text += format("{:<10} {}\n", i == 0 ? name : "", lines[i]);
  if (first == lines.size()) return text;
  text += format("{:<10} ... {} more\n", "", lines.size() - first - 1);
  return text + format("{:<10} {}\n", "", lines.back());
}

std::string channel_line(const RunInfo::Channel& channel, const std::string& unit) {
  std::string line =
      format("{}: {}, width {}", channel.name, wavelength(channel.centre_um), wavelength(channel.fwhm_um));
  if (channel.mean)
    line += format("; {:.5g} to {:.5g}, mean {:.5g} {}", channel.minimum.value_or(0.0),
                   channel.maximum.value_or(0.0), *channel.mean, unit);
  if (channel.mean_half_width) line += format(" +- {:.3g}", *channel.mean_half_width);
  return line;
}

std::string accuracy_lines(const RunInfo& run) {
  std::string text;
  add_line(text, "asked", run.accuracy_asked);
  add_line(text, "reached", run.accuracy_reached);
  if (run.pixels && run.worst_error_ratio > 0.0)
    add_line(text, "converged",
             format("{} of {} pixels, worst error {:.3g} x limit", run.pixels_converged, *run.pixels,
                    run.worst_error_ratio));
  add_line(text, "reasons", run.reasons);
  add_line(text, "detection", run.detection);
  return text;
}

std::string describe_record(const std::filesystem::path& path) {
  const RunInfo run = run_info(path);
  std::string text = format("{}\n", path.string());
  add_line(text, "made by",
           format("ifov {}, seed {}, sampling: {}", known(run.version), run.seed, known(run.sampler)));
  add_line(text, "document", run.document);
  add_line(text, "image",
           format("{} x {} pixels, {} channels, {}", run.width_px, run.height_px, run.channels.size(),
                  known(run.radiance_unit)));
  std::vector<std::string> channels;
  for (const RunInfo::Channel& channel : run.channels)
    channels.push_back(channel_line(channel, known(run.radiance_unit)));
  text += shown("channels", channels) + accuracy_lines(run);
  add_line(text, "cost",
           format("{} rays, {} samples, {}", short_count(run.rays), short_count(run.samples),
                  format("{:.2f} s", run.elapsed_s)));
  for (const std::string& note : run.notes) add_line(text, "note", note);
  for (const RunInfo::File& made : run.files)
    add_line(text, "file", format("{}  ({}, {} bytes)", made.name, made.what, made.bytes));
  return text;
}

std::string describe_envi(const std::filesystem::path& path) {
  const CubeInfo cube = cube_info(path);
  std::string text = format("{}\n", cube.path.string());
  std::string about = cube.description;
  std::replace(about.begin(), about.end(), '\n', ';');
  add_line(text, "what", about);
  const std::map<std::string_view, const char*> layouts{
      {"bsq", "band sequential"}, {"bil", "band interleaved by line"}, {"bip", "band interleaved by pixel"}};
  add_line(text, "image",
           format("{} x {} pixels, {} bands, {} bytes a value, {}", cube.width_px, cube.height_px, cube.bands,
                  cube.bytes_per_value, layouts.at(cube.interleave)));
  add_line(text, "unit", cube.unit);
  std::string map;
  for (const std::string& item : cube.map_info) map += format("{}{}", map.empty() ? "" : ", ", item);
  add_line(text, "map", map);
  std::vector<std::string> bands;
  for (int b = 0; b < cube.bands; ++b) {
    const auto i = static_cast<std::size_t>(b);
    std::string line = i < cube.band_names.size() ? cube.band_names[i] : format("band {}", b + 1);
    if (i < cube.wavelength.size()) line += format(": {:.6g} {}", cube.wavelength[i], cube.wavelength_unit);
    if (i < cube.fwhm.size()) line += format(", width {:.6g}", cube.fwhm[i]);
    bands.push_back(std::move(line));
  }
  return text + shown("channels", bands);
}

bool ends_with(const std::filesystem::path& path, std::string_view ending) {
  return path.filename().string().ends_with(ending);
}

std::string describe_series(const SeriesInfo& series) {
  std::string text = format("{}\n", series.folder.string());
  add_line(text, "series", format("of {}, made by ifov {}", known(series.document), known(series.version)));
  std::vector<std::string> lines;
  std::size_t made = 0;
  for (const SeriesInfo::Time& one : series.times) {
    made += one.record.empty() ? 0 : 1;
    lines.push_back(
        format("{}  {}", one.time, one.record.empty() ? "not made yet" : one.folder.filename().string()));
  }
  add_line(text, "made",
           format("{} of {} times{}", made, series.times.size(),
                  made == series.times.size() ? "" : "; ifov render --resume goes on"));
  text += shown("times", lines);
  for (const std::string& file : series.files) add_line(text, "file", file);
  // All times are of one document: what is told of the first goes for the others.
  for (const SeriesInfo::Time& one : series.times)
    if (!one.record.empty()) return text + "\n" + describe_record(one.record);
  return text;
}

std::string describe_folder(const std::filesystem::path& folder) {
  if (const auto series = series_info(folder)) return describe_series(*series);
  std::string text;
  for (const std::filesystem::path& product : products_in(folder))
    text += format("{}{}", text.empty() ? "" : "\n",
                   ends_with(product, ".json") ? describe_record(product) : describe_envi(product));
  return text;
}

/// In which a file lies.
std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

std::string describe_product(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw SystemError(format("there is no '{}'", path.string()));
  if (std::filesystem::is_directory(path)) return describe_folder(path);
  if (ends_with(path, "_series.json")) return describe_folder(folder_of(path));
  if (ends_with(path, ".json")) return describe_record(path);
  if (ends_with(path, ".img") || ends_with(path, ".hdr")) return describe_envi(path);
  throw InputError(
      format("'{}' is no product that is known here; expected a folder, a run record (run.json) or an "
             "ENVI file (.img, .hdr)",
             path.string()));
}

}  // namespace ifov::cli
