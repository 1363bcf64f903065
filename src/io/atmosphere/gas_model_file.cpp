#include "io/atmosphere/gas_model_file.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/format.h"
#include "core/names.h"
#include "io/atmosphere/gas_words.h"

namespace ifov::io {
namespace {

using atmosphere::GasTermTable;
using atmosphere::TermBin;
using atmosphere::TermGas;

constexpr int kVersion = 1;
constexpr const char* kTitle = "ifov gas model";
constexpr std::size_t kMostBins = 200000, kMostTerms = 64, kMostStates = 10000;
constexpr double kFinest_cm1 = 0.001, kCoarsest_cm1 = 20.0;
constexpr double kWeightsOff = 1e-4;  // rounding of what is written
constexpr double kMostK_cm2 = 1e-10;

/// Reads line after line; each may look at what came before it.
class Reader {
 public:
  explicit Reader(const TextFile& file) : file_(file) {}

  GasTermTable table() {
    next();
    read_title();
    next();
    while (number_ <= file_.line_count() && words_[0].text != "bin") {
      read_head();
      next();
    }
    check_head();
    while (number_ <= file_.line_count()) read_bin();
    table_.name = file_.name();
    return std::move(table_);
  }

 private:
  /// To the next line that says something.
  void next() {
    for (++number_; number_ <= file_.line_count(); ++number_) {
      const std::string_view line = file_.line(number_);
      if (is_blank(line) || is_comment(line)) continue;
      words_ = split(line, ' ');
      return;
    }
    words_.clear();
  }

  [[noreturn]] void fail(std::size_t word, const std::string& message) const {
    file_.fail(number_, words_[word].column, message);
  }
  /// Where the file ends too early.
  void expect_line(const std::string& what) const {
    if (words_.empty()) file_.fail(0, 0, format("it ends where {} should follow", what));
  }

  double number(std::size_t word, double least, double most, const std::string& what) const {
    if (word >= words_.size()) file_.fail(number_, 0, format("{} is missing", what));
    const std::optional<double> value = number_in(words_[word].text);
    if (!value || *value < least || *value > most)
      fail(word, format("found '{}'; expected {}, {:g} to {:g}", words_[word].text, what, least, most));
    return *value;
  }
  void expect_words(std::size_t count, const std::string& what) const {
    if (words_.size() > count)
      fail(count, format("found '{}'; expected nothing after {}", words_[count].text, what));
  }

  void read_title() const {
    if (words_.empty()) file_.fail(0, 0, format("it is empty; expected '{} {}'", kTitle, kVersion));
    const std::string_view line = file_.line(number_);
    const bool titled = words_.size() == 4 && words_[0].text == "ifov" && words_[1].text == "gas" &&
                        words_[2].text == "model";
    if (!titled)
      file_.fail(number_, words_[0].column,
                 format("found '{}'; expected '{} {}'", line.substr(0, 40), kTitle, kVersion));
    const std::optional<double> version = number_in(words_[3].text);
    if (!version || *version != kVersion)
      fail(3, format("found version '{}'; this program reads version {}", words_[3].text, kVersion));
  }

  void read_head() {
    static const std::vector<std::string> kKeys{"source", "bins", "pressures", "temperatures", "gas", "bin"};
    const std::string key(words_[0].text);
    const bool there = key == "bins"           ? !table_.bins.empty()
                       : key == "pressures"    ? !pressure_hPa_.empty()
                       : key == "temperatures" ? !temperature_K_.empty()
                                               : key == "source" && !table_.source.empty();
    if (there) fail(0, format("'{}' is there twice", key));
    if (key == "source") {
      const std::string_view line = file_.line(number_);
      if (words_.size() > 1) table_.source = line.substr(static_cast<std::size_t>(words_[1].column - 1));
    } else if (key == "bins") {
      table_.first_cm1 = number(1, 1.0, 1e6, "the first edge in cm-1");
      table_.step_cm1 = number(2, kFinest_cm1, kCoarsest_cm1, "the width of a bin in cm-1");
      const double count = number(3, 1.0, static_cast<double>(kMostBins), "the number of bins");
      if (count != std::floor(count))
        fail(3, format("found '{}'; expected a whole number of bins", words_[3].text));
      expect_words(4, "the number of bins");
      table_.bins.resize(static_cast<std::size_t>(count));
    } else if (key == "pressures") {
      pressure_hPa_ = rising("a pressure in hPa", 1e-6, 1e6);
    } else if (key == "temperatures") {
      temperature_K_ = rising("a temperature in K", 1.0, 5000.0);
    } else if (key == "gas") {
      read_gas();
    } else {
      fail(0, format("found '{}'; expected {}{}", key, list_names(kKeys), did_you_mean(key, kKeys)));
    }
  }

