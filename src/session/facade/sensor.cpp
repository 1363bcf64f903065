#include "ifov/sensor.h"

#include <cmath>

#include "core/call_scope.h"
#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "io/files/inputs.h"
#include "io/library/sensor_presets.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/surveys/sensor_survey.h"

namespace ifov {
namespace {

SensorPresetInfo told(const io::SensorPreset& preset) {
  const auto [first_um, last_um] = preset.range_um();
  return {preset.name, preset.about, preset.also,         preset.sources, preset.channel_count(),
          first_um,    last_um,      preset.noise_text(), preset.ground,  io::preset_text(preset)};
}

}  // namespace

SensorDescription describe_sensor(const Document& document) {
  const auto& inside = FacadeAccess::inside(document);
  const Call call{inside.inputs};
  const CallScope scope(call);
  return session::survey_sensor(inside.document.sources, inside.document.sensor,
                                inside.document.scene.origin);
}

std::vector<SensorPresetInfo> sensor_preset_list() {
  std::vector<SensorPresetInfo> all;
  for (const io::SensorPreset& preset : io::sensor_presets()) all.push_back(told(preset));
  return all;
}

SensorPresetInfo find_sensor_preset(const std::string& name) { return told(io::sensor_preset(name)); }

}  // namespace ifov
