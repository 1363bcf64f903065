#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "geometry/world/world_builder.h"
#include "render/pilot_rays.h"
#include "render/small_pieces.h"
#include "sampling/random.h"
#include "sensor/orthographic_camera.h"
#include "transport/mirrors/sun_disc.h"

namespace ifov::test_pilot_rays {
namespace {

constexpr int kSide = 32;

/// Pixels of 1 m, straight down; scene point (x, y) is image point (kSide / 2 + x, kSide / 2 - y).
sensor::OrthographicCamera camera() {
  sensor::OrthographicCamera::Settings settings;
  settings.width_px = settings.height_px = kSide;
  settings.start_height_m = 100.0;
  return sensor::OrthographicCamera(settings);
}

void place(geometry::WorldBuilder& builder, geometry::Shape shape, math::Point3 at) {
  const geometry::ShapeId id = builder.add_shape(std::move(shape));
  builder.place(id, math::Transform::translation(at - math::Point3{}),
                std::vector<std::uint32_t>(builder.slot_count(id), 0));
}

TEST(PilotRays, TilesGetThoseOfTheirOwnAndOfTheirMargin) {
  geometry::WorldBuilder builder;
  std::vector<sampling::FocalPoint> images;
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double x = kSide * sampling::unit_double(sampling::hash(k, 1));
    const double y = kSide * sampling::unit_double(sampling::hash(k, 2));
    place(builder, geometry::Sphere{{}, 0.1}, {x - 0.5 * kSide, 0.5 * kSide - y, 1.0});
    images.push_back({x, y});
  }
  const auto world = builder.build(1);
  const render::PilotRays pilot_rays(*world, 1, camera(), {}, {}, 1.5);
  for (const sampling::PixelRect tile :
       {sampling::PixelRect{0, 0, 8, 8}, {8, 16, 24, 20}, {30, 30, 32, 32}}) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < images.size(); ++k)
      if (images[k].x_px >= tile.x0 - 1.5 && images[k].x_px < tile.x1 + 1.5 &&
          images[k].y_px >= tile.y0 - 1.5 && images[k].y_px < tile.y1 + 1.5)
        expected.push_back(k);
    const render::PilotRays::Near near = pilot_rays.near(tile, 1.5);
    std::vector<std::uint32_t> found = near.objects;
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    for (std::size_t k = 0; k < near.objects.size(); ++k)
      EXPECT_NEAR(near.points[k].x_px, images[near.objects[k]].x_px, 1e-9);
  }
}

/// Points in a band across the image, 20 m long, that was cut into strips of 0.1 m and these into two triangles each.
std::size_t pilot_rays_in_band(int strips) {
  geometry::TriangleMesh mesh;
  for (int k = 0; k <= strips; ++k) {
    mesh.vertices_m.push_back({-10.0, 0.1 * k, 0.0});
    mesh.vertices_m.push_back({10.0, 0.1 * k, 0.0});
  }
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(strips); ++k) {
    mesh.triangles.push_back({2 * k, 2 * k + 1, 2 * k + 3});
    mesh.triangles.push_back({2 * k, 2 * k + 3, 2 * k + 2});
  }
  geometry::WorldBuilder builder;
  place(builder, std::move(mesh), {0.3, 0.1, 1.0});
  const auto world = builder.build(1);
  const render::PilotRays::Near near =
      render::PilotRays(*world, 1, camera(), {}, {}, 1.5).near({0, 0, kSide, kSide}, 1.5);
  return static_cast<std::size_t>(
      std::count(near.objects.begin(), near.objects.end(), sampling::Field::kNoObject));
}

// A strip is sought all along, three times in a pixel; what only was cut into strips meets the lattice anyway.
TEST(PilotRays, StripsAreSoughtAndWhatWasCutIntoThemIsNot) {
  EXPECT_GE(pilot_rays_in_band(1), 2u * 57u);
  EXPECT_EQ(pilot_rays_in_band(8), 0u);
}