  std::vector<double> rising(const std::string& what, double least, double most) const {
    std::vector<double> values;
    for (std::size_t k = 1; k < std::max<std::size_t>(2, words_.size()); ++k) {
      values.push_back(number(k, least, most, what));
      if (k > 1 && values[k - 1] <= values[k - 2])
        fail(k, format("{:g} does not rise above {:g}", values[k - 1], values[k - 2]));
    }
    return values;
  }

  void read_gas() {
    if (words_.size() < 2) file_.fail(number_, 0, "the name of the gas is missing");
    TermGas gas;
    if (const auto found = gas_of(words_[1].text))
      gas.gas = *found;
    else
      fail(1, unknown_gas(words_[1].text));
    for (const TermGas& other : table_.gases)
      if (other.gas == gas.gas) fail(1, format("the gas {} is there twice", words_[1].text));
    for (std::size_t k = 2; k < words_.size(); ++k) {
      if (words_[k].text == "continuum")
        gas.holds_continuum = true;
      else if (words_[k].text == "self_broadening")
        gas.self_broadening = number(++k, 0.1, 20.0, "how much more than air the gas itself broadens");
      else if (words_[k].text == "depth_error")
        gas.depth_error = number(++k, 0.0, 1.0, "the share of its depth that the gas may be off by");
      else
        fail(k, format("found '{}'; expected 'self_broadening' or 'depth_error' and a number, or 'continuum'",
                       words_[k].text));
    }
    table_.gases.push_back(gas);
  }

  void check_head() {
    for (const auto& [there, key] :
         {std::pair{!table_.bins.empty(), "bins"}, std::pair{!pressure_hPa_.empty(), "pressures"},
          std::pair{!temperature_K_.empty(), "temperatures"}, std::pair{!table_.gases.empty(), "gas"}})
      if (!there) file_.fail(0, 0, format("no line that begins with '{}' before the first bin", key));
    if (pressure_hPa_.size() * temperature_K_.size() > kMostStates)
      file_.fail(0, 0,
                 format("{} pressures and {} temperatures are more than {} states", pressure_hPa_.size(),
                        temperature_K_.size(), kMostStates));
    table_.states = atmosphere::StateGrid(pressure_hPa_, temperature_K_);
  }

  void read_bin() {
    if (words_[0].text != "bin") fail(0, format("found '{}'; expected 'bin'", words_[0].text));
    const double centre = number(1, table_.first_cm1, table_.last_cm1(), "the middle of a bin in cm-1");
    const auto index = table_.bin_at(centre);
    if (!index || std::abs(table_.centre_cm1(*index) - centre) > 0.01 * table_.step_cm1)
      fail(1, format("{:.10g} cm-1 is not the middle of a bin; the bins are {:g} cm-1 wide from {:g} cm-1 on",
                     centre, table_.step_cm1, table_.first_cm1));
    if (last_ && *index <= *last_)
      fail(1, format("the bin of {:g} cm-1 follows that of {:g} cm-1: bins must rise", centre,
                     table_.centre_cm1(*last_)));
    last_ = index;
    if (words_.size() < 3 || words_[2].text != "error")
      file_.fail(number_, 0, "expected 'error' and what the bin's terms are off by, of transmittance");
    TermBin& bin = table_.bins[*index];
    bin.error = number(3, 0.0, 1.0, "an error of transmittance");
    expect_words(4, "the error");
    next();
    const std::string of_bin = format("the bin of {:g} cm-1", centre);
    expect_line("the weights of " + of_bin);
    read_weights(bin, of_bin);
    bin.log_k.resize(table_.gases.size());
    for (std::size_t g = 0; g < table_.gases.size(); ++g)
      for (const double p : pressure_hPa_)
        for (const double t : temperature_K_) read_row(bin, g, p, t);
    next();
  }

  void read_weights(TermBin& bin, const std::string& of_bin) const {
    if (words_[0].text != "weights")
      fail(0, format("found '{}'; expected the weights of {}", words_[0].text, of_bin));
    if (words_.size() < 2 || words_.size() > kMostTerms + 1)
      file_.fail(number_, 0, format("found {} weights; expected 1 to {}", words_.size() - 1, kMostTerms));
    double sum = 0.0;
    for (std::size_t k = 1; k < words_.size(); ++k) {
      bin.weight.push_back(number(k, 0.0, 1.0 + kWeightsOff, "a weight"));
      sum += bin.weight.back();
    }
    if (std::abs(sum - 1.0) > kWeightsOff)
      fail(1, format("the weights of {} sum to {:.6g}, {:.2g} {} 1; expected 1 within {:g}", of_bin, sum,
                     std::abs(sum - 1.0), sum > 1.0 ? "more than" : "less than", kWeightsOff));
    for (double& weight : bin.weight) weight /= sum;
  }

