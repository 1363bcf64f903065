#include <algorithm>
#include <cctype>

#include "atmosphere/profile/gas_requests.h"
#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

using atmosphere::Gas;
using atmosphere::GasRequest;
using atmosphere::GasRequests;

constexpr const char* kOff = "off";  // in place of an amount

SchemaType<GasRequest::Level> gas_level_type() {
  Record<GasRequest::Level> record("amount at a height", "How much of a gas there is at one altitude.");
  record
      .required("altitude", &GasRequest::Level::altitude_km, quantity(kLength, {}, 1e-3),
                "above mean sea level")
      .required("mixing_ratio", &GasRequest::Level::ppmv,
                quantity(kMixingRatioByVolume, Range::between(0.0, 1e6, "ppm")), "by volume");
  return record.type();
}

void check_request(const GasRequest& request, const DocumentNode& node) {
  if (request.levels.empty() && !request.ground_ppmv && !request.column_atm_cm)
    node.fail(
        "nothing is said of this gas: expected 'mixing_ratio', 'column' or 'levels', or \"off\" in place of all");
  if (!request.levels.empty() && request.ground_ppmv)
    node.given("mixing_ratio")
        .fail("'mixing_ratio' scales the model's profile, and 'levels' take its place: leave one out");
  for (std::size_t k = 0; k < request.levels.size(); ++k) {
    const double here = request.levels[k].altitude_km;
    const DocumentNode& altitude = node.given("levels").items()[k].given("altitude");
    if (k > 0 && !(here > request.levels[k - 1].altitude_km))
      altitude.fail(format("the altitudes of a profile must rise: {:g} km follows {:g} km", here,
                           request.levels[k - 1].altitude_km));
    if (here > atmosphere::kTopOfAtmosphereKm)
      altitude.fail(format("a level at {:g} km is above the air, which ends at {:g} km", here,
                           atmosphere::kTopOfAtmosphereKm));
  }
}

SchemaType<GasRequest> request_type(Gas gas) {
  Record<GasRequest> record(
      "amount of a gas", "How much of a gas there is: its whole profile scaled, or a profile of your own.");
  const bool water = gas == Gas::h2o;
  record.at_most_one()
      .one("mixing_ratio", &GasRequest::ground_ppmv,
           quantity(kMixingRatioByVolume, Range::between(0.0, 1e6, "ppm")),
           "at the ground, by volume: the model's profile is scaled alike at all heights")
      .one("column", &GasRequest::column_atm_cm,
           water ? quantity(kWaterColumn, Range::at_least(0.0, "g/cm2"), atmosphere::kVapourAtmCmPerGram)
                 : quantity(kGasColumn, Range::at_least(0.0, "atm-cm")),
           "above the ground: the model's profile, or that of 'levels', is scaled alike at all heights")
      .optional(
          "levels", &GasRequest::levels, list(gas_level_type(), 2, 1000),
          "from the ground up, linear between; below the first its value holds, above the last the model's goes on")
      .check(check_request);
  const SchemaType<std::string> word = word_type({kOff});
  const SchemaType<GasRequest> off{word.description,
                                   [word](const DocumentNode& node) {
                                     word.read(node);
                                     GasRequest request;
                                     request.off = true;
                                     return request;
                                   },
                                   [word](const GasRequest& request, Writing& writing) -> Written {
                                     if (!request.off) return std::nullopt;
                                     return word.write(kOff, writing);
                                   }};
  return either(off, record.type());
}

}  // namespace

SchemaType<GasRequests> gases_type() {
  Record<GasRequests> record("gases",
                             "How much there is of each gas that absorbs; what is not named stays as it is.");
  for (std::size_t g = 0; g < atmosphere::kGasCount; ++g) {
    std::string key(atmosphere::kGasNames[g]);
    std::transform(key.begin(), key.end(), key.begin(),
                   [](char c) { return static_cast<char>(std::tolower(c)); });
    record.optional(key,
                    via([g](GasRequests& gases, const GasRequest& request) { gases.of[g] = request; },
                        [g](const GasRequests& gases) { return gases.of[g] ? &*gases.of[g] : nullptr; }),
                    request_type(static_cast<Gas>(g)),
                    format("{}, \"off\" or an amount", atmosphere::kGasNames[g]));
  }
  static const std::string off = kOff;
  record.optional(
      "n2",
      via([](GasRequests& gases, const std::string&) { gases.nitrogen = false; },
          [](const GasRequests& gases) { return gases.nitrogen ? nullptr : &off; }),
      word_type({kOff}),
      "\"off\": without what pairs of nitrogen molecules absorb about 4.3 um; the air weighs the same");
  return record.type();
}

}  // namespace ifov::io
