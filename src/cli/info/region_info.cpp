#include "cli/info/region_info.h"

#include <cmath>

#include "cli/info/run_record_file.h"
#include "core/error.h"
#include "io/product_parts/map_info.h"
#include "io/products/region_means.h"

namespace ifov::cli {
namespace {

constexpr std::string_view kRecordEnding = "_run.json";

std::filesystem::path record_in(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw EnvironmentError(format("there is no '{}'", path.string()));
  if (path.filename().string().ends_with(kRecordEnding)) return path;
  if (!std::filesystem::is_directory(path))
    throw InputError(format("--region needs a folder of products or a run record (NAME{}); found '{}'",
                            kRecordEnding, path.string()));
  std::vector<std::filesystem::path> records;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.path().filename().string().ends_with(kRecordEnding)) records.push_back(entry.path());
  if (records.size() != 1)
    throw InputError(format("--region needs the products of one run; '{}' holds {} run records (NAME{})",
                            path.string(), records.size(), kRecordEnding));
  return records.front();
}

io::ImageRegion::Image image_of(const Record& image) {
  io::ImageRegion::Image result;
  result.width_px = static_cast<int>(image["width_px"].number());
  result.height_px = static_cast<int>(image["height_px"].number());
  if (const Record map = image["map"]; map["gsd_m"].is_number()) {
    render::ImageInfo info;
    info.map_x_m = map["upper_left_x_m"].number();
    info.map_y_m = map["upper_left_y_m"].number();
    info.gsd_m = map["gsd_m"].number();
    info.map_rotation_rad = map["rotation_rad"].number();
    result.map = io::geotransform(info);
  }
  return result;
}

sampling::RegionRule rule_of(const Record& run) {
  return run["sampler"].text() == "accuracy"
             ? sampling::RegionRule::of_accuracy(run["image"]["footprint_px"].number())
             : sampling::RegionRule::all_common();
}

std::vector<std::optional<render::AirHalfWidth>> air_of(const Record& run) {
  std::vector<std::optional<render::AirHalfWidth>> air;
  for (const Record& channel : run["channels"].items()) {
    const Record known = channel["air_half_width"];
    air.emplace_back();
    if (known["path"].is_number())
      air.back() = {known["path"].number(), known["surface"].number(), known["sky"].number(),
                    known["path_radiance"].number(), known["white_in_sky"].number()};
  }
  return air;
}

std::string share(std::uint64_t part, std::uint64_t all) {
  return format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string lines_of(const std::string& text, const io::RegionMeans& region, const Record& run) {
  const std::uint64_t missed = region.pixels - region.converged;
  std::string lines = format("region {}: {} pixel{}", text, region.pixels, region.pixels == 1 ? "" : "s");
  if (run["accuracy"]["asked"].text().empty())
    lines += "\n";
  else if (missed == 0)
    lines += ", all converged\n";
  else
    lines += format(", {} not converged ({}): {}\n", missed, share(missed, region.pixels),
                    sampling::describe_reasons(region.reasons));
  const std::vector<Record> channels = run["channels"].items();
  const std::string unit = run["image"]["radiance_unit"].text();
  for (std::size_t c = 0; c < region.channels.size(); ++c) {
    const io::RegionMeans::Channel& channel = region.channels[c];
    lines += format("  {:<16} ", c < channels.size() ? channels[c]["name"].text() : format("band {}", c + 1));
    if (channel.pixels == 0) {
      lines += "no value\n";
      continue;
    }
    lines += std::isfinite(channel.half_width)
                 ? format("{:.6g} +- {:.3g} {} ({:.3g} %)", channel.mean, channel.half_width, unit,
                          100.0 * channel.half_width / std::abs(channel.mean))
                 : format("{:.6g} {}, of unknown error", channel.mean, unit);
    if (channel.pixels < region.pixels)
      lines += format(", {} pixels hold no value", region.pixels - channel.pixels);
    lines += "\n";
  }
  return lines;
}

}  // namespace

std::string describe_regions(const std::filesystem::path& path, const std::vector<std::string>& regions) {
  const std::filesystem::path record_path = record_in(path);
  const RunRecordFile file(record_path);
  const Record run = file.root();
  std::string stem = record_path.string();
  stem.resize(stem.size() - kRecordEnding.size());
  const io::ImageRegion::Image image = image_of(run["image"]);
  const sampling::RegionRule rule = rule_of(run);
  const auto air = air_of(run);
  std::string text = format("{}\nmeans and half-widths at {:g} % confidence\n", record_path.string(),
                            100.0 * run["accuracy"]["confidence"].number());
  for (const std::string& region : regions)
    text += lines_of(region, io::region_means(stem, io::ImageRegion::parse(region, image), rule, air), run);
  return text;
}

}  // namespace ifov::cli
