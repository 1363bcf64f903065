#include "materials/bsdf/ross_li.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/bsdf/reflection_angles.h"

namespace ifov::materials {

using std::numbers::pi;

const BsdfModel RossLi::kModel{
    "ross_li",
    "land by the kernels of the BRDF products of MODIS, RossThick and LiSparse-R; the reflectance is f_iso",
    {{"f_vol", "weight of the volume kernel: leaves", BsdfParameter::Form::spectrum},
     {"f_geo", "weight of the geometric kernel: crowns and their shadows", BsdfParameter::Form::spectrum},
     {"hot_spot",
      "half width of the hot spot of leaves (Maignan et al. 2004: 1.5 deg); 0 deg, none, is the kernel of "
      "MODIS",
      BsdfParameter::Form::angle, 0.0, 10.0, "\"0 deg\""}},
    [](const BsdfInputs& inputs) -> std::shared_ptr<const Bsdf> {
      return std::make_shared<RossLi>(inputs.reflectance, inputs.spectrum("f_vol"), inputs.spectrum("f_geo"),
                                      inputs.number("hot_spot"));
    }};

RossLi::RossLi(radiometry::Spectrum isotropic, radiometry::Spectrum volumetric,
               radiometry::Spectrum geometric, double hot_spot_rad)
    : spectra_{std::move(isotropic), std::move(volumetric), std::move(geometric)},
      hot_spot_rad_(hot_spot_rad) {}

std::array<double, 2> RossLi::kernels(const BsdfEvent& event) const {
  const ReflectionAngles a(event);
  const double phase = std::acos(a.cos_phase);
  const double hot = hot_spot_rad_ > 0.0 ? 1.0 + hot_spot_rad_ / (hot_spot_rad_ + phase) : 1.0;
  const double volume =
      ((0.5 * pi - phase) * a.cos_phase + std::sin(phase)) * hot / (a.cos_in + a.cos_out) - 0.25 * pi;

  const double secants = 1.0 / a.cos_in + 1.0 / a.cos_out;
  const double apart = a.shadow_distance(), across = a.tan_in * a.tan_out;
  // h/b = 2 stands before the root; the sine of the azimuth is squared.
  const double cos_t =
      std::min(1.0, 2.0 * std::sqrt(apart * apart + across * across * (1.0 - a.cos_azimuth * a.cos_azimuth)) /
                        secants);
  const double t = std::acos(cos_t);
  const double overlap = (t - std::sin(t) * cos_t) * secants / pi;
  return {volume, overlap - secants + 0.5 * (1.0 + a.cos_phase) / (a.cos_in * a.cos_out)};
}

void RossLi::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                      float* bsdf) const {
  const std::array<double, 2> both = kernels(event);
  const float volume = static_cast<float>(both[0]), crowns = static_cast<float>(both[1]);
  const float per_sr = static_cast<float>(std::numbers::inv_pi);
  const float* __restrict f_iso = parameters[0];
  const float* __restrict f_vol = parameters[1];
  const float* __restrict f_geo = parameters[2];
  for (std::size_t n = 0; n < count; ++n)
    bsdf[n] = per_sr * std::max(0.0f, f_iso[n] + volume * f_vol[n] + crowns * f_geo[n]);
}

}  // namespace ifov::materials