  void read_row(TermBin& bin, std::size_t gas, double pressure_hPa, double temperature_K) {
    const std::string name(atmosphere::kGasNames[static_cast<std::size_t>(table_.gases[gas].gas)]);
    next();
    const auto row = [&] {
      return format("the row of {} at {:g} hPa and {:g} K", name, pressure_hPa, temperature_K);
    };
    if (words_.empty()) expect_line(row());
    const auto is = [&](std::size_t word, double value) {
      const std::optional<double> found = word < words_.size() ? number_in(words_[word].text) : std::nullopt;
      return found && std::abs(*found - value) <= 1e-6 * value;
    };
    if (words_[0].text != name || !is(1, pressure_hPa) || !is(2, temperature_K))
      fail(0, format("found '{}{}{}'; expected {}", words_[0].text,
                     words_.size() > 1 ? " " + std::string(words_[1].text) : "",
                     words_.size() > 2 ? " " + std::string(words_[2].text) : "", row()));
    if (words_.size() != bin.terms() + 3)
      file_.fail(
          number_, 0,
          format("found {} cross sections; expected {} as of weights", words_.size() - 3, bin.terms()));
    for (std::size_t k = 3; k < words_.size(); ++k) {
      const std::optional<double> value = number_in(words_[k].text);
      if (!value || *value < 0.0 || *value > kMostK_cm2)
        fail(k, format("found '{}'; expected a cross section in cm2 per molecule, 0 to {:g}", words_[k].text,
                       kMostK_cm2));
      bin.log_k[gas].push_back(atmosphere::log_cross_section(*value));
    }
  }

  const TextFile& file_;
  GasTermTable table_;
  std::vector<double> pressure_hPa_, temperature_K_;
  std::optional<std::size_t> last_;
  int number_ = 0;
  std::vector<Field> words_;
};

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += format(" {:g}", value);
  return text + "\n";
}

}  // namespace

GasTermTable read_gas_model(const std::filesystem::path& path) { return parse_gas_model(TextFile(path)); }

GasTermTable parse_gas_model(const TextFile& file) { return Reader(file).table(); }

std::string gas_model_text(const GasTermTable& table) {
  const std::vector<double>&pressure = table.states.pressure_hPa(),
        &temperature = table.states.temperature_K();
  std::string text = format("{} {}\n", kTitle, kVersion);
  text +=
      "# first edge and width of the bins in cm-1, their number; hPa; K; cross sections in cm2 per molecule\n";
  if (!table.source.empty()) text += format("source {}\n", table.source);
  text += format("bins {:.10g} {:.10g} {}\n", table.first_cm1, table.step_cm1, table.bins.size());
  text += "pressures" + numbers(pressure) + "temperatures" + numbers(temperature);
  for (const TermGas& gas : table.gases) {
    text += format("gas {}", atmosphere::kGasNames[static_cast<std::size_t>(gas.gas)]);
    if (gas.self_broadening != 1.0) text += format(" self_broadening {:g}", gas.self_broadening);
    if (gas.depth_error) text += format(" depth_error {:g}", *gas.depth_error);
    text += gas.holds_continuum ? " continuum\n" : "\n";
  }
  for (std::size_t b = 0; b < table.bins.size(); ++b) {
    const TermBin& bin = table.bins[b];
    if (bin.weight.empty()) continue;
    text += format("bin {:.10g} error {:.2g}\nweights", table.centre_cm1(b), bin.error);
    for (const double weight : bin.weight) text += format(" {:.7g}", weight);
    text += "\n";
    for (std::size_t g = 0; g < table.gases.size(); ++g)
      for (std::size_t p = 0; p < pressure.size(); ++p)
        for (std::size_t t = 0; t < temperature.size(); ++t) {
          text += format("{} {:g} {:g}", atmosphere::kGasNames[static_cast<std::size_t>(table.gases[g].gas)],
                         pressure[p], temperature[t]);
          for (std::size_t k = 0; k < bin.terms(); ++k) {
            const double log_k =
                static_cast<double>(bin.log_k[g][(p * temperature.size() + t) * bin.terms() + k]);
            const double cm2 = std::exp(log_k);
            text += cm2 > 1.01 * atmosphere::kNoAbsorption_cm2 ? format(" {:.4e}", cm2) : " 0";
          }
          text += "\n";
        }
  }
  return text;
}

std::string gases_of(const GasTermTable& table) {
  std::string text;
  for (const TermGas& gas : table.gases)
    text +=
        format("{}{}", text.empty() ? "" : ", ", atmosphere::kGasNames[static_cast<std::size_t>(gas.gas)]);
  return text;
}

}  // namespace ifov::io
