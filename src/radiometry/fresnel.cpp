#include "radiometry/fresnel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ifov::radiometry {
namespace {

using Complex = std::complex<double>;

Complex root_of(Complex index, double sine_squared) {
  const Complex root = std::sqrt(index * index - sine_squared);
  return root.imag() < 0.0 ? -root : root;
}

/// n times the cosine of the refracted ray, of the root that fades away from the surface.
Complex refracted(Complex index, double cosine) {
  return root_of(index, std::max(0.0, 1.0 - cosine * cosine));
}

/// One boundary of a stack, by indices and normal_index() on either side.
struct Step {
  Complex from, to, normal_from, normal_to;
  FresnelAmplitudes reflected() const {
    const Complex p = to * to * normal_from, q = from * from * normal_to;
    return {(p - q) / (p + q), (normal_from - normal_to) / (normal_from + normal_to)};
  }
  FresnelAmplitudes transmitted() const {
    return {2.0 * from * to * normal_from / (to * to * normal_from + from * from * normal_to),
            2.0 * normal_from / (normal_from + normal_to)};
  }
};

/// Both amplitudes of a film, p and s.
struct Film {
  Complex here, beyond, turn;  ///< the phase that the film adds once: exp(i k d)
  Step first, second;
  Film(const FilmStack& stack, double sine)
      : here(normal_index(stack.here, sine)),
        beyond(normal_index(stack.beyond, sine)),
        turn(),
        first{stack.here, stack.film, here, normal_index(stack.film, sine)},
        second{stack.film, stack.beyond, first.normal_to, beyond} {
    turn = std::exp(Complex(0.0, 2.0 * std::numbers::pi * stack.waves) * first.normal_to);
  }
  FresnelAmplitudes reflected() const {
    const FresnelAmplitudes a = first.reflected(), b = second.reflected();
    const Complex e = turn * turn;
    return {(a.p + b.p * e) / (1.0 + a.p * b.p * e), (a.s + b.s * e) / (1.0 + a.s * b.s * e)};
  }
  FresnelAmplitudes transmitted() const {
    const FresnelAmplitudes a = first.reflected(), b = second.reflected(), c = first.transmitted(),
                            d = second.transmitted();
    const Complex e = turn * turn;
    return {c.p * d.p * turn / (1.0 + a.p * b.p * e), c.s * d.s * turn / (1.0 + a.s * b.s * e)};
  }
};

}  // namespace

Complex normal_index(Complex index, double sine) { return root_of(index, sine * sine); }

FresnelAmplitudes film_reflection_amplitudes(const FilmStack& stack, double sine) {
  return Film(stack, sine).reflected();
}

FresnelAmplitudes film_transmission_amplitudes(const FilmStack& stack, double sine) {
  return Film(stack, sine).transmitted();
}

PowerShares film_shares(const FilmStack& stack, double sine) {
  const Film film(stack, sine);
  if (!(film.here.real() > 0.0)) return {1.0, 1.0, 0.0, 0.0};
  const FresnelAmplitudes r = film.reflected(), t = film.transmitted();
  // Poynting's vector along the normal: Re(n cos) |E|^2 across the plane of incidence, Re(n conj cos) |E|^2 in it.
  const double s = film.beyond.real() / film.here.real();
  const double p = (stack.beyond * std::conj(film.beyond / stack.beyond)).real() /
                   (stack.here * std::conj(film.here / stack.here)).real();
  return {std::norm(r.p), std::norm(r.s), std::max(0.0, p * std::norm(t.p)),
          std::max(0.0, s * std::norm(t.s))};
}

FresnelAmplitudes fresnel_transmission_amplitudes(Complex index, double cosine) {
  if (index == 1.0) return {1.0, 1.0};
  const Complex beyond = refracted(index, cosine);
  return {2.0 * index * cosine / (index * index * cosine + beyond), 2.0 * cosine / (cosine + beyond)};
}

FresnelAmplitudes fresnel_reflection_amplitudes(Complex index, double cosine) {
  if (index == 1.0) return {0.0, 0.0};  // no surface, also at grazing incidence
  const Complex beyond = refracted(index, cosine), square = index * index;
  return {(square * cosine - beyond) / (square * cosine + beyond), (cosine - beyond) / (cosine + beyond)};
}

MuellerMatrix fresnel_reflection(Complex index, double cosine) {
  const FresnelAmplitudes r = fresnel_reflection_amplitudes(index, cosine);
  const double p = std::norm(r.p), s = std::norm(r.s), sum = 0.5 * (p + s), difference = 0.5 * (p - s);
  const Complex both = r.p * std::conj(r.s);
  return MuellerMatrix({sum, difference, 0, 0,           //
                        difference, sum, 0, 0,           //
                        0, 0, both.real(), both.imag(),  //
                        0, 0, -both.imag(), both.real()});
}

MuellerMatrix fresnel_transmission(double index, double cosine) {
  const double sine_squared = std::max(0.0, 1.0 - cosine * cosine), left = index * index - sine_squared;
  if (!(left > 0.0) || !(cosine > 0.0)) return MuellerMatrix::diagonal(0.0, 0.0, 0.0, 0.0);
  const double beyond = std::sqrt(left), square = index * index;
  const double p = 2.0 * index * cosine / (square * cosine + beyond), s = 2.0 * cosine / (cosine + beyond);
  const double flux = beyond / cosine;
  const double sum = 0.5 * flux * (p * p + s * s), difference = 0.5 * flux * (p * p - s * s),
               both = flux * p * s;
  return MuellerMatrix({sum, difference, 0, 0, difference, sum, 0, 0, 0, 0, both, 0, 0, 0, 0, both});
}

}  // namespace ifov::radiometry
