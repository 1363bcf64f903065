#include "io/report/report_words.h"

#include <cmath>

#include "core/format.h"

namespace ifov::io {

std::string figure(double value) { return std::isfinite(value) ? format("{:.4g}", value) : "\u2013"; }

std::string count(std::uint64_t value) {
  const std::string digits = format("{}", value);
  std::string grouped;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) grouped += "\u2009";
    grouped += digits[i];
  }
  return grouped;
}

std::string short_count(double value) {
  if (value < 1e4) return format("{:.0f}", value);
  if (value < 1e6) return format("{:.1f} k", value / 1e3);
  if (value < 1e9) return format("{:.1f} M", value / 1e6);
  return format("{:.1f} G", value / 1e9);
}

std::string duration(double seconds) {
  if (seconds < 120.0) return format("{:.3g} s", seconds);
  if (seconds < 7200.0) return format("{:.0f} min", seconds / 60.0);
  return format("{:.1f} h", seconds / 3600.0);
}

std::string ordinal(int number) {
  const int tens = number % 100;
  const char* ending = tens >= 11 && tens <= 13 ? "th"
                       : number % 10 == 1       ? "st"
                       : number % 10 == 2       ? "nd"
                       : number % 10 == 3       ? "rd"
                                                : "th";
  return format("{}{}", number, ending);
}

}  // namespace ifov::io
