#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/table_speed.h"

namespace ifov::studies {

AtmosphereSection speed_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Speed";
  section.text =
      "Time to build the tables of a sensor from nothing, with polarized scattering and the estimate of its "
      "own "
      "errors: processor seconds of two threads, halved, which is the time that passes where nothing else "
      "runs. "
      "Memory, and what the atmosphere adds to a path, are measured by `make bench BENCH=atmosphere`.";
  constexpr int kThreads = 2;
  // A quick look times a part of the channels, where there are many.
  const auto add = [&](const char* name, const std::vector<radiometry::Channel>& channels, std::size_t step,
                       double most_s, const char* meaning) {
    std::vector<radiometry::Channel> timed;
    for (std::size_t k = 0; k < channels.size(); k += options.study.is_quick() ? step : 1)
      timed.push_back(channels[k]);
    const double share = static_cast<double>(timed.size()) / static_cast<double>(channels.size());
    section.figures.at_most(name, time_tables(timed, kThreads).cpu_seconds / kThreads, share * most_s, "s",
                            format("{} {}", timed.size(), meaning));
  };
  add("tables_vswir_s", timed_vswir(), 10, 60.0, "channels of 10 nm, 0.4 to 2.5 um");
  add("tables_thermal_s", timed_thermal(), 1, 20.0, "thermal channels, 8 to 12.5 um");
  add("tables_multispectral_s", timed_multispectral(), 1, 2.0, "multispectral channels, nadir");
  return section;
}

}  // namespace ifov::studies
