#include "io/library/library_table.h"

#include <charconv>
#include <cmath>
#include <map>

#include "core/error.h"

namespace ifov::io {
namespace {

constexpr double kFigure = 1e-4;  // one unit of the figures

class TableParser {
 public:
  explicit TableParser(const TextFile& file) : file_(file) {}

  std::vector<LibraryMaterial> parse() {
    for (line_ = 1; line_ <= file_.line_count(); ++line_) {
      const std::string_view text = file_.line(line_);
      if (is_blank(text) || text[0] == '#') continue;
      const std::size_t colon = text.find(": ");
      if (colon == std::string_view::npos) fail("expected 'key: value'");
      take(text.substr(0, colon), text.substr(colon + 2));
    }
    finish_curve();
    return std::move(materials_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { file_.fail(line_, 0, message); }

  void take(std::string_view key, std::string_view value) {
    if (key == "grid") {
      grid_um_ = grid(value);
    } else if (key == "origin") {
      const std::size_t space = value.find(' ');
      if (space == std::string_view::npos) fail("expected a name and a text");
      origins_[std::string(value.substr(0, space))] = value.substr(space + 1);
    } else if (key == "material") {
      finish_curve();
      materials_.emplace_back().name = value;
    } else if (key == "words") {
      for (const Field& word : split(value, ' ')) material().words.emplace_back(word.text);
    } else if (key == "about") {
      material().about = value;
    } else if (key == "instead of") {
      for (const Field& name : split(value, ';')) material().instead_of.emplace_back(name.text);
    } else if (key == "curve") {
      if (!material().curves.empty()) finish_curve();
      material().curves.emplace_back().name = value;
    } else {
      take_of_curve(key, value);
    }
  }

  void take_of_curve(std::string_view key, std::string_view value) {
    LibraryCurve& curve = this->curve();
    if (key == "sample") {
      curve.sample = value;
    } else if (key == "source") {
      for (const Field& name : split(value, ' ')) {
        const auto found = origins_.find(name.text);
        if (found == origins_.end()) fail(format("no 'origin' is called '{}'", name.text));
        curve.origins.push_back(found->second);
      }
    } else if (key == "measured" || key == "modelled") {
      curve.modelled = key == "modelled";
      const std::vector<double> ends = numbers(value, 2);
      curve.first_um = ends[0];
      curve.last_um = ends[1];
    } else if (key == "not measured") {
      const std::vector<Field> fields = split(value, ' ');
      if (fields.size() < 3) fail("expected two wavelengths and a text");
      curve.lent.push_back({number(fields[0].text), number(fields[1].text),
                            std::string(value.substr(static_cast<std::size_t>(fields[2].column - 1)))});
    } else if (key == "note") {
      curve.notes.emplace_back(value);
    } else if (key == "difference") {
      const std::vector<double> differences = numbers(value, 2);
      curve.largest_difference = differences[0];
      curve.rms_difference = differences[1];
    } else if (key == "reflectance") {
      curve.reflectance = figures(value, true);
    } else if (key == "transmittance") {
      curve.transmittance = figures(value, false);
    } else {
      fail(format("found the key '{}'", key));
    }
  }

  LibraryMaterial& material() {
    if (materials_.empty()) fail("found no 'material' above");
    return materials_.back();
  }

  LibraryCurve& curve() {
    if (material().curves.empty()) fail("found no 'curve' above");
    return materials_.back().curves.back();
  }

  void finish_curve() const {
    if (materials_.empty()) return;
    const LibraryMaterial& last = materials_.back();
    if (last.words.empty() || last.curves.empty() || last.curves.back().reflectance.is_constant() ||
        last.curves.back().origins.empty())
      file_.fail(
          0, 0,
          format("the material '{}' has no words, no curve, or one without figures or source", last.name));
  }

  double number(std::string_view text) const {
    const std::optional<double> value = number_in(text);
    if (!value) fail(format("found '{}'; expected a number", text));
    return *value;
  }

  std::vector<double> numbers(std::string_view text, std::size_t count) const {
    std::vector<double> values;
    for (const Field& field : split(text, ' ')) values.push_back(number(field.text));
    if (values.size() != count) fail(format("found {} numbers; expected {}", values.size(), count));
    return values;
  }

  std::vector<double> grid(std::string_view text) const {
    const std::size_t count = split(text, ' ').size();
    if (count == 0 || count % 3 != 0) fail("expected first, step and last wavelength of each piece");
    const std::vector<double> pieces = numbers(text, count);
    std::vector<double> grid_um;
    for (std::size_t p = 0; p < count; p += 3) {
      const int steps = static_cast<int>(std::lround((pieces[p + 2] - pieces[p]) / pieces[p + 1]));
      for (int k = 0; k < steps; ++k) grid_um.push_back(pieces[p] + pieces[p + 1] * k);
    }
    grid_um.push_back(pieces[count - 1]);
    return grid_um;
  }

  /// Whole numbers, one for each wavelength; what is missing at the end is 0 where that is allowed.
  radiometry::Spectrum figures(std::string_view text, bool all) const {
    std::vector<double> values;
    values.reserve(grid_um_.size());
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
      int figure = 0;
      const auto [next, error] = std::from_chars(at, end, figure);
      if (error != std::errc() || figure < 0 || figure > 10000)
        fail("expected whole numbers from 0 to 10000");
      values.push_back(figure * kFigure);
      at = next < end ? next + 1 : end;
    }
    if (values.size() > grid_um_.size() || (all && values.size() < grid_um_.size()))
      fail(format("found {} figures for {} wavelengths", values.size(), grid_um_.size()));
    values.resize(grid_um_.size());
    return radiometry::Spectrum(grid_um_, std::move(values));
  }

  const TextFile& file_;
  int line_ = 0;
  std::vector<double> grid_um_;
  std::map<std::string, std::string, std::less<>> origins_;
  std::vector<LibraryMaterial> materials_;
};

}  // namespace

std::vector<LibraryMaterial> parse_library_table(const TextFile& file) { return TableParser(file).parse(); }

}  // namespace ifov::io
