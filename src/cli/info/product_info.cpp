#include "cli/info/product_info.h"

#include <algorithm>
#include <vector>

#include "cli/info/run_record_file.h"
#include "cli/terminal/progress_line.h"
#include "core/error.h"
#include "core/format.h"
#include "io/products/envi_reader.h"
#include "sampling/reason_words.h"

namespace ifov::cli {
namespace {

constexpr std::size_t kMostChannelsShown = 12;

void add_line(std::string& text, std::string_view name, const std::string& value) {
  if (!value.empty() && value != "?") text += format("{:<10} {}\n", name, value);
}

std::string wavelength(double um) {
  return um < 3.0 ? format("{:.6g} nm", 1e3 * um) : format("{:.6g} um", um);
}

std::string shown_channels(const std::vector<std::string>& lines) {
  std::string text;
  const std::size_t shown = lines.size() > kMostChannelsShown ? kMostChannelsShown / 2 : lines.size();
  for (std::size_t i = 0; i < shown; ++i) text += format("{:<10} {}\n", i == 0 ? "channels" : "", lines[i]);
  if (shown == lines.size()) return text;
  text += format("{:<10} ... {} more\n", "", lines.size() - shown - 1);
  return text + format("{:<10} {}\n", "", lines.back());
}

std::string channel_line(const Record& channel, const std::string& unit) {
  std::string line =
      format("{}: {}, width {}", channel["name"].text(), wavelength(channel["centre_um"].number()),
             wavelength(channel["fwhm_um"].number()));
  if (channel["mean"].is_number()) {
    line += format("; {:.5g} to {:.5g}, mean {:.5g} {}", channel["minimum"].number(),
                   channel["maximum"].number(), channel["mean"].number(), unit);
  }
  if (channel["mean_half_width"].is_number())
    line += format(" +- {:.3g}", channel["mean_half_width"].number());
  return line;
}

std::string reason_counts(const Record& by_reason) {
  sampling::ReasonCounts counts{};
  for (std::size_t r = 0; r < counts.size(); ++r)
    counts[r] = static_cast<std::uint64_t>(by_reason[std::string(sampling::kReasonNames[r])].number());
  return sampling::describe_reasons(counts);
}

std::string accuracy_lines(const Record& accuracy) {
  std::string text;
  add_line(text, "asked", accuracy["asked"].text());
  add_line(text, "reached", accuracy["reached"].text());
  if (accuracy["pixels"].is_number() && accuracy["worst_ratio"].number() > 0.0) {
    add_line(
        text, "converged",
        format("{:.0f} of {:.0f} pixels, worst error {:.3g} x limit", accuracy["pixels_converged"].number(),
               accuracy["pixels"].number(), accuracy["worst_ratio"].number()));
  }
  add_line(text, "reasons", reason_counts(accuracy["pixels_by_reason"]));
  add_line(text, "detection", accuracy["detection"].text());
  return text;
}

std::string describe_record(const std::filesystem::path& path) {
  const RunRecordFile record(path);
  const Record run = record.root();
  const Record image = run["image"], cost = run["cost"];
  std::string text = format("{}\n", path.string());
  add_line(text, "made by",
           format("ifov {}, seed {:.0f}, sampling: {}", run["program"]["version"].text(),
                  run["seed"].number(), run["sampler"].text()));
  add_line(text, "document", run["document"]["path"].text());
  add_line(
      text, "image",
      format("{:.0f} x {:.0f} pixels, {} channels, {}", image["width_px"].number(),
             image["height_px"].number(), run["channels"].items().size(), image["radiance_unit"].text()));
  std::vector<std::string> channels;
  for (const Record& channel : run["channels"].items()) {
    channels.push_back(channel_line(channel, image["radiance_unit"].text()));
  }
  text += shown_channels(channels) + accuracy_lines(run["accuracy"]);
  add_line(
      text, "cost",
      format("{} rays, {} samples, {}", short_count(cost["rays"]["total"].number()),
             short_count(cost["samples"]["total"].number()), format("{:.2f} s", cost["elapsed_s"].number())));
  for (const Record& note : run["notes"].items()) add_line(text, "note", note.text());
  for (const Record& made : run["files"].items()) {
    add_line(
        text, "file",
        format("{}  ({}, {:.0f} bytes)", made["name"].text(), made["what"].text(), made["bytes"].number()));
  }
  return text;
}

std::string describe_envi(const std::filesystem::path& path) {
  const io::EnviReader reader(path);
  const io::EnviHeader& header = reader.header();
  std::string text = format("{}\n", reader.data_path().string());
  std::string about = header.description;
  std::replace(about.begin(), about.end(), '\n', ';');
  add_line(text, "what", about);
  const char* const layouts[] = {"band sequential", "band interleaved by line", "band interleaved by pixel"};
  add_line(
      text, "image",
      format("{} x {} pixels, {} bands, {} bytes a value, {}", header.samples, header.lines, header.bands,
             io::bytes_per_value(header.data_type), layouts[static_cast<int>(header.interleave)]));
  add_line(text, "unit", header.data_units);
  std::string map;
  for (const std::string& item : header.map_info) map += format("{}{}", map.empty() ? "" : ", ", item);
  add_line(text, "map", map);
  std::vector<std::string> bands;
  for (int b = 0; b < header.bands; ++b) {
    const auto i = static_cast<std::size_t>(b);
    std::string line = i < header.band_names.size() ? header.band_names[i] : format("band {}", b + 1);
    if (i < header.wavelength.size())
      line += format(": {:.6g} {}", header.wavelength[i], header.wavelength_units);
    if (i < header.fwhm.size()) line += format(", width {:.6g}", header.fwhm[i]);
    bands.push_back(std::move(line));
  }
  return text + shown_channels(bands);
}

bool ends_with(const std::filesystem::path& path, std::string_view ending) {
  return path.filename().string().ends_with(ending);
}

std::string describe_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> records, cubes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (ends_with(entry.path(), "run.json")) records.push_back(entry.path());
    if (ends_with(entry.path(), ".img")) cubes.push_back(entry.path());
  }
  std::sort(records.begin(), records.end());
  std::sort(cubes.begin(), cubes.end());
  std::string text;
  for (const auto& record : records)
    text += format("{}{}", text.empty() ? "" : "\n", describe_record(record));
  if (!records.empty()) return text;
  for (const auto& cube : cubes) text += format("{}{}", text.empty() ? "" : "\n", describe_envi(cube));
  if (cubes.empty()) {
    throw InputError(format("'{}' holds no product: neither a run record (run.json) nor an ENVI file (.img)",
                            folder.string()));
  }
  return text;
}

}  // namespace

std::string describe_product(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw EnvironmentError(format("there is no '{}'", path.string()));
  if (std::filesystem::is_directory(path)) return describe_folder(path);
  if (ends_with(path, ".json")) return describe_record(path);
  if (ends_with(path, ".img") || ends_with(path, ".hdr")) return describe_envi(path);
  throw InputError(
      format("'{}' is no product that is known here; expected a folder, a run record (run.json) or an "
             "ENVI file (.img, .hdr)",
             path.string()));
}

}  // namespace ifov::cli
