#include "io/spectra/ems.h"

#include "core/error.h"
#include "io/spectra/spectrum_rows.h"

namespace ifov::io {
namespace {

constexpr int kWeights = 91, kMostCurves = 100000;

class EmsParser {
 public:
  explicit EmsParser(const TextFile& file) : file_(file) { skip_blank(); }

  EmsFile parse() {
    EmsFile result;
    const double count = single("the number of curves");
    if (!(count >= 1.0 && count <= kMostCurves && count == static_cast<int>(count)))
      file_.fail(line_ - 1, 0,
                 format("found {:g} curves; expected a whole number from 1 to {}", count, kMostCurves));
    for (int degree = 0; degree < kWeights; ++degree)
      result.weights.push_back(single(format("the weight at {} degrees", degree).c_str()));
    for (int k = 0; k < static_cast<int>(count); ++k)
      result.curves.push_back(curve(k + 1, static_cast<int>(count)));
    if (line_ <= file_.line_count())
      file_.fail(line_, 0, format("found more after the last of {:g} curves", count));
    return result;
  }

 private:
  std::vector<Field> fields() const { return split(file_.line(line_), ' '); }

  /// The next line that is not blank becomes the current one.
  void skip_blank() {
    while (line_ <= file_.line_count() && is_blank(file_.line(line_))) ++line_;
  }

  void next() {
    ++line_;
    skip_blank();
  }

  void need_line(const char* what) const {
    if (line_ > file_.line_count()) file_.fail(0, 0, format("the file ends; expected {}", what));
  }

  double number(const Field& field) const {
    const std::optional<double> value = number_in(field.text);
    if (!value) file_.fail(line_, field.column, format("found '{}'; expected a number", field.text));
    return *value;
  }

  double single(const char* what) {
    need_line(what);
    const std::vector<Field> words = fields();
    if (words.size() != 1)
      file_.fail(line_, 0, format("found {} words; expected {} alone", words.size(), what));
    const double value = number(words[0]);
    next();
    return value;
  }

  radiometry::Spectrum curve(int k, int count) {
    const std::string what = format("curve {} of {}", k, count);
    need_line(what.c_str());
    const std::vector<Field> start = fields();
    const bool in_um = start.size() == 1 && start[0].text == "CURVE_BEGIN";
    if (!in_um && (start.size() != 1 || !number_in(start[0].text)))
      file_.fail(line_, start[0].column,
                 format("found '{}'; expected CURVE_BEGIN or a number to begin {}", start[0].text, what));
    next();
    SpectrumRows rows;
    for (; line_ <= file_.line_count(); next()) {
      const std::vector<Field> words = fields();
      if (words.size() == 1) break;
      if (words.size() != 2)
        file_.fail(line_, 0,
                   format("found {} columns; expected a wavelength and an emissivity", words.size()));
      rows.add(file_, line_, words[0], number(words[0]), number(words[1]),
               in_um ? WavelengthUnit::micrometres : WavelengthUnit::wavenumber_per_cm);
    }
    if (rows.empty()) file_.fail(line_ <= file_.line_count() ? line_ : 0, 0, format("{} has no rows", what));
    return rows.spectrum(file_, radiometry::OutsideRange::error, what);
  }

  const TextFile& file_;
  int line_ = 1;
};

}  // namespace

EmsFile parse_ems(const TextFile& file) { return EmsParser(file).parse(); }

EmsFile read_ems(const std::filesystem::path& path) { return parse_ems(TextFile(path)); }

}  // namespace ifov::io
