#include <filesystem>

#include "core/format.h"
#include "core/machine_memory.h"
#include "io/document/document.h"
#include "studies/common/study_document.h"
#include "studies/sensor/sensor_checks.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

double memory_of_cube_gib(int pixels_across, int channels, const StudyOptions& options) {
  io::Document document = nadir_document(nadir_camera(pixels_across, pixels_across, 0.0, 0.0), "", 0.5,
                                         single_sampling(), options.seed);
  document.sensor.channels.clear();
  for (int k = 0; k < channels; ++k)
    document.sensor.channels.push_back(
        {format("c{}", k), io::MonochromaticChannel{8.0 + 4.0 * k / channels}, {}, {}, {}});
  document.scene.materials = {black("ground", {300.0, {}})};
  document.scene.objects = {level_ground("ground")};
  ask_for(document, {"location", "normal", "slope", "gsd", "view_angles"});
  std::filesystem::remove_all(run_sensor(document, "large", options));
  return static_cast<double>(peak_memory_bytes()) / (1024.0 * 1024.0 * 1024.0);
}

ReportSection memory_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Memory";
  section.text =
      "Plain ground in many channels with truth, a ray a pixel, into files; the most that this process has held until then, other sections' too.";
  const bool quick = options.study.is_quick();
  const int pixels = quick ? 256 : 2048, channels = quick ? 30 : 210;
  const double held = memory_of_cube_gib(pixels, channels, options.study);
  const std::string what = format("{} x {} pixels in {} channels with truth", pixels, pixels, channels);
  if (quick)
    section.figures.report("memory", held, "GiB", what);
  else
    section.figures.at_most("memory", held, 2.0, "GiB", what);
  return section;
}

}  // namespace ifov::studies
