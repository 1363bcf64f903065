#include <charconv>
#include <cmath>
#include <limits>

#include "core/format.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {
namespace {

/// A number with its unit, and how well it reads: less is better.
struct Candidate {
  std::string text;
  int cost = std::numeric_limits<int>::max();
};

int digits_in(std::string_view number) {
  int digits = 0, zeros = 0;
  for (const char c : number.substr(0, number.find('e'))) {
    if (c < '0' || c > '9') continue;
    if (c == '0') {
      zeros += digits > 0 ? 1 : 0;
    } else {
      digits += zeros + 1;
      zeros = 0;
    }
  }
  return digits;
}

/// The number of fewest digits near `about` that `makes` the value; nothing where none does, for numbers of a unit have gaps
/// where the factor rounds.
template <class Makes>
std::optional<double> fewest_digits(double about, const Makes& makes) {
  for (int precision = 1; precision <= 17; ++precision) {
    const std::string text = format("{:.{}g}", about, precision);
    double number = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    if (makes(number)) return number;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double up = about, down = about;
  for (int step = 0; step < 4; ++step) {
    up = std::nextafter(up, kInfinity);
    down = std::nextafter(down, -kInfinity);
    if (makes(up)) return up;
    if (makes(down)) return down;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> quantity_text(double value, const Dimension& dimension, const Range& range,
                                         double factor) {
  constexpr double kShort = 0.1, kLong = 1e7;
  constexpr int kStrange = 5;  // of numbers that are long or have many zeros behind their point, in digits
  constexpr int kThousands = 2;
  constexpr int kUnusual = 1;  // of a unit, for each that comes before it
  Candidate best;
  int unusual = 0;
  for (const Unit& unit : dimension.units) {
    if (!unit.listed) continue;
    if (best.cost <= unusual + 1) break;
    const auto makes = [&](double number) {
      const double read = number * unit.factor + unit.offset;
      return factor * read == value && is_within(read, number, unit, dimension, range) &&
             is_sensible(read, range, dimension.smallest, dimension.largest);
    };
    const auto number = fewest_digits((value / factor - unit.offset) / unit.factor, makes);
    if (number) {
      const std::string text = format("{}", *number == 0.0 ? 0.0 : *number);
      const double size = std::abs(*number);
      const bool strange = size != 0.0 && (size < kShort || size >= kLong);
      const int cost =
          digits_in(text) + unusual + (strange ? kStrange : 0) + (text.ends_with("000") ? kThousands : 0);
      if (cost < best.cost) best = {format("{} {}", text, unit.spelling), cost};
    }
    unusual += kUnusual;
  }
  if (!best.text.empty()) return best.text;
  // Where a factor rounds in every unit, the nearest value.
  const Unit& unit = dimension.units.front();
  const double number = (value / factor - unit.offset) / unit.factor,
               read = number * unit.factor + unit.offset;
  const bool can_be_read = is_within(read, number, unit, dimension, range) &&
                           is_sensible(read, range, dimension.smallest, dimension.largest);
  return can_be_read ? std::optional(format("{} {}", number, unit.spelling)) : std::nullopt;
}

}  // namespace ifov::io
