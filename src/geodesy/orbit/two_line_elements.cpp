#include "geodesy/orbit/two_line_elements.h"

#include <erfa.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "math/angle.h"

namespace ifov::geodesy {
namespace {

constexpr double kRevolutionsPerDay = 2.0 * std::numbers::pi / 1440.0;  // rad/min
constexpr std::size_t kColumns = 69;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

/// Fields of one line, by the columns that its definition counts from 1.
class Line {
 public:
  Line(std::string_view text, int number) : text_(text), number_(number) {
    if (text.size() < kColumns)
      throw InputError(format("line {} of the two-line elements has {} columns; expected {}", number,
                              text.size(), kColumns));
    if (text[0] != '0' + number || text[1] != ' ')
      throw InputError(format("line {} of the two-line elements begins with '{}'; expected '{} '", number,
                              text.substr(0, 2), number));
    int sum = 0;
    for (const char symbol : text.substr(0, kColumns - 1))
      sum += symbol >= '0' && symbol <= '9' ? symbol - '0' : symbol == '-' ? 1 : 0;
    if (text[kColumns - 1] != '0' + sum % 10)
      throw InputError(
          format("line {} of the two-line elements ends with the checksum '{}'; its digits add up to {}",
                 number, text.substr(kColumns - 1, 1), sum % 10));
  }

  std::string_view columns(std::size_t first, std::size_t last) const {
    return trimmed(text_.substr(first - 1, last - first + 1));
  }

  double number(std::size_t first, std::size_t last, const char* what) const {
    return value(columns(first, last), first, last, what);
  }

  /// Digits after a decimal point that is not written.
  double fraction(std::size_t first, std::size_t last, const char* what) const {
    std::string digits = "0." + std::string(text_.substr(first - 1, last - first + 1));
    std::replace(digits.begin(), digits.end(), ' ', '0');
    return value(digits, first, last, what);
  }

  /// Such as " 28098-4" for 0.28098e-4.
  double with_exponent(std::size_t first, std::size_t last, const char* what) const {
    const std::string_view field = columns(first, last);
    const std::size_t exponent = field.find_last_of("+-");
    if (exponent == std::string_view::npos || exponent == 0) fail(field, first, last, what);
    const bool negative = field[0] == '-';
    const std::string_view digits = field.substr(field[0] == '-' || field[0] == '+' ? 1 : 0);
    std::string text = negative ? "-0." : "0.";
    text += digits.substr(0, digits.size() - (field.size() - exponent));
    text += field[exponent] == '-' ? "e-" : "e";
    text += field.substr(exponent + 1);
    return value(text, first, last, what);
  }

  double angle(std::size_t first, std::size_t last, double most_deg, const char* what) const {
    const double degrees = number(first, last, what);
    if (!(degrees >= 0.0 && degrees <= most_deg))
      throw InputError(
          format("columns {} to {} of line {} of the two-line elements: the {} is {} deg; expected 0 to {}",
                 first, last, number_, what, degrees, most_deg));
    return degrees * math::kDegree;
  }

 private:
  double value(std::string_view field, std::size_t first, std::size_t last, const char* what) const {
    if (!field.empty() && field[0] == '+') field.remove_prefix(1);
    double result = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), result);
    if (error != std::errc() || end != field.data() + field.size() || field.empty() || !std::isfinite(result))
      fail(columns(first, last), first, last, what);
    return result;
  }

  [[noreturn]] void fail(std::string_view found, std::size_t first, std::size_t last,
                         const char* what) const {
    throw InputError(format("columns {} to {} of line {} of the two-line elements hold '{}'; expected the {}",
                            first, last, number_, found, what));
  }

  std::string_view text_;
  int number_;
};

UtcTime epoch_of(const Line& line) {
  const double year = line.number(19, 20, "epoch's year, two digits"),
               day = line.number(21, 32, "epoch's day of the year");
  if (year != std::floor(year) || !(day >= 1.0 && day < 367.0))
    throw InputError(format(
        "columns 19 to 32 of line 1 of the two-line elements: the epoch is year {}, day {}; expected two digits and 1 to 366",
        year, day));
  // Two digits count from Sputnik's year.
  const int full_year = static_cast<int>(year) + (year < 57.0 ? 2000 : 1900);
  double midnight = 0.0, modified = 0.0;
  eraCal2jd(full_year, 1, 1, &midnight, &modified);
  return {midnight + modified + std::floor(day) - 1.0, day - std::floor(day)};
}

}  // namespace

TwoLineElements parse_two_line_elements(std::string_view first, std::string_view second) {
  const Line one(first, 1), two(second, 2);
  if (one.columns(3, 7) != two.columns(3, 7))
    throw InputError(format("line 1 of the two-line elements is of satellite {}, line 2 of satellite {}",
                            one.columns(3, 7), two.columns(3, 7)));
  TwoLineElements elements;
  elements.catalogue_number = static_cast<int>(one.number(3, 7, "satellite's catalogue number"));
  elements.epoch = epoch_of(one);
  elements.drag_bstar = one.with_exponent(54, 61, "drag term B*, such as 28098-4");
  elements.inclination_rad = two.angle(9, 16, 180.0, "inclination");
  elements.ascending_node_rad = two.angle(18, 25, 360.0, "right ascension of the ascending node");
  elements.eccentricity = two.fraction(27, 33, "eccentricity's digits after the point");
  elements.perigee_argument_rad = two.angle(35, 42, 360.0, "argument of perigee");
  elements.mean_anomaly_rad = two.angle(44, 51, 360.0, "mean anomaly");
  const double revolutions = two.number(53, 63, "mean motion, revolutions a day");
  if (!(revolutions > 0.0 && revolutions < 20.0))
    throw InputError(format(
        "columns 53 to 63 of line 2 of the two-line elements: the mean motion is {} revolutions a day; expected more than 0 and less than 20",
        revolutions));
  elements.mean_motion_rad_min = revolutions * kRevolutionsPerDay;
  return elements;
}

}  // namespace ifov::geodesy
