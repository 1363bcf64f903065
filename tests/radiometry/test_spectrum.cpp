#include <gtest/gtest.h>

#include "core/error.h"
#include "radiometry/spectrum.h"

namespace ifov::radiometry::test_spectrum {
namespace {

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Spectrum, LinearBetweenPoints) {
  const Spectrum s({0.4, 0.5, 0.7}, {1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(s.at(0.4), 1.0);
  EXPECT_DOUBLE_EQ(s.at(0.45), 2.0);
  EXPECT_DOUBLE_EQ(s.at(0.5), 3.0);
  EXPECT_DOUBLE_EQ(s.at(0.6), 2.5);
  EXPECT_DOUBLE_EQ(s.at(0.7), 2.0);
  EXPECT_DOUBLE_EQ(s.complement().at(0.45), -1.0);
  EXPECT_DOUBLE_EQ(s.scaled(0.5).at(0.6), 1.25);
  EXPECT_DOUBLE_EQ(Spectrum::constant(0.3).at(1234.0), 0.3);
}

TEST(Spectrum, OutsideItsRange) {
  const Spectrum s({0.4, 0.7}, {1.0, 2.0}, OutsideRange::error, "grass");
  EXPECT_EQ(message_of([&] { s.at(8.5); }),
            "the spectrum 'grass' is given from 0.4 to 0.7 um and is needed at 8.5 um");
  EXPECT_DOUBLE_EQ(s.with_outside(OutsideRange::extend).at(8.5), 2.0);
  EXPECT_DOUBLE_EQ(s.with_outside(OutsideRange::extend).at(0.1), 1.0);
  EXPECT_DOUBLE_EQ(s.with_outside(OutsideRange::zero).at(8.5), 0.0);
  EXPECT_DOUBLE_EQ(s.at(0.7 * (1.0 + 1e-12)), 2.0);
}

TEST(Spectrum, RefusesBadTables) {
  EXPECT_EQ(message_of([] {
              Spectrum({0.4, 0.4}, {1.0, 2.0});
            }),
            "wavelengths of a spectrum must increase: 0.4 um is followed by 0.4 um");
  EXPECT_EQ(
      message_of([] {
        Spectrum({0.4, 0.5}, {1.0}, OutsideRange::error, "x");
      }),
      "the spectrum 'x' needs as many values as wavelengths, at least one: found 2 wavelengths and 1 values");
  EXPECT_EQ(message_of([] {
              Spectrum({0.4, 0.5}, {1.0, 1.0 / 0.0});
            }),
            "a spectrum has an unusable point 2: wavelength 0.5 um, value inf");
}

TEST(Spectrum, IntegralsOfProductsAreExact) {
  // x on [1, 3] as a table, and hats with knots elsewhere: integrals by hand.
  const Spectrum x({1.0, 3.0}, {1.0, 3.0});
  EXPECT_NEAR(integral(x, 1.0, 3.0), 4.0, 1e-14);
  const Spectrum* cube[] = {&x, &x, &x};
  EXPECT_NEAR(integral_of_product(cube, 1.0, 3.0), 20.0, 1e-13);
  const Spectrum* seventh[] = {&x, &x, &x, &x, &x, &x, &x};
  EXPECT_NEAR(integral_of_product(seventh, 1.0, 3.0), 820.0, 1e-10);
  const Spectrum hat({1.5, 2.0, 2.5}, {0.0, 1.0, 0.0}, OutsideRange::zero);
  const Spectrum* both[] = {&x, &hat};
  EXPECT_NEAR(integral_of_product(both, 1.0, 3.0), 1.0, 1e-14);
  EXPECT_NEAR(weighted_mean(x, hat), 2.0, 1e-14);
}

TEST(Spectrum, AWeightNeedsAnIntegral) {
  EXPECT_EQ(message_of([] {
              weighted_mean(Spectrum::constant(1.0), Spectrum({1.0, 2.0}, {0.0, 0.0}));
            }),
            "a spectrum cannot weigh a mean: it needs a range and a positive integral");
}

TEST(Spectrum, SumsWhereBothAreGiven) {
  const Spectrum a({0.4, 0.6, 1.0}, {0.1, 0.3, 0.3}), b({0.5, 0.8, 2.0}, {0.2, 0.5, 0.1});
  const Spectrum both = sum(a, b);
  EXPECT_DOUBLE_EQ(both.first_um(), 0.5);
  EXPECT_DOUBLE_EQ(both.last_um(), 1.0);
  for (const double um : {0.5, 0.55, 0.6, 0.7, 0.8, 0.93, 1.0}) {
    EXPECT_DOUBLE_EQ(both.at(um), a.at(um) + b.at(um)) << um;
    EXPECT_DOUBLE_EQ(sum(b, a).at(um), both.at(um));
  }
  EXPECT_DOUBLE_EQ(sum(a, Spectrum::constant(0.25)).at(0.5), 0.45);
  EXPECT_DOUBLE_EQ(sum(Spectrum::constant(0.25), a).at(0.5), 0.45);
  // A reflectance to 14 um and a transmittance that is known to go on as it ends, such as 0.
  const Spectrum wide({0.4, 14.0}, {0.1, 0.1}), ends({0.4, 2.5}, {0.3, 0.05}, OutsideRange::extend);
  EXPECT_DOUBLE_EQ(sum(wide, ends).at(10.0), 0.15);
  EXPECT_DOUBLE_EQ(sum(ends, wide).at(10.0), 0.15);
  const Spectrum far({8.0, 12.0}, {0.7, 0.8});
  for (const double um : {0.55, 0.8}) EXPECT_DOUBLE_EQ(sum(a, far).at(um), a.at(um));
}

}  // namespace
}  // namespace ifov::radiometry::test_spectrum
