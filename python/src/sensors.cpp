#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "ifov/document.h"
#include "ifov/sensor.h"

namespace ifov::python {

namespace nb = nanobind;

void add_sensors(nb::module_& module) {
  using Channel = SensorDescription::Channel;
  using Range = Channel::Range;
  nb::class_<Range>(module, "SensorRange").def_ro("least", &Range::least).def_ro("most", &Range::most);
  nb::class_<Channel>(module, "SensorChannel")
      .def_ro("name", &Channel::name)
      .def_ro("centre_um", &Channel::centre_um)
      .def_ro("fwhm_um", &Channel::fwhm_um)
      .def_ro("pixel_mtf", &Channel::pixel_mtf)
      .def_ro("psf_mtf", &Channel::psf_mtf)
      .def_ro("diffraction_mtf", &Channel::diffraction_mtf)
      .def_ro("has_detector", &Channel::has_detector)
      .def_ro("radiance", &Channel::radiance)
      .def_ro("photons", &Channel::photons)
      .def_ro("electrons", &Channel::electrons)
      .def_ro("background", &Channel::background)
      .def_ro("dark", &Channel::dark)
      .def_ro("well_share", &Channel::well_share)
      .def_ro("snr", &Channel::snr)
      .def_ro("nedl", &Channel::nedl)
      .def_ro("nedt", &Channel::nedt)
      .def_ro("nedt_at_k", &Channel::nedt_at_k)
      .def_ro("centres_um", &Channel::centres_um)
      .def_ro("fwhms_um", &Channel::fwhms_um)
      .def_ro("shift_px", &Channel::shift_px)
      .def_ro("step_share", &Channel::step_share)
      .def_ro("memory_mtf", &Channel::memory_mtf)
      .def_ro("corner_light", &Channel::corner_light)
      .def_ro("corner_snr", &Channel::corner_snr)
      .def_ro("corner_nedt", &Channel::corner_nedt)
      .def_ro("correction_left", &Channel::correction_left);
  nb::class_<SensorDescription>(module, "SensorDescription")
      .def_ro("width_px", &SensorDescription::width_px)
      .def_ro("height_px", &SensorDescription::height_px)
      .def_ro("gsd_m", &SensorDescription::gsd_m)
      .def_ro("swath_m", &SensorDescription::swath_m)
      .def_ro("ifov_rad", &SensorDescription::ifov_rad)
      .def_ro("f_number", &SensorDescription::f_number)
      .def_ro("smear_px", &SensorDescription::smear_px)
      .def_ro("row_shift_px", &SensorDescription::row_shift_px)
      .def_ro("channels", &SensorDescription::channels)
      .def_ro("mosaic", &SensorDescription::mosaic);
  nb::class_<SensorPresetInfo>(module, "SensorPreset")
      .def_ro("name", &SensorPresetInfo::name)
      .def_ro("about", &SensorPresetInfo::about)
      .def_ro("also", &SensorPresetInfo::also)
      .def_ro("bands", &SensorPresetInfo::bands)
      .def_ro("first_um", &SensorPresetInfo::first_um)
      .def_ro("last_um", &SensorPresetInfo::last_um)
      .def_ro("noise", &SensorPresetInfo::noise)
      .def_ro("ground", &SensorPresetInfo::ground)
      .def_ro("sources", &SensorPresetInfo::sources)
      .def_ro("document", &SensorPresetInfo::document);
  module.def("describe_sensor", &describe_sensor, nb::arg("document"));
  module.def("sensor_preset_list", &sensor_preset_list);
  module.def("find_sensor_preset", &find_sensor_preset, nb::arg("name"));
}

}  // namespace ifov::python
