// Each shape against directions thrown at it blindly: what it draws must be what is seen, with the density that it says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/world/world_builder.h"
#include "sampling/warp.h"
#include "transport/emitter_tree.h"
#include "transport/shapes/emitter_shape.h"

namespace ifov::test_emitter_shapes {
namespace {

using geometry::SurfacePiece;
using geometry::SurfacePoint;
using math::Point3;
using math::Transform;
using math::Vec3;
using transport::EmitterShape;
using transport::Receiver;

struct Placed {
  std::unique_ptr<geometry::World> world;
  std::vector<SurfacePiece> pieces;
};

Placed place(geometry::Shape shape, const Transform& transform) {
  geometry::WorldBuilder builder;
  const geometry::ShapeId id = builder.add_shape(std::move(shape));
  builder.place(id, transform, std::vector<std::uint32_t>(builder.slot_count(id), 0));
  Placed placed;
  placed.world = builder.build(1);
  placed.world->visit_surfaces({true}, [&](const SurfacePiece& piece) { placed.pieces.push_back(piece); });
  return placed;
}

bool meets(const Placed& placed, const SurfacePiece& piece, Point3 from, Vec3 direction, SurfacePoint& hit) {
  const math::Ray ray{from, direction};
  placed.world->intersect({&ray, 1}, {&hit, 1});
  return hit.hit() && hit.instance == piece.object && hit.primitive == piece.primitive &&
         hit.patch == piece.patch;
}

/// Integrals over the directions in which a piece is seen, of the cosine and of the cosine times a lopsided function, each
/// with its standard error: by blind directions, and by those that are drawn. The drawn ones count `spoil` times.
struct Compared {
  double worst_z = 0.0;        ///< of the differences
  double worst_density = 0.0;  ///< relative difference of density() and aim()
};
Compared compare(const Placed& placed, const Receiver& receiver, double spoil, std::mt19937& random) {
  std::uniform_real_distribution<> u;
  const auto lopsided = [](Vec3 w) { return 1.0 + 0.7 * w.x - 0.4 * w.y * w.z; };
  constexpr int kCount = 20000;
  Compared result;
  for (const SurfacePiece& piece : placed.pieces) {
    const EmitterShape shape(piece, false);
    SurfacePoint hit;
    double sum[2] = {}, square[2] = {}, drawn[2] = {}, drawn_square[2] = {};
    const sampling::TangentFrame frame(receiver.normal);
    for (int k = 0; k < kCount; ++k) {
      const Vec3 w = frame.to_world(sampling::cosine_hemisphere({u(random), u(random)}));
      // What cannot be drawn is left to scattered rays.
      if (meets(placed, piece, receiver.at_m, w, hit) && shape.density(receiver, w, hit.distance_m) > 0.0) {
        const double v[2] = {std::numbers::pi, std::numbers::pi * lopsided(w)};
        for (int m = 0; m < 2; ++m) sum[m] += v[m] / kCount, square[m] += v[m] * v[m] / kCount;
      }
      const transport::AimedDirection aimed = shape.aim(receiver, {u(random), u(random)});
      if (!(aimed.density > 0.0) || !meets(placed, piece, receiver.at_m, aimed.direction, hit)) continue;
      const double cosine = std::max(0.0, math::dot(aimed.direction, receiver.normal));
      const double v[2] = {spoil * cosine / aimed.density,
                           spoil * cosine / aimed.density * lopsided(aimed.direction)};
      for (int m = 0; m < 2; ++m) drawn[m] += v[m] / kCount, drawn_square[m] += v[m] * v[m] / kCount;
      const double said = shape.density(receiver, aimed.direction, hit.distance_m);
      result.worst_density = std::max(result.worst_density, std::abs(said / aimed.density - 1.0));
    }
    for (int m = 0; m < 2; ++m) {
      const double variance = (square[m] - sum[m] * sum[m] + drawn_square[m] - drawn[m] * drawn[m]) / kCount;
      result.worst_z = std::max(result.worst_z, std::abs(sum[m] - drawn[m]) / std::sqrt(variance + 1e-12));
    }
  }
  return result;
}

std::vector<Placed> all_shapes() {
  const Transform skewed = Transform::translation({0.3, 0.2, 2.0}) *
                           Transform::rotation({1.0, 0.4, -0.3}, 0.9) * Transform::scaling({0.7, 1.1, 0.5});
  const Transform even = Transform::translation({0.5, -0.2, 1.6}) * Transform::rotation({1.0, 2.0, 0.3}, 2.1);
  std::vector<Placed> shapes;
  for (const Transform& map : {skewed, even}) {
    shapes.push_back(place(geometry::Sphere{{}, 0.8}, map));
    shapes.push_back(place(geometry::Hemisphere{{}, 0.8}, map));
    shapes.push_back(place(geometry::Box{{-0.5, -0.6, -0.4}, {0.5, 0.6, 0.7}}, map));
    shapes.push_back(place(geometry::Cylinder{{0.0, 0.0, -0.5}, 0.5, 1.2, true}, map));
    shapes.push_back(place(geometry::Cylinder{{0.0, 0.0, -0.5}, 0.7, 1.2, false}, map));
    shapes.push_back(place(geometry::Disk{{}, 0.9}, map));
    shapes.push_back(place(geometry::Polygon{{{0, 0, 0}, {1, 0, 0}, {1.2, 1, 0}, {0.1, 0.8, 0}}}, map));
  }
  return shapes;
}

const Receiver kLevel{{0.1, 0.0, 0.0}, {0.0, 0.0, 1.0}};
const Receiver kTilted{{-0.9, 0.4, 1.2}, {0.8, 0.0, 0.6}};

TEST(EmitterShape, DrawsWhatIsSeenWithTheDensityThatItSays) {
  std::mt19937 random(5);
  for (const Placed& placed : all_shapes())
    for (const Receiver& receiver : {kLevel, kTilted}) {
      const Compared found = compare(placed, receiver, 1.0, random);
      EXPECT_LT(found.worst_z, 4.5);
      EXPECT_LT(found.worst_density, 1e-3);  // of tubes where they are seen edge-on
    }
}

TEST(EmitterShape, LiesWithinItsSphere) {
  std::mt19937 random(5);
  std::uniform_real_distribution<> u;
  std::normal_distribution<> n;
  const auto anywhere = [&] { return math::normalized(Vec3{n(random), n(random), n(random)}); };
  std::vector<Placed> shapes = all_shapes();
  shapes.push_back(place(geometry::Cylinder{{0.0, 0.0, -0.5}, 0.7, 0.1, false}, {}));  // a ring
  for (const Placed& placed : shapes)
    for (const SurfacePiece& piece : placed.pieces) {
      const EmitterShape shape(piece, false);
      int met = 0;
      for (int k = 0; k < 2000; ++k) {
        const Point3 from = Point3{} + 10.0 * anywhere();
        const Point3 to = shape.centre_m() + shape.radius_m() * u(random) * anywhere();
        SurfacePoint hit;
        if (!meets(placed, piece, from, math::normalized(to - from), hit)) continue;
        ++met;
        ASSERT_LE(math::length(hit.position_m - shape.centre_m()), shape.radius_m() * (1.0 + 1e-6));
      }
      EXPECT_GT(met, 50);
    }
}

TEST(EmitterShape, PlantedFaultDensityFivePercentOff) {
  std::mt19937 random(5);
  double worst = 0.0;
  for (const Placed& placed : all_shapes())
    worst = std::max(worst, compare(placed, kLevel, 1.05, random).worst_z);
  EXPECT_GT(worst, 4.5);
}

TEST(EmitterShape, BallAboveTheHorizonIsDrawnWithoutVariance) {
  const Placed placed = place(geometry::Sphere{{}, 0.15}, Transform::translation({2.0, 1.0, 6.0}));
  const EmitterShape ball(placed.pieces.at(0), false);
  const Vec3 to{1.9, 1.0, 6.0};
  const double expected = std::numbers::pi * 0.15 * 0.15 * 6.0 / std::pow(math::length(to), 3.0);
  EXPECT_NEAR(ball.reach_sr(kLevel), expected, 1e-12);
  const transport::AimedDirection aimed = ball.aim(kLevel, {0.3, 0.9});
  EXPECT_NEAR(aimed.direction.z / aimed.density, expected, 1e-9 * expected);
}

TEST(EmitterShape, FromWithinABallNothingIsDrawn) {
  const Placed placed = place(geometry::Sphere{{}, 2.0}, {});
  const EmitterShape ball(placed.pieces.at(0), false);
  EXPECT_EQ(ball.reach_sr(kLevel), 0.0);
  EXPECT_EQ(ball.aim(kLevel, {0.3, 0.9}).density, 0.0);
  EXPECT_EQ(ball.density(kLevel, {0.0, 0.0, 1.0}, 2.0), 0.0);
}

std::vector<transport::Emitter> scattered_emitters(int count, std::mt19937& random) {
  std::uniform_real_distribution<> u(-1.0, 1.0);
  std::vector<transport::Emitter> emitters;
  for (int k = 0; k < count; ++k) {
    SurfacePiece piece;
    piece.kind = k % 3 == 0 ? geometry::PieceKind::ball : geometry::PieceKind::triangle;
    piece.scene_from_unit =
        Transform::translation({20.0 * u(random), 20.0 * u(random), 5.0 + 6.0 * u(random)}) *
        Transform::rotation({u(random), u(random), 1.0}, 3.0 * u(random)) *
        Transform::scaling({0.3, 0.3, 0.3});
    emitters.push_back({EmitterShape(piece, k % 2 == 0), {{1.0 + k % 5, k % 7 == 0 ? 3.0 : 1e-9}}, 0, 0});
  }
  return emitters;
}

TEST(EmitterTree, ProbabilitiesAreThoseOfTheChoiceAndAddUpToOne) {
  std::mt19937 random(11);
  for (const auto& [count, groups] : {std::pair(1, 1), {5, 1}, {7, 2}, {300, 1}, {300, 2}}) {
    const std::vector<transport::Emitter> emitters = scattered_emitters(count, random);
    const transport::EmitterTree tree(emitters, static_cast<std::size_t>(groups));
    for (const Receiver& receiver : {kLevel, kTilted}) {
      std::vector<double> measured(emitters.size(), 0.0);
      constexpr int kDraws = 40000;
      double none = 0.0;
      for (int k = 0; k < kDraws; ++k) {
        const auto choice = tree.choose(receiver, (k + 0.5) / kDraws);
        if (choice.probability > 0.0) {
          measured[choice.emitter] += 1.0 / kDraws;
          ASSERT_NEAR(choice.probability, tree.probability(receiver, choice.emitter),
                      1e-12 * choice.probability);
        } else {
          none += 1.0 / kDraws;
        }
      }
      double sum = none;
      for (std::uint32_t e = 0; e < emitters.size(); ++e) {
        const double probability = tree.probability(receiver, e);
        EXPECT_NEAR(measured[e], probability, 4e-3 * std::sqrt(probability) + 5e-5);
        sum += probability;
      }
      EXPECT_NEAR(sum, 1.0, 2e-4);
    }
  }
}

TEST(EmitterTree, SeldomMissesWhatMatters) {
  // The mean square of reach over chance is what a receiver's variance is made of: not far from that of perfect chances.
  std::mt19937 random(12);
  const std::vector<transport::Emitter> emitters = scattered_emitters(300, random);
  const transport::EmitterTree tree(emitters);
  double sum = 0.0, square = 0.0;
  for (std::uint32_t e = 0; e < emitters.size(); ++e) {
    const double reach = emitters[e].radiance.of[0] * emitters[e].shape.reach_sr(kLevel);
    if (reach <= 0.0) continue;
    const double probability = tree.probability(kLevel, e);
    ASSERT_GT(probability, 0.0);
    sum += reach;
    square += reach * reach / probability;
  }
  EXPECT_LT(square / (sum * sum), 2.0);
}

// One in seven shines in the second group of channels, the others 3e9 times less there: a choice by all of them together sends
// few rays there.
TEST(EmitterTree, EachGroupOfChannelsHasItsShare) {
  std::mt19937 random(13);
  std::vector<transport::Emitter> emitters = scattered_emitters(300, random);
  for (std::size_t e = 0; e < emitters.size(); ++e) emitters[e].radiance.of[0] = e % 7 == 0 ? 1e-3 : 1.0;
  const auto variance = [&](std::size_t groups, std::size_t of) {
    const transport::EmitterTree tree(emitters, groups);
    double sum = 0.0, square = 0.0;
    for (std::uint32_t e = 0; e < emitters.size(); ++e) {
      const double reach = emitters[e].radiance.of[of] * emitters[e].shape.reach_sr(kLevel);
      if (reach <= 0.0) continue;
      sum += reach;
      square += reach * reach / tree.probability(kLevel, e);
    }
    return square / (sum * sum);
  };
  EXPECT_LT(variance(2, 0), 4.0);
  EXPECT_LT(variance(2, 1), 4.0);
  EXPECT_GT(variance(1, 1), 1000.0);
}

/// By points: the area of a piece, and the solid angle in which it is seen, over that of directions.
struct ByPoints {
  double area = 0.0, seen = 0.0, error = 0.0, worst_density = 0.0;
};
ByPoints by_points(const Placed& placed, const SurfacePiece& piece, Point3 from, std::mt19937& random) {
  std::uniform_real_distribution<> u;
  const EmitterShape shape(piece, false);
  constexpr int kCount = 40000;
  ByPoints result;
  double points = 0.0, hits = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const transport::SurfaceSample point = shape.point({u(random), u(random)});
    result.area += 1.0 / point.density / kCount;
    result.worst_density =
        std::max(result.worst_density, std::abs(shape.point_density(point.at_m) / point.density - 1.0));
    const Vec3 to = point.at_m - from;
    SurfacePoint hit;
    if (meets(placed, piece, from, normalized(to), hit) && std::abs(hit.distance_m - length(to)) < 1e-5)
      points += std::abs(dot(point.normal, to)) / std::pow(length(to), 3) / point.density / kCount;
    const Vec3 w =
        sampling::TangentFrame({0.0, 0.0, 1.0})
            .to_world(
                sampling::UniformCone(std::numbers::pi).sample({0.0, 0.0, 1.0}, {u(random), u(random)}));
    if (meets(placed, piece, from, w, hit)) hits += 1.0;
  }
  result.seen = points / (4.0 * std::numbers::pi * hits / kCount);
  result.error = 1.0 / std::sqrt(hits);
  return result;
}

/// Of an ellipsoid to 1 % (Thomsen 2004), of an elliptic cylinder by Ramanujan's perimeter.
double true_area_m2(const SurfacePiece& piece) {
  const double a = length(piece.scene_from_unit.column_x()), b = length(piece.scene_from_unit.column_y()),
               c = length(piece.scene_from_unit.column_z());
  constexpr double p = 1.6075;
  switch (piece.kind) {
    case geometry::PieceKind::ball:
      return 4.0 * std::numbers::pi *
             std::pow((std::pow(a * b, p) + std::pow(b * c, p) + std::pow(c * a, p)) / 3.0, 1.0 / p);
    case geometry::PieceKind::open_cylinder:
      return std::numbers::pi * (3.0 * (a + b) - std::sqrt((3.0 * a + b) * (a + 3.0 * b))) * c;
    default: return geometry::area_m2(piece);
  }
}

TEST(EmitterShape, PointsCoverWhatIsSeen) {
  std::mt19937 random(5);
  const Transform tilted = Transform::translation({0.4, -0.3, 0.2}) *
                           Transform::rotation(normalized(Vec3{1.0, 2.0, 0.5}), 0.8) *
                           Transform::scaling({1.0, 0.6, 1.4});
  const geometry::Shape shapes[] = {
      geometry::Sphere{{0.0, 0.0, 0.0}, 1.0}, geometry::Disk{{0.0, 0.0, 0.0}, 1.0},
      geometry::Cylinder{{0.0, 0.0, -0.5}, 0.7, 1.0}, geometry::Box{{-1.0, -0.5, -0.5}, {0.6, 0.5, 0.5}}};
  int seen = 0;
  for (const geometry::Shape& shape : shapes) {
    const Placed placed = place(shape, tilted);
    for (const SurfacePiece& piece : placed.pieces) {
      const ByPoints result = by_points(placed, piece, {1.3, -1.6, 1.5}, random);
      EXPECT_NEAR(result.area / true_area_m2(piece), 1.0, 0.015);
      EXPECT_LT(result.worst_density, 1e-9);
      if (result.error < 0.1) {
        EXPECT_NEAR(result.seen, 1.0, 4.0 * result.error);
        ++seen;
      }
    }
  }
  EXPECT_GE(seen, 5);
}

}  // namespace
}  // namespace ifov::test_emitter_shapes