/// Of `shape` 2 m above level ground at (-3, 0.3) with the Sun 45 deg up in the west: how many rays are sent to within 0.05 m of
/// y = 0.3 and x from -1.6 to -0.4, where its shadow lies.
std::size_t pilot_rays_in_shadow(geometry::Shape shape, bool sunlit) {
  geometry::WorldBuilder builder;
  place(builder, geometry::Plane{}, {});
  place(builder, std::move(shape), {-3.0, 0.3, 2.0});
  const auto world = builder.build(1);
  const double s = std::sqrt(0.5);
  const std::vector<math::Vec3> towards_sun = {{-s, 0.0, s}};
  const render::PilotRays::Near near =
      render::PilotRays(*world, 1, camera(), std::span(towards_sun).first(sunlit ? 1 : 0), {}, 1.5)
          .near({0, 0, kSide, kSide}, 1.5);
  return static_cast<std::size_t>(std::count_if(near.points.begin(), near.points.end(), [](const auto& p) {
    const double x = p.x_px - 0.5 * kSide, y = 0.5 * kSide - p.y_px;
    return std::abs(y - 0.3) < 0.05 && x > -1.6 && x < -0.4;
  }));
}

// A wire of 1 cm along x, a rod that stands up (a dot to the camera), a strip of a mesh and a ball of 5 cm.
TEST(PilotRays, ShadowsOfSmallThingsAreSought) {
  const auto rod = [](double x, double z) { return geometry::Box{{-x, -0.005, -z}, {x, 0.005, z}}; };
  geometry::TriangleMesh strip;
  strip.vertices_m = {{-0.5, -0.05, 0.0}, {0.5, -0.05, 0.0}, {0.5, 0.05, 0.0}, {-0.5, 0.05, 0.0}};
  strip.vertices_m[0].x = strip.vertices_m[3].x = -0.6;
  strip.vertices_m[1].x = strip.vertices_m[2].x = 0.6;
  strip.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const geometry::Shape& shape :
       {geometry::Shape(rod(0.6, 0.005)), geometry::Shape(rod(0.005, 0.6)), geometry::Shape(strip)}) {
    EXPECT_GE(pilot_rays_in_shadow(shape, true), 3u);
    EXPECT_EQ(pilot_rays_in_shadow(shape, false), 0u);
  }
  EXPECT_EQ(pilot_rays_in_shadow(geometry::Sphere{{}, 0.05}, true), 1u);
}

// A rod of 5 cm at 400 m hides a sixtieth of the Sun at most, at places all over its blurred shadow; what is near the ground, or
// thick, has no such places.
TEST(PilotRays, PlacesInThinShadowsAreTold) {
  constexpr double kHalfAngle = 0.00465;
  const auto places = [&](double half_m, double height_m) {
    geometry::WorldBuilder builder;
    place(builder, geometry::Box{{-4.0, -half_m, -half_m}, {4.0, half_m, half_m}}, {0.0, 0.0, height_m});
    place(builder, geometry::Plane{}, {});
    const auto world = builder.build(1);
    const std::vector<math::Vec3> rim = transport::fixed_disc_points({0.0, 0.0, 1.0}, kHalfAngle);
    return render::PilotRays(*world, 1, camera(), rim, {}, 1.5).near({0, 0, kSide, kSide}, 1.5).thin_shadows;
  };
  const std::vector<sampling::ThinShadow> found = places(0.025, 400.0);
  ASSERT_GT(found.size(), 100u);
  double least = INFINITY, most = -INFINITY;
  for (const sampling::ThinShadow& shadow : found) {
    // It may look as wide as its two sides together.
    const double share = 0.05 / (0.5 * std::numbers::pi * kHalfAngle * 400.0);
    EXPECT_GE(static_cast<double>(shadow.share), 0.98 * share);
    EXPECT_LE(static_cast<double>(shadow.share), 2.05 * share);
    least = std::min(least, 0.5 * kSide - shadow.point.y_px);
    most = std::max(most, 0.5 * kSide - shadow.point.y_px);
  }
  EXPECT_NEAR(least, -kHalfAngle * 400.0, 0.1);
  EXPECT_NEAR(most, kHalfAngle * 400.0, 0.1);
  EXPECT_TRUE(places(0.025, 1.0).empty());
  EXPECT_TRUE(places(0.5, 400.0).empty());
}

