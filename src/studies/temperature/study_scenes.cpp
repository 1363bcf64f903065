#include "studies/temperature/study_scenes.h"

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/presence_document.h"
#include "io/document/thermal_document.h"
#include "studies/temperature/solved_documents.h"

namespace ifov::studies {
namespace {

/// The document's, to be changed.
std::shared_ptr<io::TemperaturesDocument> how_of(const io::Document& document) {
  return std::make_shared<io::TemperaturesDocument>(*document.temperatures);
}

geodesy::UtcTime before_15_h(int minutes) {
  const int minute = 15 * 60 - minutes;
  return geodesy::parse_utc(format("2026-06-21T{:02d}:{:02d}Z", minute / 60, minute % 60));
}

SolvedScenePtr loaded(const io::Document& document, const std::string& name, const StudyOptions& options) {
  return std::make_unique<const SolvedScene>(document, name, options);
}

}  // namespace

SolvedScenePtr pole_scene(const StudyOptions& options) {
  io::Document document = solved_document(write_june(options), "15:00");
  document.scene.objects = {solved_ground(), solved_box({-0.25, -0.25, 0.0}, {0.25, 0.25, 5.0}, "brick")};
  return loaded(document, "pole", options);
}

SolvedScenePtr car_scene(int came_min, int left_min, const StudyOptions& options) {
  io::Document document = solved_document(write_june(options), "15:00", 300.0);
  document.scene.objects = {solved_ground(), solved_box({-2.2, -0.9, 0.0}, {2.2, 0.9, 1.5}, "brick")};
  auto present = std::make_shared<io::PresenceDocument>();
  present->intervals = {{before_15_h(came_min), before_15_h(left_min)}};
  document.scene.objects[1].present = std::move(present);
  return loaded(document, format("car_{}_min", left_min), options);
}

SolvedScenePtr bare_scene(const StudyOptions& options) {
  io::Document document = solved_document(write_june(options), "15:00", 60.0);
  document.scene.objects = {solved_ground()};
  return loaded(document, "bare", options);
}

SolvedScenePtr roof_scene(bool suburb, const std::vector<double>& heights_m, const StudyOptions& options) {
  io::Document document = solved_document(write_june(options), "14:00");
  auto how = how_of(document);
  how->terrain = suburb ? "suburb" : "open";
  document.temperatures = std::move(how);
  document.scene.objects = {solved_ground()};
  for (std::size_t k = 0; k < heights_m.size(); ++k) {
    const double x_m = 1e4 * static_cast<double>(k + 1);
    document.scene.objects.push_back(solved_box({x_m, -6.0, 0.0}, {x_m + 12.0, 6.0, heights_m[k]}, "road"));
  }
  return loaded(document, suburb ? "roofs_suburb" : "roofs_open", options);
}

SolvedScenePtr room_scene(const StudyOptions& options) {
  io::Document document = solved_document(write_june(options, June::still), "15:00");
  document.scene.objects = {solved_box({-5.0, -5.0, 0.0}, {5.0, 5.0, 10.0}, "brick"),
                            solved_box({-1.0, -1.0, 3.0}, {1.0, 1.0, 5.0}, "brick")};
  auto how = how_of(document);
  how->spin_up_s = 9.0 * 86400.0;
  document.temperatures = std::move(how);
  return loaded(document, "room", options);
}

SolvedScenePtr suburb_scene(const std::string& hour, bool wind_direction, const std::string& name,
                            const StudyOptions& options) {
  return loaded(suburb_solved(hour, wind_direction ? June::clear : June::clear_without_direction, options),
                name, options);
}

}  // namespace ifov::studies
