#include "io/atmosphere/modtran_tape7.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "io/atmosphere/fixed_columns.h"
#include "io/atmosphere/format_guess.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr int kMostCards = 100;
struct Heading {
  ModtranMode mode = ModtranMode::radiance;
  std::optional<WavelengthUnit> unit;  ///< as the heading says; a bare FREQ says nothing
  std::vector<std::string> names;      ///< beside the spectral column; made up for columns that are not used
  std::vector<std::size_t> ends;       ///< with the spectral column's
  int lines = 1;
};

std::string_view mode_name(ModtranMode mode) {
  switch (mode) {
    case ModtranMode::transmittance: return "transmittance";
    case ModtranMode::thermal_radiance: return "thermal radiance";
    case ModtranMode::radiance: return "thermal and solar radiance";
    case ModtranMode::solar_irradiance: break;
  }
  return "solar irradiance";
}

std::size_t end_of(const Field& field) {
  return static_cast<std::size_t>(field.column - 1) + field.text.size();
}

std::string joined(const Field& a, const Field& b) { return std::string(a.text) + " " + std::string(b.text); }

bool says_unit(std::string_view heading) {
  const auto alone = modtran_spectral_heading("wavelength " + std::string(heading));
  return (alone && alone->unit) || lower_case(heading) == "cm-1";
}

bool is_heading(std::string_view line) {
  const std::vector<Field> words = split(line, ' ');
  return words.size() >= 3 && !number_in(words[0].text) &&
         modtran_spectral_heading(words[0].text).has_value();
}

Heading read_heading(const TextFile& file, int number) {
  Heading heading;
  const std::vector<Field> words = split(file.line(number), ' ');
  std::vector<Field> below;
  if (number < file.line_count()) below = split(file.line(number + 1), ' ');
  const bool two_lines = !below.empty() && says_unit(below[0].text);
  if (two_lines) heading.lines = 2;

  std::size_t next = 1;
  std::string spectral(words[0].text);
  bool stated = spectral.find_first_of("([") != std::string::npos;
  std::size_t spectral_end = end_of(words[0]);
  if (two_lines) {
    spectral = joined(words[0], below[0]);
    stated = true;
  } else if (says_unit(words[1].text)) {
    spectral = joined(words[0], words[1]);
    spectral_end = end_of(words[1]);
    stated = true;
    next = 2;
  }
  heading.ends.push_back(spectral_end);
  if (stated) heading.unit = modtran_spectral_heading(spectral)->unit;

  bool combined = false, total = false, beam = false;
  while (next < words.size()) {
    const Field* last = &words[next];
    std::optional<std::string> name;
    if (next + 1 < words.size()) name = modtran_column(joined(words[next], words[next + 1]));
    if (name) {
      last = &words[++next];
    } else {
      name = modtran_column(words[next].text);
      combined = combined || lower_case(words[next].text) == "combin";
    }
    ++next;
    const std::string column = name ? *name : format("column {}", heading.names.size() + 2);
    if (std::find(heading.names.begin(), heading.names.end(), column) != heading.names.end())
      file.fail(number, last->column, format("found {} twice; expected each column once", column));
    total = total || column == "TOTAL_RAD";
    beam = beam || column == "SOL_TR";
    heading.names.push_back(column);
    heading.ends.push_back(end_of(*last));
  }
  if (total)
    heading.mode = ModtranMode::radiance;
  else if (beam)
    heading.mode = ModtranMode::solar_irradiance;
  else if (combined)
    heading.mode = ModtranMode::transmittance;
  else
    file.fail(
        number, 0,
        "found headings of no MODTRAN run mode; expected COMBIN (transmittance), TOTAL_RAD (radiance) or "
        "SOL TR (solar irradiance)");
  return heading;
}

std::optional<double> number_at(std::string_view line, std::size_t first, std::size_t length) {
  if (line.size() < first) return std::nullopt;
  const std::vector<Field> words = split(line.substr(first, length), ' ');
  return words.size() == 1 ? number_in(words[0].text) : std::nullopt;
}

class Reader {
 public:
  Reader(const TextFile& file, std::optional<WavelengthUnit> unit) : file_(file), unit_(unit) {
    const std::string name = lower_case(file.name());
    convolved_ = name.ends_with(".7sc") || name.ends_with(".scn") || name.ends_with("_scan.txt");
  }

  std::vector<ModtranRun> read() {
    for (line_ = 1; line_ <= file_.line_count();) {
      if (is_blank(file_.line(line_)))
        ++line_;
      else
        read_run();
    }
    if (runs_.empty()) file_.fail(0, 0, "found an empty file; expected a MODTRAN tape7");
    return std::move(runs_);
  }

 private:
  void read_run() {
    const int first = line_;
    int heading_line = first;
    while (heading_line <= file_.line_count() && heading_line < first + kMostCards &&
           !is_heading(file_.line(heading_line)))
      ++heading_line;
    if (heading_line > file_.line_count() || heading_line >= first + kMostCards)
      file_.fail(
          first, 0,
          "found no line of headings that begins with FREQ or WAVLEN after this one; expected a run of "
          "MODTRAN 4 or later" +
              looks_like(file_, "MODTRAN tape7"));
    Heading heading = read_heading(file_, heading_line);
    agree_with_card_1(first, heading, heading_line);
    line_ = heading_line + heading.lines;
    const auto tables = read_rows(heading, unit_of(heading, heading_line));
    const bool alone = runs_.empty() && line_ > file_.line_count();
    for (const auto& [line_of_sight, table] : tables) {
      std::string source = file_.name();
      if (!alone) source += format(", run at line {}", first);
      if (line_of_sight != 0.0) source += format(", line of sight {}", line_of_sight);
      ModtranRun run{heading.mode, first, modtran_path(table, heading.mode, source)};
      read_cards(first, heading_line, run.path);
      runs_.push_back(std::move(run));
    }
  }

