#include "session/assembly/surfaces/parameter_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/error.h"
#include "io/document/parameter_map_document.h"
#include "io/raster/raster.h"
#include "materials/bsdf/bsdf_model.h"
#include "session/assembly/shared/raster_assembly.h"

namespace ifov::session {
namespace {

/// The unit in which a parameter's range is told.
struct RangeUnit {
  double si = 1.0;
  std::string_view name = {};
};
RangeUnit range_unit(const materials::BsdfParameter& parameter) {
  if (parameter.form == materials::BsdfParameter::Form::angle) return {std::numbers::pi / 180.0, " deg"};
  if (parameter.form == materials::BsdfParameter::Form::length) return {1e-3, " mm"};
  return {};
}

}  // namespace

ParameterValues parameter_values(const io::ParameterMap& map, const io::Raster& raster,
                                 const materials::BsdfParameter& parameter) {
  constexpr double kRounding = 1e-6;  // of single precision
  const std::string& path = map.raster.file.path;
  const std::span<const float> numbers = band_of(raster, map.band, path);
  const RangeUnit unit = range_unit(parameter);
  const double slack = kRounding * std::max(std::abs(parameter.low), std::abs(parameter.high));
  ParameterValues found;
  found.by_cell.reserve(numbers.size());
  for (std::size_t cell = 0; cell < numbers.size(); ++cell) {
    const auto place = [&] {
      const auto width = static_cast<std::size_t>(raster.width);
      return format("row {}, column {} of '{}'{}", cell / width + 1, cell % width + 1, path,
                    map.band > 1 ? format(" (band {})", map.band) : "");
    };
    const float number = numbers[cell];
    if (!std::isfinite(number) || (raster.nodata && number == static_cast<float>(*raster.nodata)))
      throw InputError(
          format("no number at {}: a map of '{}' needs one in every cell", place(), parameter.key));
    const double value = (static_cast<double>(number) * map.unit + map.offset) / unit.si;
    if (!(value >= parameter.low - slack && value <= parameter.high + slack))
      throw InputError(format("{:g} at {} makes '{}' {:g}{}; it lies between {:g} and {:g}{}", number,
                              place(), parameter.key, value, unit.name, parameter.low, parameter.high,
                              unit.name));
    const double held = std::clamp(value, parameter.low, parameter.high) * unit.si;
    found.by_cell.push_back(static_cast<float>(held));
    found.mean += static_cast<double>(found.by_cell.back()) / static_cast<double>(numbers.size());
  }
  found.distinct.assign(found.by_cell.begin(), found.by_cell.end());
  std::sort(found.distinct.begin(), found.distinct.end());
  found.distinct.erase(std::unique(found.distinct.begin(), found.distinct.end()), found.distinct.end());
  // A sum of many rounds.
  found.mean = std::clamp(found.mean, found.distinct.front(), found.distinct.back());
  return found;
}

}  // namespace ifov::session
