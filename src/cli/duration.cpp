#include "cli/duration.h"

#include <cmath>
#include <cstdlib>

#include "core/error.h"

namespace ifov::cli {

std::chrono::duration<double> read_duration(const std::string& text, const std::string& option) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  std::string unit = end;
  unit.erase(0, std::min(unit.size(), unit.find_first_not_of(' ')));
  const double seconds = unit == "s"     ? 1.0
                         : unit == "min" ? 60.0
                         : unit == "h"   ? 3600.0
                         : unit == "d"   ? 86400.0
                                         : 0.0;
  if (end == text.c_str() || seconds == 0.0 || !(number > 0.0) || !std::isfinite(number))
    throw InputError(format("{} '{}': expected a time above 0 with its unit, such as 90s, 10min, 1.5h or 2d",
                            option, text));
  return std::chrono::duration<double>(number * seconds);
}

}  // namespace ifov::cli
