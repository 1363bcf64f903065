#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "radiometry/channel.h"
#include "radiometry/spectral_nodes.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "render/tolerance/channel_brightness.h"
#include "render/tolerance/node_budget.h"
#include "sampling/intervals/bounded_error.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"

namespace ifov::render::test_node_budget {
namespace {

const sampling::BoundedError kJoint(0.95);

/// Two channels, judged to `error`, whose nodes are wrong by 1 %.
class NodeBudget : public testing::Test {
 protected:
  AccuracyTolerance tolerance(double error, double cut_share = 0.0) const {
    AccuracyRequest request;
    request.error = error;
    request.floor = 0.0;
    request.channels = {0};
    AccuracyTolerance limits(request, brightness_, {100.0, 100.0}, 1);
    limits.leave_room(nodes_, cut_share);
    return limits;
  }
  sampling::TileResult tile(float mean, float half_width) const {
    sampling::TileResult result;
    result.reset({0, 0, 1, 1}, 2);
    result.mean = {mean, mean};
    result.half_width = {half_width, half_width};
    result.reasons = {0};
    return result;
  }
  static radiometry::SpectralNodes some_nodes() {
    const std::array channels{radiometry::Channel::top_hat("a", 0.5, 0.6),
                              radiometry::Channel::top_hat("b", 0.6, 0.7)};
    return radiometry::SpectralNodes::build(channels, radiometry::Spectrum::constant(1000.0), {});
  }
  ChannelBrightness brightness_{some_nodes()};
  std::vector<NodeHalfWidth> nodes_{{0.01, 2.0}, {0.01, 2.0}};
};

TEST_F(NodeBudget, IsAShareOfTheRadianceOrOfADarkOne) {
  EXPECT_DOUBLE_EQ(nodes_[0].of(60.0), 0.6);
  EXPECT_DOUBLE_EQ(nodes_[0].of(0.5), 0.02);
  EXPECT_DOUBLE_EQ(nodes_[0].counted(60.0, 3.0), 0.6);
  EXPECT_DOUBLE_EQ(nodes_[0].counted(60.0, 6.0), 0.0);  // a tenth of what is asked
}

TEST_F(NodeBudget, LeavesTheRestToTheSampler) {
  std::vector<double> mean{60.0, 60.0}, limit(2);
  tolerance(0.02).limits(mean, limit);
  EXPECT_NEAR(kJoint.half_width(limit[0], 0.6), 1.2, 1e-12);
  EXPECT_TRUE(std::isinf(limit[1]));
  tolerance(0.2).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 12.0);
  tolerance(0.2, 0.1).limits(mean, limit);
  EXPECT_NEAR(kJoint.half_width(limit[0], 0.1 * 12.0), 12.0, 1e-12);
  EXPECT_TRUE(std::isinf(limit[1]));
}

// Materials that are less certain than is asked for take no rays from the others.
TEST_F(NodeBudget, MakesNoRoomForWhatIsGivenUp) {
  std::vector<double> mean{60.0, 60.0}, limit(2);
  nodes_ = {{0.0, 0.0, 5.0, {1.0, 5.0}}, {0.0, 0.0, 5.0, {1.0, 5.0}}};
  tolerance(0.05).limits(mean, limit);
  EXPECT_DOUBLE_EQ(limit[0], 1.5);  // of 3, all of which is the second material's: rays keep half
  for (NodeHalfWidth& node : nodes_) node.given_up = 4.0;
  tolerance(0.05).limits(mean, limit);
  EXPECT_NEAR(kJoint.half_width(limit[0], 1.0), 3.0, 1e-12);
  sampling::TileResult result = tile(60.0f, 0.5f);
  result.abundances = {{0, 1, 1.0f, 0.0f}};
  widen(nodes_, nullptr, result);
  EXPECT_NEAR(result.bound[0], 5.0, 1e-6);  // the interval holds it as before
}

// Temperatures that are solved: 1 of a pixel of the first material, 5 of the second, whose are least certain.
TEST_F(NodeBudget, CountsTheMaterialsThatAPixelHolds) {
  nodes_ = {{0.0, 0.0, 5.0, {1.0, 5.0}}, {0.0, 0.0, 5.0, {1.0, 5.0}}};
  const auto widened_by = [&](std::vector<sampling::Abundance> held) {
    sampling::TileResult result = tile(60.0f, 0.5f);
    result.abundances = std::move(held);
    widen(nodes_, nullptr, result);
    return result.bound[0];
  };
  EXPECT_NEAR(widened_by({{0, 0, 1.0f, 0.0f}}), 1.0, 1e-6);
  EXPECT_NEAR(widened_by({{0, 1, 1.0f, 0.0f}}), 5.0, 1e-6);
  EXPECT_NEAR(widened_by({{0, 0, 0.75f, 0.0f}, {0, 1, 0.25f, 0.0f}}), 2.0, 1e-6);
  // As much of the worse one as there may be, which the other has less of.
  EXPECT_NEAR(widened_by({{0, 0, 0.75f, 0.1f}, {0, 1, 0.25f, 0.1f}}), 0.65 + 0.35 * 5.0, 1e-6);
  // Where not all is told, what is uncertain of the one need not be the other's.
  EXPECT_NEAR(widened_by({{0, 0, 0.6f, 0.1f}, {0, 1, 0.2f, 0.1f}}), 1.6 + 0.6 + 0.2 * 5.0, 1e-6);
  // What is not told of, and what no pixel's materials are told of, is the worst.
  EXPECT_NEAR(widened_by({{0, 0, 0.5f, 0.0f}}), 0.5 + 2.5, 1e-6);
  EXPECT_NEAR(widened_by({}), 5.0, 1e-6);
  EXPECT_NEAR(widened_by({{0, 7, 1.0f, 0.0f}}), 5.0, 1e-6);
  nodes_[0].emitted_of.clear();
  EXPECT_NEAR(widened_by({{0, 0, 1.0f, 0.0f}}), 5.0, 1e-6);
}

// Shares that are off by as much as they may be, in all ways in which they still make one.
TEST_F(NodeBudget, HoldsWhateverSharesAPixelHas) {
  const NodeHalfWidth node{0.0, 0.0, 5.0, {1.0, 2.5, 4.0}};
  const std::vector<sampling::Abundance> held{{0, 0, 0.4f, 0.2f}, {0, 1, 0.35f, 0.1f}, {0, 2, 0.25f, 0.15f}};
  double most = 0.0;
  constexpr int kSteps = 40;
  for (int i = -kSteps; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double first = 0.2 * i / kSteps, second = 0.1 * j / kSteps, third = -first - second;
      if (std::abs(third) > 0.15) continue;
      most = std::max(most, (0.4 + first) * 1.0 + (0.35 + second) * 2.5 + (0.25 + third) * 4.0);
    }
  const double told = emitted_by(node, held.data(), held.size());
  EXPECT_GE(told, most);
  EXPECT_LE(told, most + 0.2);  // each of them by all that it may be off: 0.45 + 0.25 + 0.6 more
}

// Rays make room for what a pixel's own materials are uncertain by.
TEST_F(NodeBudget, LeavesMoreToTheSamplerWhereMaterialsAreCertain) {
  std::vector<double> mean{60.0, 60.0}, limit(2);
  nodes_ = {{0.0, 0.0, 2.5, {1.0, 2.5}}, {0.0, 0.0, 2.5, {1.0, 2.5}}};
  const AccuracyTolerance limits = tolerance(0.05);  // 3
  const auto random_of = [&](std::vector<sampling::Abundance> held) {
    limits.limits_holding(held.data(), held.size(), mean, limit);
    return limit[0];
  };
  EXPECT_TRUE(limits.by_material());
  EXPECT_NEAR(kJoint.half_width(random_of({{0, 0, 1.0f, 0.0f}}), 1.0), 3.0, 1e-12);
  EXPECT_NEAR(kJoint.half_width(random_of({{0, 0, 0.75f, 0.0f}, {0, 1, 0.25f, 0.0f}}), 1.375), 3.0, 1e-12);
  const double of_worst = random_of({{0, 1, 1.0f, 0.0f}});
  limits.limits(mean, limit);
  EXPECT_DOUBLE_EQ(of_worst, limit[0]);
  EXPECT_DOUBLE_EQ(random_of({}), limit[0]);  // it is not known which
  for (NodeHalfWidth& node : nodes_) node.emitted_of.clear();
  EXPECT_FALSE(tolerance(0.05).by_material());
}

TEST_F(NodeBudget, PixelsOfATileHaveMaterialsOfTheirOwn) {
  nodes_ = {{0.0, 0.0, 5.0, {1.0, 5.0}}};
  sampling::TileResult result;
  result.reset({0, 0, 3, 1}, 1);
  result.mean = {60.0f, 60.0f, 60.0f};
  result.half_width = {0.0f, 0.0f, 0.0f};
  result.reasons = {0, 0, 0};
  result.abundances = {{0, 0, 1.0f, 0.0f}, {2, 0, 0.5f, 0.0f}, {2, 1, 0.5f, 0.0f}};
  widen(nodes_, nullptr, result);
  EXPECT_NEAR(result.bound[0], 1.0, 1e-6);
  EXPECT_NEAR(result.bound[1], 5.0, 1e-6);
  EXPECT_NEAR(result.bound[2], 3.0, 1e-6);
  add_thermal_layer(nodes_, result);
  ASSERT_NE(result.layer(kThermalLayer), nullptr);
  const std::span<const float> told = result.layer(kThermalLayer)->values<float>();
  EXPECT_EQ(std::vector<float>(told.begin(), told.end()), (std::vector{1.0f, 5.0f, 3.0f}));
}

TEST_F(NodeBudget, WidensIntervalsAndSaysWhereNodesAreTooFew) {
  const AccuracyTolerance enough = tolerance(0.02), fine = tolerance(0.005), coarse = tolerance(0.2);
  sampling::TileResult result = tile(60.0f, 0.5f);
  widen(nodes_, &enough, result);
  const double whole = kJoint.half_width(0.5, 0.6);
  EXPECT_NEAR(result.joined(0, kJoint), whole, 1e-6);
  EXPECT_NEAR(result.joined(1, kJoint), whole, 1e-6);  // not judged, and known all the same
  EXPECT_TRUE(result.converged(0));
  EXPECT_NEAR(result.worst_ratio[0], whole / 1.2, 1e-6);
  result = tile(60.0f, 0.14f);
  widen(nodes_, &fine, result);
  EXPECT_EQ(result.reasons[0], sampling::bit(sampling::Reason::nodes));
  result = tile(60.0f, 0.14f);
  widen(nodes_, &coarse, result);
  EXPECT_EQ(result.bound[0], 0.0f);
  widen(nodes_, nullptr, result);
  EXPECT_FLOAT_EQ(result.bound[0], 0.6f);
}

// More products of spectra than 64 nodes keep: the error is known and stated. Surfaces are combs that no few lines follow.
TEST_F(NodeBudget, KnowsWhatTheSearchCouldNotKeep) {
  std::vector<radiometry::Spectrum> surfaces;
  for (int s = 0; s < 12; ++s) {
    std::vector<double> x, y;
    for (int k = 0; k <= 400; ++k) {
      x.push_back(0.4 + 0.0015 * k);
      y.push_back(((k * (2 * s + 3)) / 7 + s * k * k / 11) % 5 == 0 ? 0.9 : 0.02);
    }
    surfaces.emplace_back(x, y);
  }
  const std::array channels{radiometry::Channel::top_hat("pan", 0.4, 1.0)};
  const auto nodes =
      radiometry::SpectralNodes::build(channels, radiometry::Spectrum::constant(1000.0), surfaces,
                                       {.reflections = 3, .hottest_k = 0.0, .most_nodes = 8});
  EXPECT_GT(nodes.worst_error(), 0.01);
  const scene::Scene scene = [&] {
    scene::Scene made;
    for (const auto& surface : surfaces) made.materials.push_back({"m", surface});
    made.sun = scene::Sun{{0.0, 0.0, 1.0}, 0.0, radiometry::Spectrum::constant(1000.0)};
    return made;
  }();
  const transport::SpectralScene spectral(scene, nodes);
  const std::vector<NodeHalfWidth> found = node_half_widths(spectral);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].relative, nodes.worst_error());
  EXPECT_NEAR(found[0].dark, 0.01 * 1000.0 / 3.14159265, 1e-3);
}

}  // namespace
}  // namespace ifov::render::test_node_budget
