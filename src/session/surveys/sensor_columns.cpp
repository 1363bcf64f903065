#include "session/surveys/sensor_columns.h"

#include <algorithm>

#include "ifov/sensor.h"
#include "io/document/sensor_document.h"
#include "io/document/spectrometer_document.h"
#include "sensor/spectrometer/column_responses.h"
#include "session/assembly/whole/across_track.h"

namespace ifov::session {
namespace {

SensorDescription::Channel::Range range_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

}  // namespace

void tell_columns(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                  const std::vector<radiometry::Channel>& channels, SensorDescription& told) {
  const auto smile = assemble_smile(sources, sensor, channels, told.width_px);
  const auto keystone = assemble_keystone(sources, sensor, channels, told.width_px);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    SensorDescription::Channel& one = told.channels[c];
    if (smile && !(*smile)[c].columns.centre_um.empty()) {
      one.centres_um = range_of((*smile)[c].columns.centre_um);
      one.fwhms_um = range_of((*smile)[c].columns.fwhm_um);
    }
    if (!keystone.empty() && !keystone[c].empty()) one.shift_px = range_of(keystone[c]);
  }
  if (!sensor.mosaic) return;
  for (const std::vector<io::DocumentName>& row : sensor.mosaic->rows) {
    told.mosaic += told.mosaic.empty() ? "(" : ", (";
    for (const io::DocumentName& name : row) told.mosaic += (&name == &row.front() ? "" : ", ") + name.name;
    told.mosaic += ')';
  }
}

}  // namespace ifov::session