  void agree_with_card_1(int first, Heading& heading, int heading_line) const {
    const std::optional<double> stated = number_at(file_.line(first), 10, 5);
    if (heading_line == first || !stated || *stated < 0.0 || *stated > 4.0 || *stated != std::floor(*stated))
      return;
    const int mode = static_cast<int>(*stated);
    const ModtranMode said = mode == 0   ? ModtranMode::transmittance
                             : mode == 1 ? ModtranMode::thermal_radiance
                             : mode == 2 ? ModtranMode::radiance
                                         : ModtranMode::solar_irradiance;
    const bool radiance = heading.mode == ModtranMode::radiance;
    if (radiance && said == ModtranMode::thermal_radiance) heading.mode = said;
    if (heading.mode != said)
      file_.fail(heading_line, 0,
                 format("found headings of {}; expected those of {}, since card 1 (line {}) states IEMSCT {}",
                        mode_name(heading.mode), mode_name(said), first, mode));
  }

  WavelengthUnit unit_of(const Heading& heading, int heading_line) const {
    if (unit_) return *unit_;
    if (heading.unit) return *heading.unit;
    if (convolved_ && heading_line > 2) {
      const std::string_view card_4 = file_.line(heading_line - 2);
      const char flag = card_4.size() > 50 ? card_4[50] : ' ';
      if (flag == 'M' || flag == 'm') return WavelengthUnit::micrometres;
      if (flag == 'N' || flag == 'n') return WavelengthUnit::nanometres;
    }
    return WavelengthUnit::wavenumber_per_cm;
  }

  std::map<double, SpectralTable> read_rows(const Heading& heading, WavelengthUnit unit) {
    const auto los = std::find(heading.names.begin(), heading.names.end(), "LOS");
    std::map<double, SpectralTable> tables;
    for (const int first = line_;; ++line_) {
      if (line_ > file_.line_count())
        file_.fail(file_.line_count(), 0, "the file ends within a run; expected a line of -9999.");
      const std::string_view text = file_.line(line_);
      const std::vector<Field> words = split(text, ' ');
      if (words.empty()) file_.fail(line_, 0, "found an empty line within a run; expected a row or -9999.");
      if (words[0].text.starts_with("-9999")) {
        if (line_ == first) file_.fail(line_, 0, "found a run without rows");
        ++line_;
        return tables;
      }
      const std::vector<Field> cells = cells_under(file_, line_, heading.ends);
      double line_of_sight = 0.0;
      if (los != heading.names.end()) {
        const Field& cell = cells[static_cast<std::size_t>(los - heading.names.begin()) + 1];
        line_of_sight = number_in(cell.text).value_or(0.0);
      }
      SpectralTable& table = tables.try_emplace(line_of_sight, file_, unit, used(heading)).first->second;
      table.add(line_, cells[0], used_cells(heading, cells));
    }
  }

  /// Columns of single gases and the like are neither needed nor always full.
  static bool is_used(const std::string& name) { return !name.starts_with("column ") && name != "DEPTH"; }

  static std::vector<std::string> used(const Heading& heading) {
    std::vector<std::string> names;
    std::copy_if(heading.names.begin(), heading.names.end(), std::back_inserter(names), is_used);
    return names;
  }

  static std::vector<Field> used_cells(const Heading& heading, const std::vector<Field>& cells) {
    std::vector<Field> kept;
    for (std::size_t i = 0; i < heading.names.size(); ++i)
      if (is_used(heading.names[i])) kept.push_back(cells[i + 1]);
    return kept;
  }

  /// Cards 1A and 3 of runs without optional cards, by their place.
  void read_cards(int first, int heading_line, atmosphere::ImportedPath& path) const {
    for (int number = first; number < heading_line; ++number)
      if (file_.line(number).find("H2O & O3 COLUMNS") != std::string_view::npos) {
        path.water_vapour_g_cm2 = number_at(file_.line(number), 30, 10);
        path.ozone_g_cm2 = number_at(file_.line(number), 40, 10);
      }
    if (heading_line - first != 10) return;
    const std::optional<double> type = number_at(file_.line(first), 6, 4);
    const std::string_view card_3 = file_.line(first + 5);
    const std::optional<double> zenith_deg = number_at(card_3, 20, 10);
    if (!type) return;
    path.geometry.sensor_altitude_km = number_at(card_3, 0, 10);
    if (*type == 1.0)
      path.geometry.range_km = number_at(card_3, 30, 10);
    else if (zenith_deg)
      path.geometry.zenith_rad = *zenith_deg * math::kDegree;
    if (*type == 2.0) path.geometry.ground_altitude_km = number_at(card_3, 10, 10);
  }

  const TextFile& file_;
  std::optional<WavelengthUnit> unit_;
  bool convolved_ = false;
  int line_ = 1;
  std::vector<ModtranRun> runs_;
};

}  // namespace

std::vector<ModtranRun> read_modtran_tape7(const std::filesystem::path& path,
                                           std::optional<WavelengthUnit> unit) {
  return parse_modtran_tape7(TextFile(path), unit);
}

std::vector<ModtranRun> parse_modtran_tape7(const TextFile& file, std::optional<WavelengthUnit> unit) {
  return Reader(file, unit).read();
}

}  // namespace ifov::io
