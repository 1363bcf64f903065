#include "cli/info/region_info.h"

#include <cmath>

#include "core/format.h"
#include "ifov/products.h"
#include "ifov/series.h"

namespace ifov::cli {
namespace {

std::string share(std::uint64_t part, std::uint64_t all) {
  return format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string lines_of(const RegionMean& region, const RunInfo& run) {
  const std::uint64_t missed = region.pixels - region.converged;
  std::string lines =
      format("region {}: {} pixel{}", region.region, region.pixels, region.pixels == 1 ? "" : "s");
  if (run.accuracy_asked.empty())
    lines += "\n";
  else if (missed == 0)
    lines += ", all converged\n";
  else
    lines += format(", {} not converged ({}): {}\n", missed, share(missed, region.pixels), region.reasons);
  for (const RegionMean::Channel& channel : region.channels) {
    lines += format("  {:<16} ", channel.name);
    if (channel.pixels == 0) {
      lines += "no value\n";
      continue;
    }
    lines += std::isfinite(channel.half_width)
                 ? format("{:.6g} +- {:.3g} {} ({:.3g} %)", channel.mean, channel.half_width,
                          run.radiance_unit, 100.0 * channel.half_width / std::abs(channel.mean))
                 : format("{:.6g} {}, of unknown error", channel.mean, run.radiance_unit);
    if (channel.pixels < region.pixels)
      lines += format(", {} pixels hold no value", region.pixels - channel.pixels);
    lines += "\n";
  }
  return lines;
}

std::string describe_run(const std::filesystem::path& path, const std::vector<std::string>& regions) {
  const RunInfo run = run_info(record_of(path));
  std::string text =
      format("{}\nmeans and half-widths at {:g} % confidence\n", run.path.string(), 100.0 * run.confidence);
  for (const RegionMean& region : region_means(path, regions)) text += lines_of(region, run);
  return text;
}

}  // namespace

std::string describe_regions(const std::filesystem::path& path, const std::vector<std::string>& regions) {
  const auto series = std::filesystem::is_directory(path) ? series_info(path) : std::nullopt;
  if (!series) return describe_run(path, regions);
  std::string text;
  for (const SeriesInfo::Time& one : series->times)
    if (!one.record.empty())
      text += format("{}{}: {}", text.empty() ? "" : "\n", one.time, describe_run(one.record, regions));
  return text.empty() ? format("{}: none of {} times is made yet\n", path.string(), series->times.size())
                      : text;
}

}  // namespace ifov::cli
