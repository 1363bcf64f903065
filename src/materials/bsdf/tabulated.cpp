#include "materials/bsdf/tabulated.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

const BsdfModel Tabulated::kModel{
    "table",
    "as measured: a table of the BRDF by angles and wavelength; the reflectance is a factor, 1 as measured",
    {{"file",
      "five columns: zenith angle of the light and of the view, azimuth between them (0: the viewer has the light in "
      "the back), all in deg, wavelength in um, BRDF in 1/sr; every angle with every other and with every wavelength",
      BsdfParameter::Form::brdf_file},
     {"repair",
      "make a table reciprocal that is not, and passive one that sends back more than arrives, and say what was changed; "
      "without it, such a table is an error",
      BsdfParameter::Form::flag, 0.0, 1.0, "false"}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      auto table = std::make_shared<BsdfTable>(inputs.brdf("file"), inputs.number("repair") > 0.5);
      for (const std::string& change : table->changes())
        if (inputs.say) inputs.say(change);
      return std::make_shared<Tabulated>(inputs.reflectance, std::move(table));
    },
    true};

Tabulated::Tabulated(const radiometry::Spectrum& reflectance, std::shared_ptr<const BsdfTable> table)
    : table_(std::move(table)), spectra_{reflectance} {
  const std::size_t count = table_->wavelength_um().size();
  const double* values = table_->brdf(0, 0, 0);
  largest_ = *std::max_element(values, values + table_->row_count() * count);
  for (std::size_t row = 0; row < table_->row_count(); ++row) {
    std::vector<double> share;
    for (std::size_t n = 0; n < count; ++n)
      share.push_back(largest_ > 0.0 ? values[row * count + n] / largest_ : 0.0);
    // One wavelength alone holds for all.
    spectra_.push_back(count == 1 ? radiometry::Spectrum::constant(share[0])
                                  : radiometry::Spectrum(table_->wavelength_um(), std::move(share),
                                                         radiometry::OutsideRange::error, "measured BRDF"));
  }
}

void Tabulated::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                         float* bsdf) const {
  const ReflectionAngles angles(event);
  const Bracket in = bracket(table_->zenith_rad(), std::acos(angles.cos_in)),
                out = bracket(table_->zenith_rad(), std::acos(angles.cos_out)),
                across = bracket(table_->azimuth_rad(), std::acos(angles.cos_azimuth));
  std::fill_n(bsdf, count, 0.0f);
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    const double weight = (a ? in.share : 1.0 - in.share) * (b ? out.share : 1.0 - out.share) *
                          (c ? across.share : 1.0 - across.share);
    if (!(weight > 0.0)) continue;
    const float* __restrict row = parameters[1 + table_->row(in.below + a, out.below + b, across.below + c)];
    const float scale = static_cast<float>(weight * largest_);
    for (std::size_t n = 0; n < count; ++n) bsdf[n] += scale * row[n];
  }
  const float* __restrict factor = parameters[0];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] *= factor[n];
}

}  // namespace ifov::materials
