#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/hemisphere.h"
#include "materials/bsdf/rough_conductor.h"
#include "materials/lobe_checks.h"
#include "materials/material.h"

namespace ifov::materials::test_rough_conductor {
namespace {

using math::Vec3;
using radiometry::Spectrum;
using std::numbers::pi;
using test::at;
using test::event_of;

RoughConductor conductor(double n, double k, FacetShape shape, double width_x, double width_y,
                         double direction = 0.0) {
  return {Spectrum::constant(n),
          Spectrum::constant(k),
          Spectrum::constant(1.0),
          {shape, width_x, width_y, direction}};
}
RoughConductor white(FacetShape shape, double width_x, double width_y) {
  return conductor(0.01, 1000.0, shape, width_x, width_y);
}

struct Widths {
  double x, y;
};
constexpr Widths kWidths[] = {{0.02, 0.02}, {0.1, 0.1}, {0.4, 0.4}, {1.0, 1.0}, {0.02, 0.3}, {0.8, 0.1}};
constexpr FacetShape kShapes[] = {FacetShape::ggx, FacetShape::beckmann};
const std::vector<Vec3> kViews = {at(0.0, 0.0), at(0.7, 0.4), at(1.2, 2.0), at(1.5, -0.6)};

TEST(RoughConductor, SamplesFollowTheDensity) {
  const double least = 1e-3 / static_cast<double>(std::size(kShapes) * std::size(kWidths) * kViews.size());
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const RoughConductor bsdf = white(shape, w.x, w.y);
      for (const Vec3 out : kViews)
        EXPECT_GT(test::samples_against_density(bsdf, out, w.x, w.y, 40000), least)
            << w.x << ' ' << w.y << ' ' << out.z << ' ' << static_cast<int>(shape);
    }
}

/// A fault: the density of facets in place of that of directions.
class WithoutJacobian final : public Bsdf {
 public:
  explicit WithoutJacobian(const Bsdf& right) : right_(right) {}
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override {
    return right_.sample(view, u1, u2);
  }
  double pdf(const BsdfEvent& event) const override {
    return right_.pdf(event) * math::dot(event.outgoing, math::normalized(event.outgoing + event.incoming));
  }

 private:
  const Bsdf& right_;
};

TEST(RoughConductor, ALobeWithoutItsJacobianIsSeen) {
  const RoughConductor bsdf = white(FacetShape::ggx, 0.4, 0.4);
  EXPECT_LT(test::samples_against_density(WithoutJacobian(bsdf), at(0.7, 0.4), 0.4, 0.4, 40000), 1e-6);
}

TEST(RoughConductor, InvertsItsWarp) {
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const RoughConductor bsdf = white(shape, w.x, w.y);
      for (const Vec3 out : kViews)
        for (int i = 0; i < 20; ++i)
          for (int j = 0; j < 20; ++j) {
            BsdfEvent event = test::view_of(out);
            const BsdfSample sample = bsdf.sample(event, (i + 0.5) / 20, (j + 0.5) / 20);
            if (!(sample.weight > 0.0)) continue;
            event.incoming = sample.incoming;
            const UnitSquarePoint u = bsdf.invert(event);
            EXPECT_LT(math::length(bsdf.sample(event, u.u1, u.u2).incoming - sample.incoming), 1e-10)
                << w.x << ' ' << w.y << ' ' << out.z;
            EXPECT_NEAR(sample.pdf, bsdf.pdf(event), 1e-9 * sample.pdf);
            // Of two widths the lobe of light that is reflected again is drawn by its mean over azimuth.
            const double most = 1.0 / (1.0 - bsdf.seam(event)) + 0.02;
            EXPECT_LT(sample.weight * bsdf.grey(event), w.x == w.y ? most : 2.5) << w.x << ' ' << w.y;
          }
    }
}

TEST(RoughConductor, IsReciprocal) {
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const RoughConductor bsdf = conductor(0.2, 3.9, shape, w.x, w.y, 0.4);
      for (const double out : {0.0, 0.5, 1.3, 1.56})
        for (const double in : {0.2, 0.5, 1.4})
          for (const double azimuth : {0.0, 1.0, 2.8, pi}) {
            BsdfEvent event{at(out, 0.0), at(in, azimuth), {0, 0, 1}, {1, 0, 0}, Side::reflected};
            const double there = test::brdf_at(bsdf, event);
            std::swap(event.outgoing, event.incoming);
            EXPECT_NEAR(test::brdf_at(bsdf, event), there, 1e-9 * there);
          }
    }
}

TEST(RoughConductor, ReflectsAllThatItDoesNotAbsorb) {
  double once_least = 1.0;
  for (const FacetShape shape : kShapes)
    for (const Widths w : kWidths) {
      const RoughConductor bsdf = white(shape, w.x, w.y);
      for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05, 0.02, 0.01})
        for (const double azimuth : {0.0, 0.5, 1.2, 1.5708}) {
          const Vec3 out = at(std::acos(cosine), azimuth);
          EXPECT_NEAR(test::reflectance_towards(bsdf, out, 64), 1.0, 1e-3)
              << w.x << ' ' << w.y << ' ' << cosine << ' ' << azimuth << ' ' << static_cast<int>(shape);
          once_least = std::min(once_least, 1.0 - bsdf.seam(test::view_of(out)));
          if (w.x == w.y) break;
        }
    }
  // Without light that is reflected again a good part would be missing.
  EXPECT_LT(once_least, 0.7);
}

