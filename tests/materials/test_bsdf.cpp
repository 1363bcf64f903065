#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/lambertian.h"
#include "materials/bsdf/mirror.h"
#include "materials/bsdf/oren_nayar.h"
#include "materials/bsdf_checks.h"
#include "materials/material.h"

namespace ifov::materials::test_bsdf {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;

/// Points of a regular grid, shifted off its edges: deterministic, and finer than any random set of that
/// size.
double grid(int i, int n) { return (i + 0.5) / n; }

const math::Normal3 kTilted = math::as_normal(math::normalized({0.3, -0.5, 0.7}));

/// A direction at an angle from a normal.
Vec3 direction(math::Normal3 normal, double zenith_rad, double azimuth_rad) {
  const Vec3 n = normal.as_vector();
  const Vec3 a = math::normalized(math::cross(n, {1.0, 0.0, 0.0})), b = math::cross(n, a);
  const double s = std::sin(zenith_rad);
  return s * std::cos(azimuth_rad) * a + s * std::sin(azimuth_rad) * b + std::cos(zenith_rad) * n;
}

BsdfEvent event_of(double out_rad, double in_rad, double azimuth_rad, Side side = Side::reflected) {
  const Vec3 incoming = direction(kTilted, in_rad, azimuth_rad);
  const Vec3 n = kTilted.as_vector();
  return {direction(kTilted, out_rad, 0.0),
          side == Side::reflected ? incoming : incoming - 2.0 * math::dot(n, incoming) * n, kTilted,
          direction(kTilted, 0.5 * pi, 0.3), side};
}

/// A model with parameters and spectra of its own that is not separable, transmits and has a direction: what
/// a path, a material and the registry promise holds for whatever comes.
class Dummy final : public Bsdf {
 public:
  Dummy(Spectrum back, double share) : spectra_{std::move(back)}, share_(share) {}
  bool may_transmit() const override { return true; }
  std::span<const Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override {
    const double cosines = event.outgoing_cosine() + event.incoming_cosine();
    const double side = event.side == Side::reflected ? share_ : 1.0 - share_;
    for (std::size_t n = 0; n < count; ++n)
      bsdf[n] = static_cast<float>(side * static_cast<double>(parameters[0][n]) * cosines / (2.0 * pi));
  }

