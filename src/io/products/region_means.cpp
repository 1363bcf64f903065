#include "io/products/region_means.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/error.h"
#include "sampling/intervals/bounded_error.h"

namespace ifov::io {
namespace {

constexpr int kBorderShare = 3;  // band of the quality cube

std::filesystem::path cube(const std::filesystem::path& stem, const char* ending) {
  std::filesystem::path path = stem;
  return path += ending;
}

std::optional<EnviReader> open_if_there(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return EnviReader(path);
}

}  // namespace

RegionMeans region_means(const std::filesystem::path& stem, const ImageRegion& region,
                         const sampling::RegionRule& rule, const sampling::BoundedError& joint,
                         const std::vector<std::optional<render::AtmosphereHalfWidth>>& air) {
  for (const char* needed : {"_reasons.img", "_quality.img"})
    if (!std::filesystem::exists(cube(stem, needed)))
      throw InputError(
          format("there is no {}, which means over regions need; expected 'reasons' and 'quality' among "
                 "the document's output.products",
                 cube(stem, needed).string()));
  const EnviReader radiance(cube(stem, "_radiance.img")), reasons(cube(stem, "_reasons.img")),
      quality(cube(stem, "_quality.img"));
  const std::optional<EnviReader> half_width = open_if_there(cube(stem, "_half_width.img"));
  const auto width = static_cast<std::size_t>(radiance.header().samples);
  const int bands = radiance.header().bands;
  std::vector<sampling::RegionSum> sums(static_cast<std::size_t>(bands));
  std::vector<std::uint8_t> inside;
  std::vector<float> value(width), widths(width, std::numeric_limits<float>::quiet_NaN()),
      of_air(width, 0.0f), share(width);
  std::vector<sampling::Reasons> chosen;

  RegionMeans result;
  for (int line = region.first_line(); line < region.end_line(); ++line) {
    region.select(line, inside);
    reasons.read(line, 0, value);
    chosen.clear();
    for (std::size_t x = 0; x < width; ++x)
      if (inside[x] != 0) chosen.push_back(static_cast<sampling::Reasons>(value[x]));
    if (chosen.empty()) continue;
    result.pixels += chosen.size();
    result.converged +=
        static_cast<std::uint64_t>(std::count(chosen.begin(), chosen.end(), sampling::Reasons{0}));
    sampling::add_reasons(chosen, result.reasons);
    quality.read(line, kBorderShare, share);
    for (int band = 0; band < bands; ++band) {
      radiance.read(line, band, value);
      if (half_width) half_width->read(line, band, widths);
      if (const auto b = static_cast<std::size_t>(band); b < air.size() && air[b])
        std::transform(value.begin(), value.end(), of_air.begin(),
                       [&](float mean) { return static_cast<float>(air[b]->all_of(mean)); });
      else
        std::fill(of_air.begin(), of_air.end(), 0.0f);
      for (std::size_t x = 0; x < width; ++x)
        if (inside[x] != 0)
          sums[static_cast<std::size_t>(band)].add(value[x], joint.random(widths[x], of_air[x]), share[x],
                                                   std::min(of_air[x], widths[x]));
    }
  }
  for (const sampling::RegionSum& sum : sums)
    result.channels.push_back({sum.pixels(), sum.mean(), sum.half_width(rule, joint)});
  return result;
}

}  // namespace ifov::io
