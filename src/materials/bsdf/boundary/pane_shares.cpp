#include "materials/bsdf/boundary/pane_shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::materials {
namespace {

struct Series {
  double reflected, transmitted;
  Series(double front, double in, double front_within, double out, double back, double beyond, double once) {
    const double sum = 1.0 / std::max(1e-12, 1.0 - front_within * back * once * once);
    reflected = front + in * once * back * once * out * sum;
    transmitted = in * once * beyond * sum;
  }
};

}  // namespace

PaneFace bare_face(std::complex<double> index, double cosine) {
  const radiometry::FresnelAmplitudes r = radiometry::fresnel_reflection_amplitudes(index, cosine);
  const double p = std::norm(r.p), s = std::norm(r.s);
  const radiometry::PowerShares both{p, s, 1.0 - p, 1.0 - s};
  return {both, both};
}

double passes_once(std::complex<double> index, double cosine, double thickness_um, double um) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return std::exp(-4.0 * std::numbers::pi * radiometry::normal_index(index, sine).imag() * thickness_um / um);
}

radiometry::PowerShares pane_shares(const PaneFace& front, const PaneFace& back, double passes) {
  const auto& f = front.outside;
  const auto& w = front.within;
  const auto& b = back.within;
  const Series p(f.reflected_p, f.transmitted_p, w.reflected_p, w.transmitted_p, b.reflected_p,
                 b.transmitted_p, passes);
  const Series s(f.reflected_s, f.transmitted_s, w.reflected_s, w.transmitted_s, b.reflected_s,
                 b.transmitted_s, passes);
  return {p.reflected, s.reflected, p.transmitted, s.transmitted};
}

}  // namespace ifov::materials
