#include "io/products/region_means.h"

#include "core/error.h"
#include "ifov/products.h"
#include "io/product_parts/map_info.h"
#include "sampling/intervals/bounded_error.h"
#include "session/runs/run_record_file.h"

namespace ifov {
namespace {

using session::Record;
using session::RunRecordFile;

constexpr std::string_view kRecordEnding = "_run.json";

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

std::vector<std::optional<render::AtmosphereHalfWidth>> air_of(const Record& run) {
  std::vector<std::optional<render::AtmosphereHalfWidth>> air;
  for (const Record& channel : run["channels"].items()) {
    const Record known = channel["air_half_width"];
    air.emplace_back();
    if (known["path"].is_number())
      air.back() = {known["path"].number(), known["surface"].number(), known["sky"].number(),
                    known["path_radiance"].number(), known["white_in_sky"].number()};
    const Record model = known["model"];
    if (!known["path"].is_number() || !model["surface"].is_number()) continue;
    air.back()->model_surface = model["surface"].number();
    air.back()->model_sunlight = model["sunlight"].number();
    air.back()->model_path = model["path"].number();
    air.back()->model_emission = model["emission"].number();
    air.back()->model_sky = model["sky"].number();
    air.back()->model_counted = model["in_interval"].boolean() ? 1.0 : 0.0;
  }
  return air;
}

RegionMean mean_of(const std::string& text, const io::RegionMeans& region, const Record& run) {
  RegionMean mean{text, region.pixels, region.converged, sampling::describe_reasons(region.reasons), {}};
  const std::vector<Record> channels = run["channels"].items();
  for (std::size_t c = 0; c < region.channels.size(); ++c)
    mean.channels.push_back({c < channels.size() ? channels[c]["name"].text() : format("band {}", c + 1),
                             region.channels[c].pixels, region.channels[c].mean,
                             region.channels[c].half_width});
  return mean;
}

}  // namespace

std::filesystem::path record_of(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw SystemError(format("there is no '{}'", path.string()));
  if (path.filename().string().ends_with(kRecordEnding)) return path;
  if (!std::filesystem::is_directory(path))
    throw InputError(format("expected a folder of products or a run record (NAME{}); found '{}'",
                            kRecordEnding, path.string()));
  std::vector<std::filesystem::path> records;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.path().filename().string().ends_with(kRecordEnding)) records.push_back(entry.path());
  if (records.size() != 1)
    throw InputError(format("expected the products of one run; '{}' holds {} run records (NAME{}){}",
                            path.string(), records.size(), kRecordEnding,
                            records.empty() ? session::where_runs_are(path) : std::string()));
  return records.front();
}

std::vector<RegionMean> region_means(const std::filesystem::path& products,
                                     const std::vector<std::string>& regions) {
  const std::filesystem::path record_path = record_of(products);
  const RunRecordFile file(record_path);
  const Record run = file.root();
  std::string stem = record_path.string();
  stem.resize(stem.size() - kRecordEnding.size());
  const io::ImageRegion::Image image = image_of(run["image"]);
  const sampling::RegionRule rule = rule_of(run);
  const auto air = air_of(run);
  const Record confidence = run["accuracy"]["confidence"];
  const sampling::BoundedError joint(confidence.is_number() ? confidence.number() : 0.95);
  std::vector<RegionMean> means;
  for (const std::string& region : regions)
    means.push_back(mean_of(
        region, io::region_means(stem, io::ImageRegion::parse(region, image), rule, joint, air), run));
  return means;
}

}  // namespace ifov
