#include <algorithm>
#include <cmath>
#include <set>

#include "atmosphere/gas/band_model.h"
#include "core/format.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {

AtmosphereSection terms_section(const SectionOptions&) {
  using namespace atmosphere;
  AtmosphereSection section;
  section.title = "Absorption terms";
  section.text =
      "The band model's transmittance exp(-x^a) becomes a sum of a few exponentials, one set for each of the "
      "exponents a "
      "in use.";
  std::set<double> exponents;
  for (const Band& band : BandModel::instance().bands()) exponents.insert(band.a);
  Plot plot;
  plot.title = "Largest error of transmittance, by exponent";
  plot.x_label = "exponent a";
  plot.y_label = "largest error";
  plot.y_log = true;
  for (const auto& [count, limit, colour] :
       {std::tuple{8, 0.001, "#0072b2"}, {5, 0.005, "#d55e00"}, {3, 0.02, "#009e73"}}) {
    PlotSeries series{format("{} terms", count), colour, {}, {}};
    for (const double a : exponents) {
      const AbsorptionTerms& terms = absorption_terms(a, count);
      double largest = 0.0;
      for (double log_x = -7.0; log_x <= 3.0; log_x += 0.02) {
        const double x = std::pow(10.0, log_x);
        double sum = 0.0;
        for (std::size_t j = 0; j < terms.k.size(); ++j) sum += terms.weight[j] * std::exp(-terms.k[j] * x);
        largest = std::max(largest, std::abs(sum - std::exp(-std::pow(x, a))));
      }
      series.x.push_back(a);
      series.y.push_back(largest);
    }
    section.figures.at_most(
        format("terms_{}", count), *std::max_element(series.y.begin(), series.y.end()), limit, "",
        format("{} terms against the closed form, all {} exponents: largest error", count, exponents.size()));
    plot.series.push_back(std::move(series));
  }
  section.plots.push_back({"terms", plot, "Errors of transmittance over x from 1e-7 to 1e3."});
  return section;
}

}  // namespace ifov::studies
