#include "io/atmosphere/uvspec_input.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "core/error.h"
#include "core/names.h"
#include "io/files/inputs.h"

namespace ifov::io {
namespace {

constexpr int kDeepestInclude = 4;
constexpr std::size_t kMostAngles = 1000;

/// Columns of output_user that this reader knows; those without a use are skipped.
constexpr std::array<std::string_view, 24> kColumns{
    "lambda", "wavenumber", "edir",    "edn",    "eglo",   "eup",     "enet", "esum",
    "uu",     "uavg",       "uavgdir", "uavgdn", "uavgup", "uavgglo", "zout", "sza",
    "albedo", "T",          "p",       "rho",    "heat",   "fdir",    "fdn",  "fup"};

struct Words {
  std::vector<std::string> words;  ///< the keyword first
  std::vector<int> columns;
  std::string file, text;
  int line = 0;

  [[noreturn]] void fail(std::size_t word, const std::string& message) const {
    throw table_error(file, line, word < columns.size() ? columns[word] : 0, text, message);
  }
};

/// The last line of each keyword counts, as in uvspec; "output_process" and the like keep one line each.
using Keywords = std::map<std::string, Words>;

using Include = std::function<void(const Words&)>;

void collect(const TextFile& file, Keywords& keywords, const Include& include) {
  for (int number = 1; number <= file.line_count(); ++number) {
    std::string_view line = file.line(number);
    const std::vector<Field> fields = split(line.substr(0, line.find('#')), ' ');
    if (fields.empty()) continue;
    Words words;
    words.file = file.name();
    words.line = number;
    words.text = std::string(line);
    for (const Field& field : fields) {
      words.words.emplace_back(field.text);
      words.columns.push_back(field.column);
    }
    if (words.words[0] == "include")
      include(words);
    else
      keywords[words.words[0]] = std::move(words);
  }
}

class Interpreter {
 public:
  Interpreter(const Keywords& keywords, std::string name) : keywords_(keywords) {
    input_.name = std::move(name);
  }

  UvspecInput read() {
    read_source();
    read_quantity();
    read_columns();
    input_.umu = numbers("umu");
    input_.phi_deg = numbers("phi");
    input_.altitude_km = altitudes();
    if (input_.transmittance && !input_.umu.empty())
      keywords_.at("umu").fail(
          0,
          "found radiances as transmittances (output_quantity transmittance), whose unit "
          "depends on the solar spectrum; expected output without output_quantity");
    const bool radiance_column =
        std::find(input_.columns.begin(), input_.columns.end(), "uu") != input_.columns.end();
    if (radiance_column && (input_.umu.size() != 1 || input_.phi_deg.size() > 1))
      keywords_.at("output_user")
          .fail(0, "found 'uu' in output_user with several angles; expected one umu and one phi");
    const std::vector<double> zenith = numbers("sza");
    if (!zenith.empty()) input_.sun_zenith_deg = zenith[0];
    if (!(input_.sun_zenith_deg >= 0.0 && input_.sun_zenith_deg < 90.0) && input_.transmittance)
      keywords_.at("sza").fail(1, "found a Sun below the horizon; expected a zenith angle below 90 degrees");
    return std::move(input_);
  }

 private:
  const Words* find(const std::string& keyword) const {
    const auto found = keywords_.find(keyword);
    return found == keywords_.end() ? nullptr : &found->second;
  }

  void read_source() {
    const Words* source = find("source");
    if (source == nullptr || source->words.size() < 2)
      throw InputError(
          format("{}: found no source; expected 'source solar' or 'source thermal', as in the input file "
                 "of uvspec",
                 input_.name));
    if (source->words[1] != "solar" && source->words[1] != "thermal")
      source->fail(1, format("found the source '{}'; expected 'solar' or 'thermal'", source->words[1]));
    input_.thermal = source->words[1] == "thermal";
    for (std::size_t i = 2; i < source->words.size(); ++i)
      if (source->words[i] == "per_band" || source->words[i] == "per_cm-1")
        source->fail(i, format("found a solar spectrum {}; expected one per nm", source->words[i]));
  }

  void read_quantity() {
    if (const Words* quantity = find("output_quantity")) {
      if (quantity->words.size() < 2 || quantity->words[1] != "transmittance")
        quantity->fail(1, format("found the output quantity '{}'; expected 'transmittance' or none",
                                 quantity->words.size() < 2 ? "" : quantity->words[1]));
      input_.transmittance = true;
      if (input_.thermal) quantity->fail(1, "found transmittances of a thermal source; expected a solar one");
    }
    const Words* process = find("output_process");
    if (process == nullptr) {
      if (input_.thermal)
        find("source")->fail(
            1,
            "found a thermal source without output_process; expected 'output_process per_nm' or "
            "'output_process per_cm-1', which says the unit");
      return;
    }
    const std::string word = process->words.size() < 2 ? std::string() : process->words[1];
    if (word == "per_cm-1")
      input_.density = UvspecInput::Density::per_cm;
    else if (word != "per_nm")
      process->fail(1, format("found the output process '{}'; expected 'per_nm', 'per_cm-1' or none", word));
  }

