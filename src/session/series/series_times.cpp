#include "session/series/series_times.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/format.h"

namespace ifov::session {
namespace {

constexpr std::int64_t kMostTimes = 100'000, kLongestStep_s = 366 * 86400;

/// Of digits alone.
std::optional<std::int64_t> natural_in(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || text.front() == '-' || error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// Seconds of "P1DT2H30M10S": days, hours, minutes and seconds, each at most once and in this order.
std::optional<std::int64_t> duration_s(std::string_view text) {
  constexpr std::array<std::pair<char, std::int64_t>, 4> kUnits{
      {{'D', 86400}, {'H', 3600}, {'M', 60}, {'S', 1}}};
  if (!text.starts_with('P')) return std::nullopt;
  text.remove_prefix(1);
  bool of_time = false;
  std::size_t unit = 0;
  std::int64_t sum_s = 0;
  while (!text.empty()) {
    if (!of_time && text.front() == 'T') {
      of_time = true;
      unit = std::max<std::size_t>(unit, 1);
      text.remove_prefix(1);
      if (text.empty()) return std::nullopt;
      continue;
    }
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    const auto number = natural_in(text.substr(0, digits));
    if (!number || digits == text.size() || *number > kLongestStep_s) return std::nullopt;
    while (unit < kUnits.size() && kUnits[unit].first != text[digits]) ++unit;
    if (unit == kUnits.size() || (unit > 0) != of_time) return std::nullopt;
    sum_s += *number * kUnits[unit++].second;
    text.remove_prefix(digits + 1);
  }
  return sum_s;
}

SeriesTimes::One one_at(geodesy::UtcTime time) {
  std::string text = geodesy::format_utc(time);  // "2025-06-20T06:15:00.000Z"
  for (const std::string_view none : {".000Z", ":00Z"})
    if (text.ends_with(none)) text.replace(text.size() - none.size(), none.size(), "Z");
  std::string folder = text;
  std::erase(folder, ':');
  return {time, std::move(text), std::move(folder)};
}

}  // namespace

SeriesTimes SeriesTimes::read(std::string_view written) {
  const auto wrong = [&](const std::string& found) {
    return InputError(format(
        "--times '{}': {}; expected the first time, a step and how many, such as 2025-06-20T00:00Z/PT15M/96",
        written, found));
  };
  std::vector<std::string_view> parts;
  for (std::string_view rest = written;;) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    parts.push_back(rest.substr(0, end));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  if (parts.size() != 3) throw wrong(format("it has {} part{}", parts.size(), parts.size() == 1 ? "" : "s"));
  geodesy::UtcTime first;
  try {
    first = geodesy::parse_utc(parts[0]);
  } catch (const InputError& error) {
    throw wrong(error.what());
  }
  const auto step_s = duration_s(parts[1]);
  if (!step_s || *step_s < 1 || *step_s > kLongestStep_s)
    throw wrong(format("'{}' is no step of whole seconds, such as PT15M, PT1H30M or P1D", parts[1]));
  const auto count = natural_in(parts[2]);
  if (!count || *count < 1 || *count > kMostTimes)
    throw wrong(format("'{}' is no number of times, 1 to {}", parts[2], kMostTimes));
  SeriesTimes times;
  for (std::int64_t k = 0; k < *count; ++k) {
    const std::int64_t after_s = k * *step_s;
    times.all.push_back(one_at({first.jd1 + static_cast<double>(after_s / 86400),
                                first.jd2 + static_cast<double>(after_s % 86400) / 86400.0}));
  }
  return times;
}

}  // namespace ifov::session
