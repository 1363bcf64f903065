#pragma once

#include <string>

#include "math/vec3.h"
#include "studies/temperature/kept_document.h"

namespace ifov::io {
struct Document;
struct ObjectDocument;
struct TemperatureReport;
}  // namespace ifov::io

namespace ifov::studies {

struct StudyOptions;

/// Days of June at 52 N, 5 E: clear, with 2.5 m/s of wind from the south-west that turns by day; the same where nobody told from where it
/// blows; without Sun, in air of 290 K that hardly moves.
enum class June { clear, clear_without_direction, still };
/// Two of them hour by hour in a file of the study's folder; its name there.
std::string write_june(const StudyOptions& options, June june = June::clear);

/// A scene of `road` (asphalt on soil) and `brick`, both solved and black, under that weather, seen from above. `hour`: "15:00".
io::Document solved_document(const std::string& weather, const std::string& hour, double step_s = 600.0);
io::ObjectDocument solved_ground();
io::ObjectDocument solved_box(math::Point3 low_m, math::Point3 high_m, const std::string& material);
/// A suburb whose opaque materials are solved for, by what their names say they are made of, under that weather.
io::Document suburb_solved(const std::string& hour, June june, const StudyOptions& options);

/// What `ifov temperature` tells of it.
io::TemperatureReport surveyed_day(const io::Document& document, const std::string& name,
                                   const StudyOptions& options);

}  // namespace ifov::studies