// A thin rod over the image meets some pixels in their corners alone: each that it passes through for more than a hundredth of a pixel
// gets a ray.
TEST(PilotRays, EveryPixelOfAThinRodIsSought) {
  for (const double slope : {0.03, 0.25, 0.6, 1.0, 2.3}) {
    geometry::WorldBuilder builder;
    const double length = 13.0, angle = std::atan(slope);
    const geometry::ShapeId rod =
        builder.add_shape(geometry::Box{{-0.5 * length, -0.001, -0.001}, {0.5 * length, 0.001, 0.001}});
    builder.place(
        rod,
        math::Transform::translation({0.13, 0.07, 1.0}) * math::Transform::rotation({0.0, 0.0, 1.0}, angle),
        std::vector<std::uint32_t>(builder.slot_count(rod), 0));
    const auto world = builder.build(1);
    const render::PilotRays::Near near =
        render::PilotRays(*world, 1, camera(), {}, {}, 1.5).near({0, 0, kSide, kSide}, 1.5);
    const auto pixel = [](double x, double y) {
      return kSide * static_cast<int>(std::floor(0.5 * kSide - y)) +
             static_cast<int>(std::floor(0.5 * kSide + x));
    };
    std::vector<int> sought, passed;
    for (const sampling::FocalPoint& p : near.points)
      sought.push_back(kSide * static_cast<int>(std::floor(p.y_px)) + static_cast<int>(std::floor(p.x_px)));
    constexpr double kStep = 0.01;
    for (double t = kStep; t < length - kStep; t += kStep) {
      const auto at = [&](double s) {
        return pixel((s - 0.5 * length) * std::cos(angle) + 0.13,
                     (s - 0.5 * length) * std::sin(angle) + 0.07);
      };
      if (at(t) == at(t + kStep)) passed.push_back(at(t));
    }
    for (const int one : passed)
      EXPECT_NE(std::find(sought.begin(), sought.end(), one), sought.end()) << slope << " " << one;
  }
}

// Two copies of a crown with a small ball on it, whose other parts rays have met.
TEST(PilotRays, SmallPartsOfCopiesAreSought) {
  geometry::WorldBuilder builder;
  const geometry::ShapeId crown = builder.add_shape(geometry::Sphere{{}, 2.0}),
                          spark = builder.add_shape(geometry::Sphere{{0.5, 0.7, 2.0}, 0.01});
  const std::vector<geometry::Part> parts{{crown, {}, {0}}, {spark, {}, {1}}};
  const geometry::ShapeId tree = builder.add_prototype(parts);
  for (const double x : {-5.3, 6.2})
    builder.place(tree, math::Transform::translation({x, 1.1, 0.0}), std::vector<std::uint32_t>{0, 1});
  const auto world = builder.build(2);
  const auto found = [&](const geometry::WantedMaterials& shining) {
    const render::PilotRays::Near near =
        render::PilotRays(*world, 2, camera(), {}, shining, 1.5).near({0, 0, kSide, kSide}, 1.5);
    int count = 0;
    for (const double x : {-5.3, 6.2})
      count += std::any_of(near.points.begin(), near.points.end(), [x](const sampling::FocalPoint& p) {
        return std::hypot(p.x_px - (0.5 * kSide + x + 0.5), p.y_px - (0.5 * kSide - 1.8)) < 0.01;
      });
    return count;
  };
  EXPECT_EQ(found({}), 2);
  EXPECT_EQ(found({false, true}), 2);
}

// The same among a million triangles of copies of something else, beyond the picture: materials of few pieces are looked for.
TEST(PilotRays, SmallPartsOfRareMaterialsAreSoughtAmongMillions) {
  constexpr std::uint32_t kStrips = 1100;
  geometry::TriangleMesh meadow;
  for (std::uint32_t k = 0; k < kStrips; ++k) {
    const double x = 1e-3 * k;
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {5e-4, 0.0}, {0.0, 1.0}})
      meadow.vertices_m.push_back({x + dx, dy, 0.0});
    meadow.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  geometry::WorldBuilder builder;
  const geometry::ShapeId grass = builder.add_shape(std::move(meadow)),
                          crown = builder.add_shape(geometry::Sphere{{}, 2.0}),
                          spark = builder.add_shape(geometry::Sphere{{0.5, 0.7, 2.0}, 0.01});
  const std::vector<geometry::Part> of_tuft{{grass, {}, {0}}}, of_tree{{crown, {}, {0}}, {spark, {}, {1}}};
  const geometry::ShapeId tuft = builder.add_prototype(of_tuft), tree = builder.add_prototype(of_tree);
  builder.place(tree, math::Transform::translation({6.2, 1.1, 0.0}), std::vector<std::uint32_t>{0, 1});
  for (int k = 0; k < 1000; ++k)
    builder.place(tuft, math::Transform::translation({100.0 + 2.0 * k, 0.0, 0.0}),
                  std::vector<std::uint32_t>{0});
  const auto world = builder.build(2);
  ASSERT_GT(world->triangle_count(), std::size_t{1} << 20);
  EXPECT_EQ(render::rare_materials(*world, 2), (geometry::WantedMaterials{false, true}));
  const render::PilotRays::Near near =
      render::PilotRays(*world, 2, camera(), {}, {}, 1.5).near({0, 0, kSide, kSide}, 1.5);
  EXPECT_TRUE(std::any_of(near.points.begin(), near.points.end(), [](const sampling::FocalPoint& p) {
    return std::hypot(p.x_px - (0.5 * kSide + 6.7), p.y_px - (0.5 * kSide - 1.8)) < 0.01;
  }));
}

