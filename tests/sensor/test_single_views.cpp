#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "sensor/single_views.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"

namespace ifov::test_single_views {
namespace {

using sampling::FocalPoint;
using sensor::AreaView;
using sensor::HemisphereView;
using sensor::RayView;

AreaView::Settings slanted() {
  AreaView::Settings s;
  s.centre_x_m = 3.0, s.centre_y_m = -4.0, s.height_m = 2.0;
  s.width_m = 6.0, s.depth_m = 10.0;
  s.zenith_rad = 0.7, s.azimuth_rad = 2.1;
  s.start_height_m = 50.0;
  return s;
}

TEST(AreaView, RaysMeetTheRectangleAndComeBack) {
  const AreaView view(slanted());
  for (const FocalPoint at : {FocalPoint{0.0, 0.0}, FocalPoint{1.0, 1.0}, FocalPoint{0.3, 0.8}}) {
    const math::Ray ray = view.ray(at);
    EXPECT_DOUBLE_EQ(ray.origin_m.z, 50.0);
    const math::Point3 met = ray.origin_m + ray.direction * ((2.0 - 50.0) / ray.direction.z);
    EXPECT_NEAR(met.x, 6.0 * at.x_px, 1e-12);         // from the west side, 3 - 6/2
    EXPECT_NEAR(met.y, 1.0 - 10.0 * at.y_px, 1e-12);  // from the north side, -4 + 10/2
    FocalPoint back;
    ASSERT_TRUE(view.project(ray.origin_m + ray.direction * 7.0, back));
    EXPECT_NEAR(back.x_px, at.x_px, 1e-12);
    EXPECT_NEAR(back.y_px, at.y_px, 1e-12);
  }
  EXPECT_NEAR(-view.middle_ray().direction.x, std::sin(0.7) * std::sin(2.1), 1e-15);
  FocalPoint above;
  EXPECT_FALSE(view.project({0.0, 0.0, 51.0}, above));
}

TEST(AreaView, RefusesWhatIsNoArea) {
  AreaView::Settings s = slanted();
  s.depth_m = 0.0;
  EXPECT_THROW(AreaView{s}, InputError);
  s = slanted(), s.zenith_rad = 0.5 * std::numbers::pi;
  EXPECT_THROW(AreaView{s}, InputError);
}

/// Equal areas of the pixel are equal projected solid angles: the mean of a function of the cosine c over the pixel is its integral times
/// 2 c; of c itself 2/3, of c^2 1/2. A map that kept solid angles would have 1/2 and 1/3.
TEST(HemisphereView, PixelIsProjectedSolidAngle) {
  const math::Vec3 normal = math::normalized({1.0, -2.0, 0.5});
  const HemisphereView view({1.0, 2.0, 3.0}, normal);
  constexpr int kSide = 400;
  double first = 0.0, second = 0.0;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const math::Ray ray = view.ray({(i + 0.5) / kSide, (j + 0.5) / kSide});
      EXPECT_NEAR(math::length(ray.direction), 1.0, 1e-12);
      const double c = math::dot(ray.direction, normal);
      ASSERT_GT(c, 0.0);
      first += c, second += c * c;
    }
  EXPECT_NEAR(first / (kSide * kSide), 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(second / (kSide * kSide), 0.5, 1e-4);
}

TEST(HemisphereView, ProjectTurnsRaysBack) {
  const math::Vec3 normal = math::normalized({0.2, 0.1, -1.0});
  const HemisphereView view({1.0, 2.0, 3.0}, normal);
  for (const FocalPoint at :
       {FocalPoint{0.5, 0.5}, FocalPoint{0.1, 0.85}, FocalPoint{0.99, 0.4}, FocalPoint{0.3, 0.02}}) {
    const math::Ray ray = view.ray(at);
    FocalPoint back;
    ASSERT_TRUE(view.project(ray.origin_m + ray.direction * 12.0, back));
    EXPECT_NEAR(back.x_px, at.x_px, 1e-9);
    EXPECT_NEAR(back.y_px, at.y_px, 1e-9);
  }
  FocalPoint behind;
  EXPECT_FALSE(view.project(math::Point3{1.0, 2.0, 3.0} - normal, behind));
  // Beyond the pixel the picture goes on along the plane.
  EXPECT_NEAR(math::dot(view.ray({1.4, 0.5}).direction, normal), 0.0, 2e-6);
}

TEST(RayView, IsOneRay) {
  const RayView view({1.0, 2.0, 3.0}, {0.0, 0.6, -0.8});
  EXPECT_EQ(view.ray({0.1, 0.9}).direction, (math::Vec3{0.0, 0.6, -0.8}));
  EXPECT_EQ(view.ray({0.1, 0.9}).origin_m, (math::Point3{1.0, 2.0, 3.0}));
  FocalPoint none;
  EXPECT_FALSE(view.project({1.0, 2.6, 2.2}, none));
}

TEST(ViewListCamera, PixelsAreViews) {
  auto list = std::make_shared<sensor::ViewList>();
  list->columns = {{"x", "m"}};
  list->values = {1.0, 2.0};
  std::vector<std::unique_ptr<const sensor::SingleView>> views;
  views.push_back(std::make_unique<RayView>(math::Point3{1.0, 0.0, 0.0}, math::Vec3{0.0, 0.0, -1.0}));
  views.push_back(std::make_unique<AreaView>(slanted()));
  const sensor::ViewListCamera camera(list, std::move(views));
  EXPECT_EQ(camera.width_px(), 2);
  EXPECT_EQ(camera.view_list(), &camera);
  EXPECT_EQ(camera.ray({0.5, 0.5}).origin_m.x, 1.0);
  EXPECT_EQ(camera.ray({1.25, 0.5}).origin_m, AreaView(slanted()).ray({0.25, 0.5}).origin_m);
  EXPECT_EQ(list->count(), 2u);
  EXPECT_EQ(camera.view(0).view_list(), nullptr);
}

}  // namespace
}  // namespace ifov::test_single_views
