#include "viewer/sources/open_run.h"

#include <sys/stat.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"
#include "ifov/products.h"
#include "io/envi/wavelength_unit.h"
#include "io/quantities/quantity.h"
#include "io/quantities/quantity_set.h"

namespace ifov::viewer {
namespace {

constexpr std::string_view kRecordEnding = "_run.json";

/// Files of a folder with an ending, sorted; none where it cannot be read.
std::vector<std::filesystem::path> files_with(const std::filesystem::path& folder, std::string_view ending) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().ends_with(ending)) found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> items_of(const io::EnviHeader& header, const std::string& key) {
  std::vector<std::string> items;
  const auto found = header.other.find(key);
  if (found == header.other.end()) return items;
  std::string_view rest = found->second;
  while (true) {
    const auto comma = rest.find(',');
    std::string_view item = rest.substr(0, comma);
    while (!item.empty() && std::string_view(" \n\r\t").find(item.front()) != std::string_view::npos)
      item.remove_prefix(1);
    items.emplace_back(item);
    if (comma == std::string_view::npos) return items;
    rest.remove_prefix(comma + 1);
  }
}

OpenRun::Cube open_cube(const std::filesystem::path& file, std::string name, std::string what,
                        const io::Quantity* quantity) {
  OpenRun::Cube cube{std::move(name), std::move(what), quantity, {}, {}, io::EnviReader(file)};
  const io::EnviHeader& header = cube.reader.header();
  if (!header.is_classification) return cube;
  cube.classes = items_of(header, "class names");
  for (const std::string& number : items_of(header, "class lookup")) {
    int value = 0;
    std::from_chars(number.data(), number.data() + number.size(), value);
    cube.class_colours.push_back(std::clamp(value, 0, 255));
  }
  cube.class_colours.resize(3 * cube.classes.size(), 128);
  return cube;
}

std::vector<Channel> channels_of(const io::EnviHeader& header) {
  std::vector<Channel> channels;
  const double um_per_unit = io::micrometres_per(header.wavelength_units).value_or(1.0);
  for (std::size_t b = 0; b < static_cast<std::size_t>(header.bands); ++b) {
    Channel channel{b < header.band_names.size() ? header.band_names[b] : format("band {}", b + 1)};
    if (b < header.wavelength.size()) channel.centre_um = um_per_unit * header.wavelength[b];
    if (b < header.fwhm.size()) channel.fwhm_um = um_per_unit * header.fwhm[b];
    channels.push_back(std::move(channel));
  }
  return channels;
}

void require_size(const OpenRun& run, const OpenRun::Cube& cube) {
  const io::EnviHeader& header = cube.reader.header();
  if (header.samples != run.width_px || header.lines != run.height_px)
    throw InputError(format("{}: {} x {} pixels; expected {} x {}, as the other cubes of the folder have",
                            cube.reader.data_path().string(), header.samples, header.lines, run.width_px,
                            run.height_px));
}

OpenRun of_record(const std::filesystem::path& folder, const std::filesystem::path& record) {
  const RunInfo info = run_info(record);
  OpenRun run{.folder = folder,
              .record = record,
              .document = info.document,
              .document_text = info.document_text,
              .unit = info.radiance_unit,
              .asked = info.accuracy_asked,
              .reached = info.accuracy_reached,
              .confidence = info.confidence,
              .width_px = info.width_px,
              .height_px = info.height_px};
  for (const std::string& note : info.notes) run.notes += run.notes.empty() ? note : "\n" + note;
  for (const RunInfo::Channel& channel : info.channels)
    run.channels.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  std::string stem = record.string();
  stem.resize(stem.size() - kRecordEnding.size());
  run.title = std::filesystem::path(stem).filename().string();
  // What the record lists is not taken as a name of a file: it may come from anybody.
  for (const io::Quantity* quantity : io::all_quantities()) {
    const std::filesystem::path file = stem + "_" + std::string(quantity->name) + ".img";
    if (!std::filesystem::exists(file)) continue;
    OpenRun::Cube cube = open_cube(file, std::string(quantity->name), std::string(quantity->what), quantity);
    require_size(run, cube);
    if (quantity->is_spectral() && cube.reader.header().bands != static_cast<int>(run.channels.size()))
      throw InputError(format("{}: {} bands; the run record {} has {} channels", file.string(),
                              cube.reader.header().bands, record.filename().string(), run.channels.size()));
    run.cubes.push_back(std::move(cube));
  }
  if (run.cube("radiance") == nullptr)
    throw SystemError(format("{}: there is no {}_radiance.img beside it", record.string(), run.title));
  return run;
}

OpenRun of_cubes(const std::filesystem::path& folder) {
  OpenRun run{.folder = folder, .title = folder.filename().string()};
  for (const std::filesystem::path& file : files_with(folder, ".img")) {
    OpenRun::Cube cube = open_cube(file, file.stem().string(), file.filename().string(), nullptr);
    const io::EnviHeader& header = cube.reader.header();
    if (run.cubes.empty()) run.width_px = header.samples, run.height_px = header.lines;
    require_size(run, cube);
    run.cubes.push_back(std::move(cube));
  }
  if (run.cubes.empty())
    throw InputError(format("'{}' holds no product: neither a run record (run.json) nor an ENVI file (.img)",
                            folder.string()));
  // The cube of the most bands is what spectra are taken from.
  const auto widest = std::max_element(run.cubes.begin(), run.cubes.end(),
                                       [](const OpenRun::Cube& a, const OpenRun::Cube& b) {
                                         return a.reader.header().bands < b.reader.header().bands;
                                       });
  std::iter_swap(run.cubes.begin(), widest);
  run.channels = channels_of(run.cubes.front().reader.header());
  run.unit = run.cubes.front().reader.header().data_units;
  return run;
}

}  // namespace

const OpenRun::Cube* OpenRun::cube(std::string_view name) const {
  for (const Cube& cube : cubes)
    if (cube.name == name) return &cube;
  return nullptr;
}

std::shared_ptr<const OpenRun> open_run(const std::filesystem::path& folder) {
  const auto records = files_with(folder, kRecordEnding);
  if (records.size() > 1)
    throw InputError(format("expected the products of one run; '{}' holds {} run records (NAME{})",
                            folder.string(), records.size(), kRecordEnding));
  return std::make_shared<const OpenRun>(records.empty() ? of_cubes(folder)
                                                         : of_record(folder, records.front()));
}

std::string signature_of(const std::filesystem::path& folder) {
  auto files = files_with(folder, kRecordEnding);
  if (files.empty()) files = files_with(folder, ".img");
  std::string signature;
  for (const std::filesystem::path& file : files) {
    struct stat status {};
    if (stat(file.c_str(), &status) == 0)
      signature += format("{} {} {}.{} {};", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                          status.st_mtim.tv_nsec, file.filename().string());
  }
  return signature;
}

}  // namespace ifov::viewer