  void read_columns() {
    if (const Words* user = find("output_user")) {
      for (std::size_t i = 1; i < user->words.size(); ++i) {
        const std::string& word = user->words[i];
        if (std::find(kColumns.begin(), kColumns.end(), word) == kColumns.end()) {
          const std::vector<std::string> choices(kColumns.begin(), kColumns.end());
          user->fail(i, format("found the column '{}'; expected {}", word, list_names(choices)));
        }
        if (std::find(input_.columns.begin(), input_.columns.end(), word) != input_.columns.end())
          user->fail(i, format("found the column '{}' twice; expected each once", word));
        input_.columns.push_back(word);
      }
      const auto has = [&](std::string_view name) {
        return std::find(input_.columns.begin(), input_.columns.end(), name) != input_.columns.end();
      };
      if (!has("lambda") && !has("wavenumber"))
        user->fail(0, "found no spectral column; expected 'lambda' or 'wavenumber' in output_user");
      return;
    }
    const Words* solver = find("rte_solver");
    const std::string name = solver == nullptr || solver->words.size() < 2 ? "disort" : solver->words[1];
    if (name == "disort" || name == "fdisort1" || name == "fdisort2" || name == "sdisort" ||
        name == "spsdisort")
      input_.columns = {"lambda", "edir", "edn", "eup", "uavgdir", "uavgdn", "uavgup"};
    else if (name == "twostr" || name == "rodents")
      input_.columns = {"lambda", "edir", "edn", "eup", "uavg"};
    else
      solver->fail(1, format("found the solver '{}', whose output is not read; expected disort or twostr, or "
                             "output_user with the columns",
                             name));
  }

  std::vector<double> numbers(const std::string& keyword) const {
    std::vector<double> values;
    const Words* words = find(keyword);
    if (words == nullptr) return values;
    for (std::size_t i = 1; i < words->words.size(); ++i) {
      const std::optional<double> value = number_in(words->words[i]);
      if (!value) words->fail(i, format("found '{}'; expected a number", words->words[i]));
      values.push_back(*value);
    }
    if (values.empty() || values.size() > kMostAngles)
      words->fail(0, format("found {} numbers; expected 1 to {}", values.size(), kMostAngles));
    return values;
  }

  std::vector<double> altitudes() const {
    const Words* words = find("zout");
    std::vector<double> values;
    if (words == nullptr) return values;
    for (std::size_t i = 1; i < words->words.size(); ++i) {
      const std::string& word = words->words[i];
      const std::optional<double> value = number_in(word);
      // Named levels: the surface is one whose altitude the output does not say.
      if (!value && lower_case(word) != "toa" && lower_case(word) != "sur")
        words->fail(i, format("found '{}'; expected an altitude (km), 'sur' or 'toa'", word));
      values.push_back(value ? *value : lower_case(word) == "toa" ? 120.0 : 0.0);
    }
    if (values.empty() || values.size() > kMostAngles)
      words->fail(0, format("found {} levels; expected 1 to {}", values.size(), kMostAngles));
    return values;
  }

  const Keywords& keywords_;
  UvspecInput input_;
};

void collect_file(const std::filesystem::path& path, Keywords& keywords, int depth) {
  const TextFile file(path);
  collect(file, keywords, [&](const Words& words) {
    if (words.words.size() < 2) words.fail(0, "found no file; expected 'include FILE'");
    if (depth >= kDeepestInclude) words.fail(0, "found files that include each other too deeply");
    const std::filesystem::path name = std::filesystem::path(words.words[1]).filename();
    std::filesystem::path other = path.parent_path() / words.words[1];
    if (!input_exists(other)) other = path.parent_path() / name;
    if (is_asset_name(path.native())) other = std::string(kAssetPrefix) + name.string();
    if (!input_exists(other))
      words.fail(1,
                 format("found the file '{}', which is neither there nor beside this one", words.words[1]));
    collect_file(other, keywords, depth + 1);
  });
}

}  // namespace

UvspecInput read_uvspec_input(const std::filesystem::path& path) {
  Keywords keywords;
  collect_file(path, keywords, 0);
  return Interpreter(keywords, path.string()).read();
}

UvspecInput parse_uvspec_input(const TextFile& file) {
  Keywords keywords;
  collect(file, keywords, [](const Words& words) {
    words.fail(0, "found an include in a text that has no place; expected a file without");
  });
  return Interpreter(keywords, file.name()).read();
}

}  // namespace ifov::io
