#include <cmath>

#include "core/format.h"
#include "radiometry/channel.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/rendered_checks.h"

namespace ifov::studies {

AtmosphereSection rendered_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Rendered";
  section.text =
      "Documents, rendered as any other. A closed room of 300 K, its floor and walls of emissivity 0.6 and "
      "0.8, in air of "
      "300 K must look like a black body of 300 K in every channel. On a uniform plain, paths that differ in "
      "the direction "
      "of the sky that they meet may differ in radiance; lines of absorption must add nothing to that.";
  for (const EnclosureChannel& channel : render_enclosure(options.study)) {
    section.figures.at_most(format("enclosure_{:g}um", channel.centre_um),
                            std::abs(channel.mean - channel.planck) / channel.standard_error, 3.0,
                            "standard errors",
                            format("room of 300 K at {:g} um: {:.5g} W m-2 sr-1 um-1, Planck's law {:.5g}",
                                   channel.centre_um, channel.mean, channel.planck));
  }
  const std::vector<PlainChannel> plain = render_plain(options.study);
  for (const PlainChannel& channel : plain) {
    const std::string name = format("plain_{:.0f}nm", 1e3 * channel.centre_um);
    const std::string meaning = format(
        "relative standard deviation of single paths over a plain at {:.0f} nm", 1e3 * channel.centre_um);
    if (&channel == plain.data())
      section.figures.report(name, channel.relative_deviation, "", meaning);
    else
      section.figures.at_most(name, channel.relative_deviation, 1.1 * plain.front().relative_deviation, "",
                              meaning);
    section.figures.report(name + "_one_term", channel.drawn_deviation, "",
                           "what it would be if every path drew one term of absorption at random");
  }
  return section;
}

}  // namespace ifov::studies
