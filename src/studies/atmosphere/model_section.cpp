#include <algorithm>
#include <cmath>
#include <map>

#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"
#include "studies/atmosphere/model_comparisons.h"

namespace ifov::studies {
namespace {

constexpr const char* kQuantityNames[] = {"transmittance", "light scattered into the path", "emission"};

struct Coverage {
  int count = 0, covered = 0;
  std::vector<double> widths;  // stated, relative, where there is something to see

  double share() const { return static_cast<double>(covered) / count; }
  double width_percent() {
    if (widths.empty()) return 0.0;
    std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2),
                     widths.end());
    return 100.0 * widths[widths.size() / 2];
  }
};

/// Ranges of wavelength, um, for which the page says how wide the stated error is.
struct Range {
  double first, last;
  const char* what;
};
constexpr Range kRanges[] = {{0.38, 0.7, "visible"},
                             {1.55, 1.75, "window at 1.6 um"},
                             {2.1, 2.3, "window at 2.2 um"},
                             {0.9, 0.99, "band of water at 0.94 um"},
                             {3.5, 4.1, "window at 3.8 um"},
                             {8.0, 9.2, "window, 8.0 to 9.2 um"},
                             {10.2, 12.1, "window, 10.2 to 12.1 um"}};

}  // namespace

AtmosphereSection model_section(const std::vector<ModelComparison>& comparisons) {
  AtmosphereSection section;
  section.title = "The model's own error";
  section.text =
      "Whether what is stated of the model's error (data/atmosphere/model_error.txt) holds the differences from "
      "programs with newer data, figure by figure, in cases that the table was made of and, which is what counts, in "
      "those that it was not. Figures of emission have the numbers' half percent besides. Below, how wide it is.";
  if (comparisons.empty()) {
    section.not_measured("model_error", "coverage of the model's error", "atmosphere");
    return section;
  }
  std::map<std::pair<std::string, int>, Coverage> cases;
  for (const ModelComparison& one : comparisons) {
    Coverage& coverage = cases[{one.name, static_cast<int>(one.quantity)}];
    ++coverage.count;
    coverage.covered += one.covered() ? 1 : 0;
  }
  for (const bool make : {false, true})
    for (const auto& [key, coverage] : cases) {
      const auto first =
          std::find_if(comparisons.begin(), comparisons.end(), [&, name = key.first](const auto& one) {
            return one.name == name && static_cast<int>(one.quantity) == key.second;
          });
      if (first->makes_table != make) continue;
      std::string name = format("model_error_{}_{}", key.first, key.second);
      std::replace(name.begin(), name.end(), ' ', '_');
      const std::string meaning =
          format("{}, {}: share of {} figures that the stated error holds{}", key.first,
                 kQuantityNames[key.second], coverage.count, make ? " (the table is made of them)" : "");
      if (make)
        section.figures.report(name, coverage.share(), "", meaning);
      else
        section.figures.at_least(name, coverage.share(), 0.9, "", meaning);
    }
  for (const Range& range : kRanges) {
    Coverage widths;
    double error = 0.0;
    for (const ModelComparison& one : comparisons)
      if (one.quantity == ModelComparison::Quantity::transmittance && !one.makes_table &&
          one.wavelength_um >= range.first && one.wavelength_um < range.last && one.ours > 0.01) {
        widths.widths.push_back(one.stated / one.ours);
        error += std::abs(one.ours / one.reference - 1.0);
      }
    if (widths.widths.empty()) continue;
    const double mean = 100.0 * error / static_cast<double>(widths.widths.size());
    section.figures.report(
        format("model_error_width_{:g}", range.first), widths.width_percent(), "%",
        format("{}: stated of transmittance, median of the cases not in the table; the mean "
               "difference there is {:.2g} %",
               range.what, mean));
  }
  return section;
}

}  // namespace ifov::studies
