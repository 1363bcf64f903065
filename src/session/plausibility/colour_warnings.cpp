// What is said of reflectances that were made of colours.

#include <algorithm>
#include <string>

#include "core/format.h"
#include "session/assembly/shared/colour_guess.h"
#include "session/loaded/parts.h"
#include "session/plausibility/plausibility_warnings.h"

namespace ifov::session {
namespace {

constexpr double kFirstOfColours_um = 0.38, kLastOfColours_um = 0.78;
constexpr double kFarFromColours_um = 3.0;

std::string quoted(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 6;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMostNamed, names.size()); ++k)
    text += format("{}'{}'", k == 0 ? "" : ", ", names[k]);
  if (names.size() > kMostNamed) text += format(" and {} more", names.size() - kMostNamed);
  return text;
}

bool reaches_beyond(const radiometry::Channel& channel) {
  const double half = 0.5 * channel.fwhm_um;
  return channel.centre_um - half < kFirstOfColours_um || channel.centre_um + half > kLastOfColours_um;
}

}  // namespace

void warn_of_colours(const Parts& parts, LogSink& log) {
  std::vector<std::string> beyond, thermal;
  for (const radiometry::Channel& channel : parts.channels)
    if (reaches_beyond(channel))
      (channel.centre_um < kFarFromColours_um ? beyond : thermal).push_back(channel.name);
  for (const ColourGuess& guess : parts.colour_guesses) {
    const std::string of = format("{} of '{}'", quoted(guess.slots), guess.file);
    log.warn(format(
        "the reflectance of {} is a guess: made of colours (Jakob and Hanika 2019, as seen in daylight, D65), scattered as Lambert's "
        "law says. Real surfaces of a colour differ by 0.1 and more from each other, and intervals do not hold that",
        of));
    if (guess.beyond) continue;
    if (!beyond.empty())
      log.warn(format(
          "colours say nothing outside of 0.38 to 0.78 um: in {} the reflectance of {} is that of the nearest end, which may be off by "
          "any amount (leaves are dark red and bright in the near infrared). Give 'reflectance_beyond', or materials of the document",
          quoted(beyond), of));
    if (!thermal.empty())
      log.warn(format(
          "EMISSIVITY FROM A COLOUR: in {} the {} of {} is made of the reflectance at 0.78 um, and most real surfaces are nearly black "
          "there: radiances and temperatures are not to be trusted. Give 'reflectance_beyond' (0.05 suits most), or materials of the "
          "document",
          quoted(thermal), guess.emits ? "emissivity" : "reflectance", of));
  }
}

}  // namespace ifov::session
