#include "materials/bsdf/tabulated.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.h"
#include "materials/bsdf/microfacet/facet_frame.h"
#include "materials/bsdf/narrow_lobes.h"
#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

namespace {

constexpr std::string_view kTransmitted = "transmitted";

std::shared_ptr<const Bsdf> table_of(const BsdfInputs& inputs) {
  const bool repair = inputs.number("repair") > 0.5;
  auto reflected = std::make_shared<BsdfTable>(inputs.brdf("file"), repair);
  std::shared_ptr<BsdfTable> transmitted;
  std::vector<std::string> changes;
  if (inputs.has(kTransmitted)) {
    try {
      transmitted =
          std::make_shared<BsdfTable>(inputs.brdf(kTransmitted), repair, BsdfTable::Kind::transmitted);
    } catch (const InputError& error) {
      throw InputError(format("the table of what is transmitted: {}", error.what()));
    }
    for (const std::string& change : transmitted->changes())
      changes.push_back(format("of what is transmitted {}", change));
    BsdfTable::limit_sum(*reflected, *transmitted, repair);
  }
  changes.insert(changes.begin(), reflected->changes().begin(), reflected->changes().end());
  // As narrow as what facets of the least slope that paths find reflect: 1 over the peak of D / 4.
  constexpr double kNarrow_sr = 4.0 * std::numbers::pi * kLeastFoundSlope * kLeastFoundSlope;
  double peak_sr = reflected->narrowest_peak_sr();
  if (transmitted) peak_sr = std::min(peak_sr, transmitted->narrowest_peak_sr());
  if (peak_sr < kNarrow_sr)
    changes.push_back(format(
        "its table has a peak of {:.2g} sr: directions are drawn without knowing it, and sunlight that it "
        "throws on other surfaces is found so seldom, below {:.2g} sr, that error bars may not hold it",
        peak_sr, kNarrow_sr));
  const bool isotropic = reflected->is_isotropic() && (!transmitted || transmitted->is_isotropic());
  if (isotropic && inputs.number("direction") != 0.0)
    throw InputError("'direction' is of tables with azimuths of light and view; this one has none");
  for (const std::string& change : changes)
    if (inputs.say) inputs.say(change);
  return std::make_shared<Tabulated>(inputs.reflectance, std::move(reflected), std::move(transmitted),
                                     inputs.number("direction"));
}

}  // namespace

const BsdfModel Tabulated::kModel{
    "table",
    "as measured: tables of the BRDF, and of the BTDF of a sheet, by angles and wavelength; the reflectance is a factor, 1 as measured",
    {{"file",
      "five columns: zenith angle of the light and of the view, azimuth between them (0: the viewer has the light in "
      "the back), all in deg, wavelength in um, BRDF in 1/sr; or, not isotropic, six: zenith angle and azimuth of the light, "
      "both of the view, wavelength, BRDF; every angle with every other and with every wavelength",
      BsdfParameter::Form::brdf_file},
     {kTransmitted,
      "the same of the BTDF of a sheet that is alike from both sides; zenith angles of the view are from the normal on its side",
      BsdfParameter::Form::brdf_file,
      0.0,
      1.0,
      {},
      true},
     {"direction",
      "of azimuth 0 of six columns, from the tangent (east); azimuths are counterclockwise as seen from the side of the light",
      BsdfParameter::Form::angle, -360.0, 360.0, "\"0 deg\""},
     {"repair",
      "make a table reciprocal that is not, and passive one that sends on more than arrives, and say what was changed; "
      "without it, such a table is an error",
      BsdfParameter::Form::flag, 0.0, 1.0, "false"}},
    table_of,
    true};

Tabulated::Tabulated(const radiometry::Spectrum& reflectance, std::shared_ptr<const BsdfTable> reflected,
                     std::shared_ptr<const BsdfTable> transmitted, double direction_rad)
    : spectra_{reflectance}, direction_rad_(direction_rad) {
  add(std::move(reflected), sides_[0]);
  if (transmitted) add(std::move(transmitted), sides_[1]);
}

std::shared_ptr<const Bsdf> Tabulated::behind() const {
  if (!may_transmit() || is_isotropic() || direction_rad_ == 0.0) return nullptr;
  return std::make_shared<Tabulated>(spectra_[0], sides_[0].table, sides_[1].table, -direction_rad_);
}

void Tabulated::add(std::shared_ptr<const BsdfTable> table, OfSide& side) {
  const std::size_t count = table->wavelength_um().size();
  const double* values = table->brdf(0, 0, 0);
  side.largest = *std::max_element(values, values + table->row_count() * count);
  side.first = spectra_.size();
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    std::vector<double> share;
    for (std::size_t n = 0; n < count; ++n)
      share.push_back(side.largest > 0.0 ? values[row * count + n] / side.largest : 0.0);
    // One wavelength alone holds for all.
    spectra_.push_back(count == 1 ? radiometry::Spectrum::constant(share[0])
                                  : radiometry::Spectrum(table->wavelength_um(), std::move(share),
                                                         radiometry::OutsideRange::error, "measured BRDF"));
  }
  side.table = std::move(table);
}

bool Tabulated::is_isotropic() const {
  return sides_[0].table->is_isotropic() && (!may_transmit() || sides_[1].table->is_isotropic());
}

void Tabulated::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                         float* bsdf) const {
  const bool through = event.side == Side::transmitted;
  const OfSide& side = sides_[through ? 1 : 0];
  const ReflectionAngles angles(event);
  BsdfTable::Direction in{std::acos(angles.cos_in), 0.0}, out{std::acos(angles.cos_out), 0.0};
  double between = 0.0;
  if (side.table->is_isotropic()) {
    between = std::acos(angles.cos_azimuth);
  } else {
    const math::Frame frame = facet_frame(event.normal, event.tangent);
    const math::Vec3 light = frame.local_from_outer(event.incoming),
                     view = frame.local_from_outer(event.outgoing);
    // Each as seen from its own side; the normal is on that of the view.
    const double turn = std::atan2(light.y, light.x) - direction_rad_;
    in.azimuth_rad = through ? -turn : turn;
    out.azimuth_rad = std::atan2(view.y, view.x) - direction_rad_;
  }
  // Added up in one order both ways: reciprocal to the last bit.
  if (in.zenith_rad > out.zenith_rad) std::swap(in, out);
  const BsdfTable::Corners corners = side.table->corners(in, out, between);
  std::fill_n(bsdf, count, 0.0f);
  for (std::size_t k = 0; k < corners.count; ++k) {
    const float* __restrict row = parameters[side.first + corners.row[k]];
    const float scale = static_cast<float>(corners.weight[k] * side.largest);
    for (std::size_t n = 0; n < count; ++n) bsdf[n] += scale * row[n];
  }
  const float* __restrict factor = parameters[0];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] *= factor[n];
}

}  // namespace ifov::materials
