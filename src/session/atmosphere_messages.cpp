#include "session/atmosphere_messages.h"

#include <algorithm>

#include "core/format.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "session/loaded/parts.h"

namespace ifov::session {
namespace {

std::string in_units(const render::AccuracyRequest& request, double error) {
  switch (request.unit) {
    case render::ErrorUnit::kelvin: return format("{:.2g} K", error);
    case render::ErrorUnit::radiance: return format("{:.2g} W m-2 sr-1 um-1", error);
    case render::ErrorUnit::percent: return format("{:.2g} %", 100.0 * error);
    case render::ErrorUnit::reflectance: return format("{:.2g} reflectance", error);
    case render::ErrorUnit::noise: return format("{:.2g} of the sensor's noise", error);
    case render::ErrorUnit::polarization: return format("{:.2g} % DoLP", 100.0 * error);
  }
  return {};
}

}  // namespace

std::string atmosphere_error_note(std::span<const render::AtmosphereHalfWidth> air) {
  double low = 1e300, high = 0.0;
  for (const render::AtmosphereHalfWidth& channel : air) {
    const double share = channel.of(channel.grey_radiance) / channel.grey_radiance;
    low = std::min(low, share);
    high = std::max(high, share);
  }
  return format(
      "numerical error of the air: {:.2g} to {:.2g} % of a grey surface's radiance, by channel; it is in the "
      "half-widths, and rays do not lower it",
      100.0 * low, 100.0 * high);
}

std::string model_error_note(std::span<const render::AtmosphereHalfWidth> air,
                             std::span<const radiometry::Channel> channels, bool cloudy) {
  double low = 1e300, high = 0.0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < air.size(); ++c) {
    const double share = air[c].of_model(air[c].grey_radiance) / air[c].grey_radiance;
    low = std::min(low, share);
    if (share > high) high = share, worst = c;
  }
  return format(
      "error of the model of the air{}: {:.2g} to {:.2g} % of a grey surface's radiance, most in '{}'; intervals {}",
      cloudy ? " and of what clouds consist of" : "", 100.0 * low, 100.0 * high, channels[worst].name,
      air[worst].model_counted > 0.0 ? "hold it"
                                     : "do not hold it (\"interval\": \"with model\" in the atmosphere)");
}

namespace {

/// The judged channels whose model is further from the air than what is asked for.
void tell_of_model_errors(const Parts& parts, LogSink& log) {
  const render::AccuracyRequest& request = *parts.plan.request;
  std::size_t worst = 0, count = 0;
  double most = 1.0;
  for (std::size_t c = 0; c < parts.air.size(); ++c) {
    const double grey = parts.air[c].grey_radiance, numbers = parts.air[c].of(grey);
    if (!parts.tolerance->judged(static_cast<int>(c)) || !(numbers > 0.0)) continue;
    const double share = parts.tolerance->atmosphere_share(c, grey) * parts.air[c].of_model(grey) / numbers;
    if (share <= 1.0) continue;
    ++count;
    if (share > most) most = share, worst = c;
  }
  if (count == 0) return;
  log.info(format(
      "the model of the air is not as near to the air as what is asked for: over a grey surface it may be off by {} in "
      "'{}'{}, whatever rays are traced; {} is then the accuracy of the numbers alone",
      in_units(request, request.error * most), parts.channels[worst].name,
      count > 1 ? format(" and by more than asked for in {} more", count - 1) : std::string(),
      in_units(request, request.error)));
}

}  // namespace

void warn_of_atmosphere_errors(const Parts& parts, LogSink& log) {
  if (parts.air.empty() || !parts.tolerance) return;
  // Who wants the model's error in intervals compares with the air, and is warned; others compare images of the model.
  const bool with_model = parts.air.front().model_counted > 0.0;
  if (!with_model) tell_of_model_errors(parts, log);
  constexpr std::size_t kNamed = 4;
  std::size_t count = 0;
  double worst = 0.0;
  std::string names;
  for (std::size_t c = 0; c < parts.air.size(); ++c) {
    if (!parts.tolerance->judged(static_cast<int>(c))) continue;
    const double share = parts.tolerance->atmosphere_share(c, parts.air[c].grey_radiance);
    if (share <= parts.tolerance->most_bounded()) continue;
    if (count++ < kNamed) names += format("{}'{}'", names.empty() ? "" : ", ", parts.channels[c].name);
    worst = std::max(worst, share);
  }
  if (count == 0) return;
  if (count > kNamed) names += format(" and {} more", count - kNamed);
  const double enough = parts.plan.request->error * worst / parts.tolerance->most_bounded();
  log.warn(format(
      "the accuracy asked for is finer than the atmosphere is {}: over a grey surface the air's own {} is up to {} in {}; "
      "pixels may miss it there however many rays are traced{}. {} can be reached, or judge other channels",
      with_model ? "known" : "computed to", with_model ? "error, of numbers and model," : "numerical error",
      in_units(*parts.plan.request, parts.plan.request->error * worst), names,
      worst > 1.0 ? ", and they end where they add a third of that" : "",
      in_units(*parts.plan.request, enough)));
}

}  // namespace ifov::session