// One face of 5 cm in a level sheet of triangles, of the sheet's smooth patch: sought where it outshines the scene.
TEST(PilotRays, SmallShiningPiecesOfMeshesAreSought) {
  geometry::TriangleMesh sheet;
  sheet.vertices_m = {{-9.0, -9.0, 0.0}, {9.0, -9.0, 0.0}, {0.0, 9.0, 0.0},
                      {2.0, 1.0, 0.0},   {2.05, 1.0, 0.0}, {2.0, 1.05, 0.0}};
  sheet.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}, {3, 4, 5}};
  sheet.slots = {0, 0, 0, 0, 0, 0, 1};
  sheet.slot_names = {"ground", "hot"};
  geometry::WorldBuilder builder;
  builder.place(builder.add_shape(sheet), {}, std::vector<std::uint32_t>{0, 1});
  const auto world = builder.build(2);
  const auto found = [&](const geometry::WantedMaterials& shining) {
    const render::PilotRays::Near near =
        render::PilotRays(*world, 2, camera(), {}, shining, 1.5).near({0, 0, kSide, kSide}, 1.5);
    return std::any_of(near.points.begin(), near.points.end(), [](const sampling::FocalPoint& p) {
      return std::hypot(p.x_px - (0.5 * kSide + 2.017), p.y_px - (0.5 * kSide - 1.017)) < 0.01;
    });
  };
  EXPECT_TRUE(found({false, true}));
}

// A level sheet of 0.3 m faces, of one smooth patch, in which two are of another paint. They outshine nothing.
TEST(PilotRays, FacesPaintedOtherwiseAreSought) {
  constexpr std::uint32_t kFaces = 60;
  geometry::TriangleMesh sheet;
  for (std::uint32_t j = 0; j <= kFaces; ++j)
    for (std::uint32_t i = 0; i <= kFaces; ++i)
      sheet.vertices_m.push_back({0.3 * i - 9.0, 0.3 * j - 9.0, 0.0});
  for (std::uint32_t j = 0; j < kFaces; ++j)
    for (std::uint32_t i = 0; i < kFaces; ++i) {
      const std::uint32_t a = j * (kFaces + 1) + i, b = a + kFaces + 1;
      sheet.triangles.push_back({a, a + 1, b + 1});
      sheet.triangles.push_back({a, b + 1, b});
    }
  const std::size_t odd[] = {2 * (20 * kFaces + 11), 2 * (41 * kFaces + 35) + 1};
  sheet.slot_names = {"most", "few"};
  const auto near = [&](bool painted) {
    sheet.slots.assign(sheet.triangles.size(), 0);
    if (painted)
      for (const std::size_t k : odd) sheet.slots[k] = 1;
    geometry::WorldBuilder builder;
    builder.place(builder.add_shape(sheet), {}, std::vector<std::uint32_t>{0, 1});
    const auto world = builder.build(2);
    return render::PilotRays(*world, 2, camera(), {}, {}, 1.5).near({0, 0, kSide, kSide}, 1.5).points;
  };
  const std::vector<sampling::FocalPoint> none = near(false), points = near(true);
  for (const std::size_t k : odd) {
    math::Point3 middle{};
    for (const std::uint32_t v : sheet.triangles[k])
      middle = middle + (1.0 / 3.0) * (sheet.vertices_m[v] - math::Point3{});
    const double x = 0.5 * kSide + middle.x, y = 0.5 * kSide - middle.y;
    const auto in_it = [&](const sampling::FocalPoint& p) {
      return std::hypot(p.x_px - x, p.y_px - y) < 0.01;
    };
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), in_it));
    EXPECT_FALSE(std::any_of(none.begin(), none.end(), in_it));
  }
  // The paint about them within a half and one and a half places, and no more of the sheet.
  EXPECT_LE(points.size(), none.size() + 2 * (1 + 25));
}

}  // namespace
}  // namespace ifov::test_pilot_rays
