#include <algorithm>

#include "io/document/document.h"
#include "io/document/thermal_document.h"
#include "studies/common/suburb_scene.h"
#include "studies/temperature/solved_documents.h"

namespace ifov::studies {
namespace {

/// What a material of the suburb stands on, by what its name says.
struct MadeOf {
  const char* word;
  std::vector<io::ThermalLayerDocument> layers;
  bool on_ground;
};
const std::vector<MadeOf>& made_of() {
  static const std::vector<MadeOf> kMadeOf{
      {"asphalt", {{0.06, "asphalt"}, {0.3, "gravel"}, {1.0, "dry soil"}}, true},
      {"road paint", {{0.06, "asphalt"}, {0.3, "gravel"}, {1.0, "dry soil"}}, true},
      {"court", {{0.05, "asphalt"}, {0.3, "gravel"}, {1.0, "dry soil"}}, true},
      {"concrete", {{0.12, "concrete"}, {1.0, "dry soil"}}, true},
      {"water", {{1.5, "mixed water"}, {0.2, "concrete"}, {1.0, "moist soil"}}, true},
      {"lawn", {{1.0, "moist soil"}}, true},
      {"clover", {{1.0, "moist soil"}}, true},
      {"soil", {{1.0, "dry soil"}}, true},
      {"shingle", {{0.005, "bitumen"}, {0.02, "softwood"}, {0.2, "insulation"}}, false},
      {"tile", {{0.015, "concrete tile"}, {0.2, "insulation"}}, false},
      {"brick", {{0.1, "brick"}, {0.1, "insulation"}, {0.1, "brick"}}, false},
      {"paint", {{0.02, "mortar"}, {0.2, "brick"}}, false},
      {"glass", {{0.004, "glass"}}, false},
      {"car", {{0.001, "steel"}}, false},
      {"steel", {{0.003, "steel"}}, false},
      {"aluminium", {{0.002, "aluminium"}}, false},
      {"", {{0.04, "softwood"}}, false}};
  return kMadeOf;
}

}  // namespace

io::Document suburb_solved(const std::string& hour, June june, const StudyOptions& options) {
  io::Document document = suburb_document(options, true);
  const io::Document like = solved_document(write_june(options, june), hour);
  document.time = like.time;
  document.scene.origin = like.scene.origin;
  document.weather = like.weather;
  document.temperatures = like.temperatures;
  document.sensor.channels = like.sensor.channels;
  document.sampling = like.sampling;
  document.atmosphere = {};
  document.output.quicklook_channels.clear();
  for (io::MaterialDocument& material : document.scene.materials) {
    if (material.transmittance || material.sides || material.name.rfind("leaf", 0) == 0) continue;
    const auto found = std::find_if(made_of().begin(), made_of().end(), [&](const MadeOf& one) {
      return material.name.find(one.word) != std::string::npos;
    });
    auto thermal = std::make_shared<io::ThermalDocument>();
    thermal->layers = found->layers;
    if (found->on_ground) thermal->back.ground = {std::nullopt};
    if (material.name.find("lawn") != std::string::npos) {
      thermal->wetness = 1.0;
      thermal->resistance_s_m = 70.0;
      thermal->roughness = "very rough";
    }
    material.thermal = std::move(thermal);
    material.temperature = io::TemperatureDocument{io::SolvedTemperatureDocument{}, {}};
  }
  return document;
}

}  // namespace ifov::studies