TEST(RoughConductor, WithoutMaskingTheFurnaceIsTooBright) {
  // D / (4 cos cos) alone, over facets of width 0.4 seen at 86 deg.
  const RoughConductor bsdf = white(FacetShape::beckmann, 0.4, 0.4);
  const FacetDistribution facets(FacetShape::beckmann, 0.4, 0.4);
  BsdfEvent event = test::view_of(at(1.5, 0.0));
  double sum = 0.0;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 400; ++j) {
      const BsdfSample sample = bsdf.sample(event, (i + 0.5) / 400, (j + 0.5) / 400);
      if (!(sample.weight > 0.0) || sample.incoming.z < 0.01) continue;
      const Vec3 h = math::normalized(event.outgoing + sample.incoming);
      sum += facets.density(h) / (4.0 * event.outgoing.z * sample.incoming.z) * sample.weight / 160000;
    }
  EXPECT_GT(sum, 1.2);
}

/// What materials emit is made of this grid: how far it is from a fine one.
TEST(RoughConductor, TheGridOfEmissivityIsFineEnough) {
  double worst = 0.0;
  for (const FacetShape shape : kShapes)
    for (const double width : {0.02, 0.1, 1.0})
      for (const auto& [n, k] : {std::pair{1.5, 0.0}, {0.2, 3.9}}) {
        const RoughConductor bsdf = conductor(n, k, shape, width, width);
        for (const double cosine : {1.0, 0.5, 0.05}) {
          const double fine = test::reflectance_towards(bsdf, at(std::acos(cosine), 0.3), 200);
          const double found = test::hemispherical_at(bsdf, cosine);
          EXPECT_NEAR(found, fine, cosine < 0.1 ? 3e-4 : 2e-4)
              << width << ' ' << n << ' ' << cosine << ' ' << static_cast<int>(shape);
          worst = std::max(worst, std::abs(found - fine));
        }
      }
  RecordProperty("worst", std::to_string(worst));
}

TEST(RoughConductor, AlmostSmoothItReflectsAsFresnelSays) {
  // n = 1.5 at 45 deg: 0.0920134 across and 0.0084665 along the plane of incidence.
  for (const FacetShape shape : kShapes) {
    const RoughConductor bsdf = conductor(1.5, 0.0, shape, 0.001, 0.001);
    EXPECT_NEAR(test::hemispherical_at(bsdf, std::sqrt(0.5)), 0.05023995, 3e-5);
    EXPECT_NEAR(test::hemispherical_at(bsdf, 1.0), 0.04, 1e-5);
  }
}

TEST(RoughConductor, TheDirectionIsThatOfTheFirstWidth) {
  // Facets whose slopes are wide along x throw light far along x.
  const auto brdf = [](double direction, double azimuth) {
    const RoughConductor bsdf = conductor(0.2, 3.9, FacetShape::ggx, 0.4, 0.05, direction);
    return test::brdf_at(bsdf, {{0, 0, 1}, at(0.6, azimuth), {0, 0, 1}, {1, 0, 0}, Side::reflected});
  };
  EXPECT_GT(brdf(0.0, 0.0), 10.0 * brdf(0.0, 0.5 * pi));
  EXPECT_NEAR(brdf(0.5 * pi, 0.5 * pi), brdf(0.0, 0.0), 1e-5 * brdf(0.0, 0.0));
  EXPECT_NEAR(brdf(0.3, 0.3), brdf(0.0, 0.0), 1e-5 * brdf(0.0, 0.0));
}

TEST(RoughConductor, MetalsOfTheTableHaveTheirColours) {
  BsdfInputs inputs{Spectrum::constant(1.0), {}};
  inputs.values = {{"index", std::string("gold")},
                   {"roughness", 0.1},
                   {"direction", 0.0},
                   {"distribution", std::string("ggx")}};
  const auto gold = RoughConductor::kModel.make(inputs);
  const Spectrum whole = directional_hemispherical(*gold, Side::reflected, 1.0);
  EXPECT_LT(whole.at(0.45), 0.45);
  EXPECT_GT(whole.at(0.65), 0.93);
  EXPECT_GT(whole.at(10.0), 0.98);
}

std::string error_of(std::vector<std::pair<std::string, BsdfInputs::Value>> values) {
  values.emplace_back("direction", 0.0);
  values.emplace_back("distribution", std::string("ggx"));
  try {
    RoughConductor::kModel.make({Spectrum::constant(1.0), values});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RoughConductor, SaysWhatIsWrong) {
  EXPECT_EQ(
      error_of({{"index", std::string("gold")}, {"roughness", 0.0}}),
      "a 'roughness' of 0 is below 0.01: what so narrow a lobe throws on other surfaces is not sought; a smooth surface is "
      "'smooth', by its refractive index, or 'mirror'");
  EXPECT_NE(error_of({{"index", std::string("gould")}, {"roughness", 0.1}})
                .find("there is no refractive index of 'gould'; "
                      "there are 'aluminium', "),
            std::string::npos);
  EXPECT_EQ(
      error_of({{"n", Spectrum::constant(1.0)}, {"roughness", 0.1}}),
      "'k' is missing: a refractive index is given by its name, 'index', or as 'n' and 'k', such as \"index\": \"water\"");
  EXPECT_EQ(
      error_of({{"roughness", 0.1}}),
      "the refractive index is missing: a refractive index is given by its name, 'index', or as 'n' and 'k', such as \"index\": \"water\"");
  EXPECT_EQ(error_of({{"index", std::string("gold")}, {"k", Spectrum::constant(1.0)}, {"roughness", 0.1}}),
            "a refractive index is given either by its name, 'index', or as 'n' and 'k', not by both");
}

}  // namespace
}  // namespace ifov::materials::test_rough_conductor
