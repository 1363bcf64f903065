#include "ifov/products.h"

#include <algorithm>

#include "core/error.h"
#include "io/envi/cube_layout.h"
#include "io/files/mapped_file.h"
#include "io/products/envi_reader.h"
#include "io/products/part_file.h"
#include "io/products/region_means.h"
#include "sampling/reason_words.h"
#include "session/runs/run_record_file.h"

namespace ifov {
namespace {

using session::Record;

std::string text_of(const Record& value) { return value.text(""); }

std::optional<double> number_of(const Record& value) {
  return value.is_number() ? std::optional<double>(value.number()) : std::nullopt;
}

RunInfo::Channel channel_of(const Record& channel) {
  return {text_of(channel["name"]),
          channel["centre_um"].number(),
          channel["fwhm_um"].number(),
          number_of(channel["minimum"]),
          number_of(channel["maximum"]),
          number_of(channel["mean"]),
          number_of(channel["mean_half_width"]),
          channel["noise"].number()};
}

std::string reasons_of(const Record& by_reason) {
  sampling::ReasonCounts counts{};
  for (std::size_t r = 0; r < counts.size(); ++r)
    counts[r] = static_cast<std::uint64_t>(by_reason[std::string(sampling::kReasonNames[r])].number());
  return sampling::describe_reasons(counts);
}

bool ends_with(const std::filesystem::path& path, std::string_view ending) {
  return path.filename().string().ends_with(ending);
}

}  // namespace

RunInfo run_info(const std::filesystem::path& path) {
  const session::RunRecordFile file(path);
  const Record run = file.root();
  const Record image = run["image"], accuracy = run["accuracy"], cost = run["cost"];
  RunInfo info;
  info.path = path;
  info.version = text_of(run["program"]["version"]);
  info.sampler = text_of(run["sampler"]);
  info.document = text_of(run["document"]["path"]);
  info.document_text = text_of(run["document"]["text"]);
  info.seed = run["seed"].natural();
  info.width_px = image["width_px"].small_integer();
  info.height_px = image["height_px"].small_integer();
  info.radiance_unit = text_of(image["radiance_unit"]);
  for (const Record& channel : run["channels"].items()) info.channels.push_back(channel_of(channel));
  info.accuracy_asked = text_of(accuracy["asked"]);
  info.accuracy_reached = text_of(accuracy["reached"]);
  info.confidence = accuracy["confidence"].number();
  if (accuracy["pixels"].is_number()) info.pixels = accuracy["pixels"].natural();
  info.pixels_converged = accuracy["pixels_converged"].natural();
  info.worst_error_ratio = accuracy["worst_ratio"].number();
  info.reasons = reasons_of(accuracy["pixels_by_reason"]);
  info.detection = text_of(accuracy["detection"]);
  info.rays = cost["rays"]["total"].number();
  info.samples = cost["samples"]["total"].number();
  info.elapsed_s = cost["elapsed_s"].number();
  for (const Record& note : run["notes"].items()) info.notes.push_back(text_of(note));
  for (const Record& made : run["files"].items())
    info.files.push_back(
        {text_of(made["name"]), text_of(made["what"]), made["bytes"].natural(), text_of(made["sha256"])});
  return info;
}

CubeInfo cube_info(const std::filesystem::path& file) {
  const io::EnviReader reader(file);
  const io::EnviHeader& header = reader.header();
  return {.path = reader.data_path(),
          .description = header.description,
          .unit = header.data_units,
          .width_px = header.samples,
          .height_px = header.lines,
          .bands = header.bands,
          .bytes_per_value = static_cast<int>(io::bytes_per_value(header.data_type)),
          .interleave = std::string(io::name_of(header.interleave)),
          .map_info = header.map_info,
          .band_names = header.band_names,
          .wavelength = header.wavelength,
          .fwhm = header.fwhm,
          .wavelength_unit = header.wavelength_units};
}

std::vector<std::filesystem::path> products_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) throw SystemError(format("cannot read '{}': {}", folder.string(), error.message()));
  std::vector<std::filesystem::path> records, cubes;
  for (const auto& entry : entries) {
    if (ends_with(entry.path(), "run.json")) records.push_back(entry.path());
    if (ends_with(entry.path(), ".img")) cubes.push_back(entry.path());
  }
  std::vector<std::filesystem::path>& found = records.empty() ? cubes : records;
  if (found.empty())
    throw InputError(
        format("'{}' holds no product: neither a run record (run.json) nor an ENVI file (.img){}",
               folder.string(), session::where_runs_are(folder)));
  std::sort(found.begin(), found.end());
  return found;
}

void write_file(const std::filesystem::path& path, const std::string& content) {
  io::PartFile file(path);
  io::write_part(file, content);
  file.publish();
}

const char* mapped_input_at(const void* address) { return io::mapped_file_at(address); }

}  // namespace ifov
