#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/table_speed.h"

namespace ifov::studies {

AtmosphereSection speed_section(const SectionOptions&) {
  AtmosphereSection section;
  section.title = "Speed";
  section.text =
      "Time to build the tables of a sensor from nothing, with polarized scattering and the estimate of its "
      "own "
      "errors: processor seconds of two threads, halved, which is the time that passes where nothing else "
      "runs. "
      "Memory, and what the atmosphere adds to a path, are measured by `make bench BENCH=atmosphere`.";
  constexpr int kThreads = 2;
  const auto add = [&](const char* name, const std::vector<radiometry::Channel>& channels, double most_s,
                       const char* meaning) {
    section.figures.at_most(name, time_tables(channels, kThreads).cpu_seconds / kThreads, most_s, "s",
                            meaning);
  };
  add("tables_vswir_s", timed_vswir(), 60.0, "210 channels of 10 nm, 0.4 to 2.5 um");
  add("tables_thermal_s", timed_thermal(), 20.0, "10 thermal channels, 8 to 12.5 um");
  add("tables_multispectral_s", timed_multispectral(), 2.0, "9 multispectral channels, nadir");
  return section;
}

}  // namespace ifov::studies
