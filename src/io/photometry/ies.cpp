#include "io/photometry/ies.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr double kMostAngles = 20000;

/// The numbers of a file one after the other, wherever its lines break.
class IesNumbers {
 public:
  IesNumbers(const TextFile& file, int line) : file_(file), number_(line) {}

  double next(const std::string& what) {
    while (at_ >= fields_.size()) {
      if (number_ > file_.line_count())
        file_.fail(file_.line_count(), 0, format("the file ends here; expected {}", what));
      std::string text(file_.line(number_++));
      for (char& c : text)
        if (c == ',') c = ' ';
      line_ = std::move(text);
      fields_ = split(line_, ' ');
      if (is_blank(line_)) fields_.clear();
      at_ = 0;
    }
    const Field field = fields_[at_++];
    const std::optional<double> value = number_in(field.text);
    if (!value) file_.fail(number_ - 1, field.column, format("found '{}'; expected {}", field.text, what));
    last_column_ = field.column;
    return *value;
  }
  double between(const std::string& what, double low, double high) {
    const double value = next(what);
    if (!(value >= low) || !(value <= high)) fail(format("found {:g}; expected {}", value, what));
    return value;
  }
  std::size_t count(const std::string& what) {
    const double value = between(what, 1.0, kMostAngles);
    if (value != std::floor(value)) fail(format("found {:g}; expected {}", value, what));
    return static_cast<std::size_t>(value);
  }
  std::vector<double> many(std::size_t count, const std::string& what, double low, double high) {
    std::vector<double> values(count);
    for (double& value : values) value = between(what, low, high);
    return values;
  }
  [[noreturn]] void fail(const std::string& message) const { file_.fail(number_ - 1, last_column_, message); }

 private:
  const TextFile& file_;
  int number_;
  std::string line_;
  std::vector<Field> fields_;
  std::size_t at_ = 0;
  int last_column_ = 0;
};

/// The line that says how the lamp's output changes with its tilt, after which the numbers begin.
int tilt_line(const TextFile& file) {
  for (int number = 1; number <= file.line_count(); ++number)
    if (lower_case(file.line(number)).starts_with("tilt=")) return number;
  file.fail(0, 0, "found no line 'TILT='; expected a photometric file of IES LM-63");
}

}  // namespace

radiometry::LuminousIntensity parse_ies(const TextFile& file) {
  const int tilt = tilt_line(file);
  IesNumbers numbers(file, tilt + 1);
  if (lower_case(file.line(tilt)).starts_with("tilt=include")) {
    numbers.next("how the lamp lies in the luminaire, 1 to 3");
    const std::size_t count = numbers.count("how many angles of tilt there are");
    numbers.many(2 * count, "angles of tilt and the lamp's output at them", -1e6, 1e6);
  }
  numbers.between("the number of lamps", 1.0, 1e6);
  numbers.next("lumens of a lamp, or -1");
  const double multiplier = numbers.between("the multiplier of intensities, above 0", 1e-9, 1e9);
  const std::size_t vertical = numbers.count("how many vertical angles there are, a whole number above 0");
  const std::size_t horizontal =
      numbers.count("how many horizontal angles there are, a whole number above 0");
  const double type = numbers.between("the type of goniometer, 1 (C), 2 (B) or 3 (A)", 1.0, 3.0);
  if (type != 1.0)
    numbers.fail(format("found type {}; only type C (1) is read: convert the file", type == 2.0 ? 'B' : 'A'));
  numbers.between("the unit of length, 1 (feet) or 2 (metres)", 1.0, 2.0);
  numbers.many(3, "a length of the luminous opening", -1e6, 1e6);
  const double ballast = numbers.between("the ballast factor, above 0", 1e-9, 1e9);
  const double photometric = numbers.between("the ballast-lamp photometric factor, above 0", 1e-9, 1e9);
  numbers.between("watts, at least 0", 0.0, 1e9);
  std::vector<double> from_down = numbers.many(vertical, "a vertical angle, 0 to 180 deg", 0.0, 180.0);
  std::vector<double> about = numbers.many(horizontal, "a horizontal angle, 0 to 360 deg", 0.0, 360.0);
  std::vector<double> candela = numbers.many(vertical * horizontal, "an intensity, at least 0 cd", 0.0, 1e12);
  for (double& value : candela) value *= multiplier * ballast * photometric;
  try {
    return {std::move(from_down), std::move(about), std::move(candela)};
  } catch (const InputError& error) {
    numbers.fail(error.what());
  }
}

radiometry::LuminousIntensity read_ies(const std::filesystem::path& path) {
  return parse_ies(TextFile(path));
}

}  // namespace ifov::io
