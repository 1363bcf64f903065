#include "studies/temperature/solved_documents.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/thermal_document.h"
#include "math/angle.h"
#include "studies/common/study_document.h"
#include "studies/common/study_files.h"
#include "studies/common/study_options.h"

namespace ifov::studies {
namespace {

constexpr double kLatitude_rad = 52.0 * math::kDegree, kLongitude_rad = 5.0 * math::kDegree;

io::MaterialDocument solved_material_of(const std::string& name, std::vector<io::ThermalLayerDocument> layers,
                                        double absorptance, bool on_ground) {
  io::MaterialDocument material = black(name, {io::SolvedTemperatureDocument{}, {}});
  auto thermal = std::make_shared<io::ThermalDocument>();
  thermal->layers = std::move(layers);
  if (on_ground) thermal->back.ground = {285.15};
  thermal->solar_absorptance = absorptance;
  material.thermal = std::move(thermal);
  return material;
}

}  // namespace

io::Document kept_document(const io::Document& document, const std::string& name,
                           const StudyOptions& options) {
  const std::filesystem::path path = options.output_folder / (name + ".json");
  const std::string text = study_text(document);
  write_file(path, text);
  return io::parse_document(text, path.string());
}

std::string write_june(const StudyOptions& options, June june) {
  const bool sunny = june != June::still, directed = june != June::clear_without_direction;
  const std::string name = !sunny ? "still.csv" : directed ? "june.csv" : "june_without_direction.csv";
  std::string text =
      "time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2";
  text += directed ? ",wind_direction_deg\n" : "\n";
  for (int hour = 0; hour <= 48; ++hour) {
    constexpr double kTurn = std::numbers::pi / 12.0, kDeclination = 0.409;
    const double height =
        std::sin(kLatitude_rad) * std::sin(kDeclination) +
        std::cos(kLatitude_rad) * std::cos(kDeclination) * std::cos(kTurn * (hour + 0.3 - 12.0));
    text += format("2026-06-{:02d}T{:02d}:00:00Z,{:.2f},60,{},0,{:.1f}", 20 + hour / 24, hour % 24,
                   sunny ? 18.0 - 5.0 * std::cos(kTurn * (hour - 3.0)) : 16.85, sunny ? 2.5 : 1.0,
                   sunny ? std::max(0.0, 1000.0 * height - 30.0) : 0.0);
    text += directed ? format(",{:.0f}\n", 240.0 + 40.0 * std::sin(kTurn * (hour - 9.0))) : std::string("\n");
  }
  write_file(options.output_folder / name, text);
  return name;
}

io::Document solved_document(const std::string& weather, const std::string& hour, double step_s) {
  io::Document document =
      nadir_document(nadir_camera(24, 16, -12.0, 8.0), "thermal", 10.5, single_sampling(), 1);
  document.time = geodesy::parse_utc("2026-06-21T" + hour + ":00Z");
  document.scene.origin.geographic = {kLatitude_rad, kLongitude_rad};
  document.weather.emplace();
  document.weather->source.file = {weather, {}};
  auto how = std::make_shared<io::TemperaturesDocument>();
  how->spin_up_s = 86400.0;
  how->step_s = step_s;
  how->repeat_first_day = true;
  document.temperatures = std::move(how);
  document.scene.materials = {solved_material_of("road", {{0.1, "asphalt"}, {0.5, "dry soil"}}, 0.9, true),
                              solved_material_of("brick", {{0.2, "brick"}}, 0.7, false)};
  return document;
}

io::ObjectDocument solved_ground() { return object_of(io::PlanePrimitive(), "road"); }

io::ObjectDocument solved_box(math::Point3 low_m, math::Point3 high_m, const std::string& material) {
  io::BoxPrimitive box;
  box.low_m = low_m;
  box.high_m = high_m;
  return object_of(std::move(box), material);
}

}  // namespace ifov::studies
