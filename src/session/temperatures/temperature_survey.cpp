#include "session/temperatures/temperature_survey.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/names.h"
#include "core/parallel.h"
#include "io/document/document.h"
#include "io/document/thermal_document.h"
#include "materials/material.h"
#include "math/angle.h"
#include "session/assembly/atmosphere/weather_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/surfaces/thermal_assembly.h"
#include "session/one_material.h"
#include "session/solved/document_outdoors.h"
#include "session/temperatures/reported_day.h"
#include "thermal/outdoors_series.h"

namespace ifov::session {
namespace {

struct Named {
  std::string name;
  ThermalMaterial thermal;
};

/// Materials that are asked for, or all that say what their temperature follows from.
std::vector<Named> materials_of(const io::Document& document, const std::vector<std::string>& asked,
                                double deep_k, std::vector<std::string>& notes) {
  std::vector<Named> found;
  std::vector<std::string> left_out;
  for (const std::string& name : asked) find_material(document, name);
  for (const io::MaterialDocument& source : document.scene.materials) {
    if (!asked.empty() && std::find(asked.begin(), asked.end(), source.name) == asked.end()) continue;
    if (source.sides) continue;  // of two others
    const materials::Material optics = assemble_material(document, source, 1);
    if (auto material = assemble_thermal(document.sources, source, optics, deep_k))
      found.push_back({source.name, std::move(*material)});
    else if (asked.empty())
      left_out.push_back(source.name);
    else
      throw io::document_error(
          document.sources, source.position,
          format("'{}' has neither \"thermal\" nor a reflectance of the library, of which it is known "
                 "what it stands on: its temperature cannot be solved for",
                 source.name));
  }
  if (found.empty())
    throw InputError(format(
        "{}: no material has \"thermal\" or a reflectance of the library ({}): there is no temperature "
        "to solve for",
        document.sources.file_name, list_names(left_out, "and", 8)));
  if (!left_out.empty())
    notes.push_back(format("left out, having neither \"thermal\" nor a reflectance of the library: {}",
                           list_names(left_out, "and", 8)));
  return found;
}

std::string stand_text(const TemperatureQuestion& question, const thermal::Stand& stand) {
  std::string text =
      question.slope_rad > 0.0
          ? format(
                "surfaces slope by {:g} deg and face {:g} deg from north; the ground about them is as warm as "
                "the air and reflects {:g}",
                question.slope_rad / math::kDegree, question.azimuth_rad / math::kDegree,
                stand.ground_reflectance)
          : std::string("surfaces are level");
  return text + format(", {:g} m above {} terrain", stand.height_m, thermal::name_of(stand.terrain));
}

}  // namespace

DocumentOutdoors outdoors_of_survey(const io::Document& document) {
  const std::string& file = document.sources.file_name;
  if (!document.time)
    throw InputError(
        format("{}: surface temperatures need a \"time\": the 24 hours before it are shown", file));
  if (!document.weather)
    throw InputError(format(
        "{}: surface temperatures need \"weather\": a file with air temperature, wind and sunlight, such as "
        "\"weather\": {{\"file\": \"amsterdam.epw\"}}",
        file));
  return outdoors_of_document(document,
                              *assemble_weather(document.sources, *document.weather, document.time));
}

io::TemperatureReport survey_temperatures(const io::Document& document, const TemperatureQuestion& question) {
  const DocumentOutdoors about = outdoors_of_survey(document);
  const thermal::OutdoorsSeries& series = about.outdoors.series;
  thermal::Stand stand;
  stand.tilt_rad = question.slope_rad;
  stand.azimuth_rad = question.azimuth_rad;
  stand.height_m = question.height_m;
  stand.terrain = about.terrain;
  io::TemperatureReport report = report_about(document.sources.file_name, about);
  report.notes.push_back(stand_text(question, stand));

  const std::vector<Named> materials =
      materials_of(document, question.materials, about.mean_air_k, report.notes);
  report.materials.resize(materials.size());
  parallel_for(static_cast<std::int64_t>(materials.size()), 0, [&](std::int64_t index) {
    const Named& source = materials[static_cast<std::size_t>(index)];
    const ThermalMaterial& thermal = source.thermal;
    const auto solve = [&](double visibility) {
      return thermal::solve_surface(thermal.solid, thermal.skin, stand, series, thermal.start,
                                    std::vector<double>(series.rows.size(), visibility));
    };
    const thermal::SurfaceSolution sunlit = solve(1.0);
    report.materials[static_cast<std::size_t>(index)] = {source.name,
                                                         thermal.description,
                                                         day_of(sunlit, about),
                                                         day_of(solve(0.0), about),
                                                         unaccounted_of(sunlit),
                                                         {}};
  });
  report.crossovers = io::crossovers_of(report);
  return report;
}

}  // namespace ifov::session
