#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "materials/bsdf_checks.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kLeastProbability = 1e-3;
constexpr double kMostRoundTrip = 1e-10;
constexpr double kMostAsymmetry = 1e-9;
/// Of what is let through, n^2 times as much one way as the other, in single precision.
constexpr double kMostAsymmetrySingle = 5e-7;
constexpr std::string_view kSinglePrecision[] = {"rough_boundary"};

struct ModelChecks {
  int tested = 0, refused = 0;  ///< surfaces, and parameters that no surface has together
  int distributions = 0;
  double least_probability = 1.0, worst_round_trip = 0.0, worst_reciprocity = 0.0;
};

math::Vec3 at_zenith(double zenith_rad, double azimuth_rad) {
  return {std::sin(zenith_rad) * std::cos(azimuth_rad), std::sin(zenith_rad) * std::sin(azimuth_rad),
          std::cos(zenith_rad)};
}

void check_surface(const materials::Bsdf& bsdf, int draws, std::uint64_t seed, ModelChecks& checks) {
  using materials::Side;
  std::vector<Side> sides{Side::reflected};
  if (bsdf.may_transmit()) sides.push_back(Side::transmitted);
  ++checks.tested;
  std::uint64_t number = 0;
  for (const math::Vec3 out : {at_zenith(0.2, 0.0), at_zenith(0.9, 0.5), at_zenith(1.4, 2.0)})
    for (const Side side : sides) {
      const double width = bsdf.lobe_slopes().least;
      const double p = side == Side::reflected && width > 0.0
                           ? materials::samples_against_density(bsdf, out, width, width, draws)
                           : materials::directions_against_density(bsdf, out, side, draws, seed + number++);
      ++checks.distributions;
      checks.least_probability = std::min(checks.least_probability, p);
      checks.worst_round_trip =
          std::max(checks.worst_round_trip, materials::worst_round_trip(bsdf, out, side, 20));
      checks.worst_reciprocity =
          std::max(checks.worst_reciprocity, materials::worst_reciprocity(bsdf, out, side, 20));
    }
}

}  // namespace

ReportSection models_section(const StudyOptions& options) {
  ReportSection section;
  section.title = "Models";
  section.text =
      "Every model of the registry, its parameters at the same shares of their ranges, seen from 11, 52 and 80 deg. "
      "Directions that it draws must follow its density: chi-square over cells, its probability times the number of "
      "such tests of all models (Bonferroni) no less than 0.001. The inverse of its warp must lead back to the "
      "direction, and the BSDF must be the same with both directions exchanged.";
  std::vector<double> shares{0.02, 0.15, 0.35, 0.5, 0.65, 0.85, 1.0};
  if (options.is_quick()) shares = {0.15, 0.5, 0.85};
  if (options.trials == 1) shares = {0.5};
  const int draws = options.is_quick() ? 20000 : 100000;
  std::vector<std::pair<std::string, ModelChecks>> found;
  int tests = 0;
  for (const materials::BsdfModel* model : materials::bsdf_models()) {
    ModelChecks checks;
    for (const double share : shares) {
      std::shared_ptr<const materials::Bsdf> bsdf;
      try {
        bsdf = model->make(materials::inputs_within_ranges(*model, share));
      } catch (const InputError&) {
        ++checks.refused;
        continue;
      }
      if (bsdf->is_delta()) continue;
      check_surface(*bsdf, draws, options.seed, checks);
    }
    tests += checks.distributions;
    if (checks.tested + checks.refused > 0) found.emplace_back(model->key, checks);
  }
  for (const auto& [key, checks] : found) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const bool any = checks.tested > 0;
    section.figures.at_least(format("{}_samples", key),
                             any ? std::min(1.0, checks.least_probability * tests) : none, kLeastProbability,
                             "",
                             format("{}: samples against density, {} tests; {} surfaces, {} refused", key,
                                    checks.distributions, checks.tested, checks.refused));
    section.figures.at_most(format("{}_round_trip", key), any ? checks.worst_round_trip : none,
                            kMostRoundTrip, "", format("{}: direction out of the inverse of its warp", key));
    const bool single = std::find(std::begin(kSinglePrecision), std::end(kSinglePrecision), key) !=
                        std::end(kSinglePrecision);
    section.figures.at_most(format("{}_reciprocity", key), any ? checks.worst_reciprocity : none,
                            single ? kMostAsymmetrySingle : kMostAsymmetry, "",
                            format("{}: BSDF with both directions exchanged{}", key,
                                   single ? ", rounded to single precision on either side" : ""));
  }
  return section;
}

}  // namespace ifov::studies