 private:
  std::vector<Spectrum> spectra_;
  double share_;
};

/// One of each model, by name: in the middle of its parameters' ranges.
std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> models() {
  std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> list;
  for (const BsdfModel* model : bsdf_models())
    list.emplace_back(model->key, model->make(inputs_within_ranges(*model, 0.5)));
  list.emplace_back("dummy", std::make_shared<Dummy>(Spectrum({0.4, 1.0}, {0.5, 0.8}), 0.7));
  return list;
}

std::vector<Side> sides_of(const Bsdf& bsdf) {
  return bsdf.may_transmit() ? std::vector{Side::reflected, Side::transmitted} : std::vector{Side::reflected};
}

/// Largest relative deviation of sample() from pdf() over 64 cells of equal solid angle, for a Fibonacci
/// lattice of numbers, which leaves no noise but that of the cells' edges and lies along none of them.
double worst_cell(const Bsdf& bsdf, Side side) {
  constexpr std::int64_t kDraws = 121393, kStep = 75025;
  constexpr int kRings = 8, kSectors = 8;
  const Vec3 n = side == Side::reflected ? kTilted.as_vector() : -kTilted.as_vector();
  const Vec3 a = math::normalized(math::cross(n, {1.0, 0.0, 0.0})), b = math::cross(n, a);
  BsdfEvent event = event_of(0.6, 0.0, 0.0, side);
  std::vector<double> counted(kRings * kSectors, 0.0), expected(kRings * kSectors, 0.0);
  const auto cell = [&](Vec3 d) {
    const double azimuth = std::atan2(math::dot(d, b), math::dot(d, a)) / (2.0 * pi) + 0.5;
    const int ring = std::min(kRings - 1, static_cast<int>(math::dot(d, n) * kRings));
    const int sector = std::min(kSectors - 1, static_cast<int>(azimuth * kSectors));
    return static_cast<std::size_t>(ring * kSectors + sector);
  };
  for (std::int64_t k = 0; k < kDraws; ++k) {
    const BsdfSample s = bsdf.sample(event, (static_cast<double>(k) + 0.5) / kDraws,
                                     (static_cast<double>(k * kStep % kDraws) + 0.5) / kDraws);
    if (!(s.weight > 0.0)) continue;
    event.incoming = s.incoming;
    EXPECT_GT(event.incoming_cosine(), 0.0);
    EXPECT_NEAR(s.pdf, bsdf.pdf(event), 1e-9 * s.pdf + 1e-12);
    counted[cell(s.incoming)] += 1.0 / kDraws;
  }
  constexpr int kFine = 40;
  for (int i = 0; i < kRings * kFine; ++i)
    for (int j = 0; j < kSectors * kFine; ++j) {
      const double z = grid(i, kRings * kFine), azimuth = 2.0 * pi * (grid(j, kSectors * kFine) - 0.5);
      const double r = std::sqrt(1.0 - z * z);
      event.incoming = r * std::cos(azimuth) * a + r * std::sin(azimuth) * b + z * n;
      expected[cell(event.incoming)] += bsdf.pdf(event) * 2.0 * pi / (kRings * kSectors * kFine * kFine);
    }
  constexpr double kLeast = 3e-3;  // of a cell, whose mean share is 0.016: less is noise of the edges
  double worst = 0.0, total = 0.0, drawn = 0.0;
  for (std::size_t c = 0; c < counted.size(); ++c) {
    worst = std::max(worst, std::abs(counted[c] - expected[c]) / std::max(kLeast, expected[c]));
    total += expected[c];
    drawn += counted[c];
  }
  EXPECT_NEAR(total, drawn, 1e-3);
  return worst;
}

/// A fault: directions uniform over the hemisphere with the density of a cosine.
class Skewed final : public Bsdf {
 public:
  bool is_separable() const override { return true; }
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override {
    const Vec3 n = view.normal.as_vector();
    const Vec3 a = math::normalized(math::cross(n, {1.0, 0.0, 0.0})), b = math::cross(n, a);
    const double r = std::sqrt(1.0 - u1 * u1), azimuth = 2.0 * pi * u2;
    return {r * std::cos(azimuth) * a + r * std::sin(azimuth) * b + u1 * n, 1.0, u1 / pi};
  }
};

TEST(Bsdf, SamplesFollowTheDensity) {
  for (const auto& [name, bsdf] : models()) {
    if (bsdf->is_delta()) continue;
    for (const Side side : sides_of(*bsdf)) EXPECT_LT(worst_cell(*bsdf, side), 0.02) << name;
  }
}

TEST(Bsdf, AWrongDensityIsSeen) { EXPECT_GT(worst_cell(Skewed(), Side::reflected), 0.2); }

TEST(Bsdf, WeightsAreShapeTimesCosineOverDensity) {
  constexpr int kDraws = 64;
  for (const auto& [name, bsdf] : models()) {
    if (bsdf->is_delta()) continue;
    for (const Side side : sides_of(*bsdf)) {
      double sum = 0.0;
      BsdfEvent event = event_of(0.4, 0.0, 0.0, side);
      for (int i = 0; i < kDraws; ++i)
        for (int j = 0; j < kDraws; ++j) {
          const BsdfSample s = bsdf->sample(event, grid(i, kDraws), grid(j, kDraws));
          if (!(s.weight > 0.0)) continue;
          event.incoming = s.incoming;
          EXPECT_NEAR(s.weight, bsdf->shape(event) * event.incoming_cosine() / s.pdf, 1e-9) << name;
          sum += s.weight / kDraws / kDraws;
        }
      // A separable shape scatters all that its factor leaves; the shape of another is 1.
      if (bsdf->seam(event) == 0.0) {
        EXPECT_NEAR(sum, bsdf->is_separable() ? 1.0 : pi, 1e-9) << name;
      }
      event.incoming = -event.incoming;
      EXPECT_EQ(bsdf->shape(event), 0.0) << name;
    }
  }
}

TEST(Bsdf, InvertsItsWarp) {
  for (const auto& [name, bsdf] : models()) {
    if (bsdf->is_delta()) continue;
    for (const math::Normal3 n :
         {kTilted, math::Normal3{0, 0, 1}, math::Normal3{0, 0, -1}, math::Normal3{1, 0, 0}})
      for (const Side side : sides_of(*bsdf))
        for (int i = 0; i < 17; ++i)
          for (int j = 0; j < 17; ++j) {
            if (i == 8 && j == 8) continue;  // the centre of the disk has no azimuth
            BsdfEvent event{n.as_vector(), {}, n, {}, side};
            const BsdfSample sample = bsdf->sample(event, grid(i, 17), grid(j, 17));
            if (!(sample.weight > 0.0)) continue;
            event.incoming = sample.incoming;
            const UnitSquarePoint u = bsdf->invert(event);
            if (bsdf->seam(event) > 0.0) {
              EXPECT_LT(math::length(bsdf->sample(event, u.u1, u.u2).incoming - event.incoming), 1e-9)
                  << name;
              continue;
            }
            EXPECT_NEAR(u.u1, grid(i, 17), 1e-9) << name;
            EXPECT_NEAR(u.u2, grid(j, 17), 1e-9) << name;
          }
  }
}

TEST(Bsdf, IsReciprocal) {
  const float factor[] = {0.2f, 0.9f};
  const std::vector<const float*> rows(1000, factor);
  for (const auto& [name, bsdf] : models())
    for (const Side side : sides_of(*bsdf))
      for (const double out : {0.0, 0.3, 1.0, 1.4})
        for (const double in : {0.1, 0.7, 1.3})
          for (const double azimuth : {0.0, 1.0, 2.5, pi}) {
            const BsdfEvent there = event_of(out, in, azimuth, side);
            BsdfEvent back = there;
            std::swap(back.outgoing, back.incoming);
            if (side == Side::transmitted) back.normal = -back.normal;
            // Of a boundary of a medium, where radiance is over n^2, the other way is n^2 times as much.
            const bool bends = side == Side::transmitted && bsdf->passage() == Passage::into;
            const Bsdf& other = bends ? *bsdf->behind() : *bsdf;
            const float square =
                static_cast<float>(bends ? bsdf->bending_index() * bsdf->bending_index() : 1.0);
            float a[2] = {}, b[2] = {};
            if (bsdf->is_separable()) {
              a[0] = static_cast<float>(bsdf->shape(there));
              b[0] = static_cast<float>(bsdf->shape(back));
            } else {
              bsdf->evaluate(there, rows, 2, a);
              other.evaluate(back, rows, 2, b);
            }
            for (int n = 0; n < 2; ++n)
              EXPECT_NEAR(a[n], square * b[n], 1e-5f * std::abs(a[n]) + 1e-7f) << name;
          }
}

TEST(Bsdf, TheRegistryKnowsEveryModel) {
  ASSERT_GE(bsdf_models().size(), 3u);
  for (const BsdfModel* model : bsdf_models()) {
    EXPECT_EQ(&bsdf_model(model->key), model);
    EXPECT_FALSE(model->doc.empty()) << model->key;
    for (const BsdfParameter& p : model->parameters)
      EXPECT_FALSE(p.doc.empty()) << model->key << '.' << p.key;
  }
  try {
    bsdf_model("lambertain");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "there is no scattering model 'lambertain'; did you mean 'lambertian'? There are 'lambertian', 'mirror', 'oren_nayar', "
        "'ross_li', 'roujean', 'rpv', 'hapke', 'snow', 'table', 'rough_conductor', 'rough_dielectric', "
        "'ward', 'smooth', 'rough_boundary', 'slab', 'film', 'sea', 'leaf', 'priest_germer', "
        "'maxwell_beard', 'shell_target' and 'maignan'");
  }
}

TEST(Bsdf, DirectionalHemisphericalIsTheIntegral) {
  // Of the dummy: share x factor x (cos / 2 + 1 / 3), by hand.
  const Dummy dummy(Spectrum({0.4, 1.0}, {0.5, 0.8}), 0.7);
  for (const double cosine : {1.0, 0.6, 0.05}) {
    const Spectrum there = directional_hemispherical(dummy, Side::reflected, cosine);
    EXPECT_NEAR(there.at(0.4), 0.7 * 0.5 * (0.5 * cosine + 1.0 / 3.0), 1e-4);
    EXPECT_NEAR(there.at(1.0), 0.7 * 0.8 * (0.5 * cosine + 1.0 / 3.0), 1e-4);
    const Spectrum behind = directional_hemispherical(dummy, Side::transmitted, cosine);
    EXPECT_NEAR(behind.at(0.4), 0.3 * 0.5 * (0.5 * cosine + 1.0 / 3.0), 1e-4);
  }
  const Spectrum all = directional_hemispherical(dummy, Side::reflected, kBihemispherical);
  EXPECT_NEAR(all.at(1.0), 0.7 * 0.8 * 2.0 / 3.0, 1e-3);
}

TEST(Bsdf, NoModelSendsBackMoreThanArrives) {
  Material m{"paint", Spectrum::constant(0.9)};
  m.bsdf = std::make_shared<Dummy>(Spectrum::constant(1.0), 1.0);
  EXPECT_NO_THROW(check(m));
  class Bright final : public Bsdf {
   public:
    void evaluate(const BsdfEvent&, ParameterSpectra, std::size_t count, float* bsdf) const override {
      std::fill_n(bsdf, count, 0.4f);
    }
  };
  m.bsdf = std::make_shared<Bright>();
  try {
    check(m);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "material 'paint': of light that comes 0 deg from the normal it sends back 1.257 times as much; its "
        "parameters belong to no passive surface");
  }
}

TEST(Mirror, ReflectsAboutTheNormal) {
  const Bsdf& mirror = *Mirror::shared();
  const double r = std::numbers::sqrt2 / 2.0;
  BsdfEvent event{{r, 0.0, r}, {}, {0.0, 0.0, 1.0}, {}, Side::reflected};
  const BsdfSample s = mirror.sample(event, 0.3, 0.9);
  EXPECT_NEAR(s.incoming.x, -r, 1e-15);
  EXPECT_NEAR(s.incoming.z, r, 1e-15);
  EXPECT_EQ(s.weight, 1.0);
  EXPECT_TRUE(mirror.is_delta());
  event.incoming = s.incoming;
  EXPECT_EQ(mirror.shape(event), 0.0);
  event.outgoing = math::normalized({1.0, 0.2, 1e-6});
  event.normal = kTilted;
  EXPECT_NEAR(math::length(mirror.sample(event, 0.0, 0.0).incoming), 1.0, 1e-14);
}

}  // namespace
}  // namespace ifov::materials::test_bsdf
