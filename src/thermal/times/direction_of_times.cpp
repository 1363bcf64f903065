#include "thermal/times/direction_of_times.h"

#include <algorithm>
#include <array>
#include <bit>

#include "thermal/times/classes_of_times.h"
#include "thermal/times/node_of_times.h"

namespace ifov::thermal {
namespace {

constexpr std::size_t kKept = 32;  // directions, each at two levels, by thread

/// By lane, `rows` of three: r of the hidden sky and the free one, times what each has of something.
void add_products(const DirectionOfTimes::Corner& corner, std::size_t lanes, const float* hidden,
                  const float* open, float scale, float* rows) {
  const float* __restrict of_hidden = corner.node->ratio[0].data();
  const float* __restrict of_open = corner.node->ratio[1].data();
  const float* __restrict one = hidden;
  const float* __restrict other = open;
  float* __restrict to = rows;
  const float by = scale * corner.share;
  for (std::size_t t = 0; t < lanes; ++t) {
    const float low = by * of_hidden[t], high = by * of_open[t];
    to[t] += low * one[t];
    to[lanes + t] += low * other[t] + high * one[t];
    to[2 * lanes + t] += high * other[t];
  }
}

}  // namespace

DirectionOfTimes& ClassesOfTimes::direction(math::Vec3 normal, int level) const {
  static thread_local std::array<DirectionOfTimes, 2 * kKept> kept;
  std::uint64_t key = id_;
  for (const double part : {normal.x, normal.y, normal.z})
    key = (std::rotl(key, 23) ^ std::bit_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15u;
  // Levels beside each other are asked for together.
  DirectionOfTimes& found = kept[2 * ((key >> 40) % kKept) + static_cast<std::size_t>(level % 2)];
  if (found.of == id_ && found.level == level && found.normal.x == normal.x && found.normal.y == normal.y &&
      found.normal.z == normal.z)
    return found;
  found.of = 0;
  found.normal = normal;
  found.level = level;
  combine(found, normal);
  found.of = id_;
  return found;
}

void ClassesOfTimes::combine(DirectionOfTimes& direction, math::Vec3 normal) const {
  const std::size_t lanes = lanes_;
  direction.corners = {};
  direction.kernel.clear();
  direction.has_row.clear();
  direction.shaded_k.assign(lanes, 0.0f);
  direction.of_sky_k.assign(lanes, 0.0f);
  std::size_t count = 0;
  for (const SurfaceClasses::Corner& corner :
       SurfaceClasses::corners_at(SurfaceClasses::turn_of(normal), direction.level, 1.0)) {
    if (!(corner.share > 0.0)) break;
    const NodeOfTimes& node = node_at(corner.place);
    const auto share = static_cast<float>(corner.share);
    direction.corners[count++] = {&node, share};
    for (std::size_t t = 0; t < lanes; ++t) {
      direction.shaded_k[t] += share * node.shaded_k[0][t];
      direction.of_sky_k[t] += share * (node.shaded_k[1][t] - node.shaded_k[0][t]);
    }
  }
  direction.weight.assign(3 * bins() * lanes, 0.0f);
  direction.all.assign(3 * lanes, 0.0f);
  std::vector<float> along(2 * lanes);
  const std::array<float, 3> n{static_cast<float>(normal.x), static_cast<float>(normal.y),
                               static_cast<float>(normal.z)};
  const bool two_faces = of_time(0).two_faces();
  for (std::size_t b = 0; b < bins(); ++b) {
    float* const weight = direction.weight.data() + 3 * b * lanes;
    const Bin& bin = bins_[b];
    const auto above =
        static_cast<std::size_t>(std::count_if(bin.suns.begin(), bin.suns.end(), [&](const math::Vec3& sun) {
          return math::dot(normal, sun) > 0.0;
        }));
    if (above == 0 && !two_faces) continue;
    if (above == bin.suns.size() || above == 0) {
      for (std::size_t k = 0; k < count; ++k) {
        const NodeOfTimes& node = *direction.corners[k].node;
        for (std::size_t sky = 0; sky < 2; ++sky) {
          const float* __restrict moment = node.moment[sky].data() + 3 * b * lanes;
          float* __restrict to = along.data() + sky * lanes;
          const float side = above == 0 ? -1.0f : 1.0f;  // of a sheet, the face that looks to the Sun
          for (std::size_t t = 0; t < lanes; ++t)
            to[t] = std::max(
                0.0f, side * (n[0] * moment[t] + n[1] * moment[lanes + t] + n[2] * moment[2 * lanes + t]));
        }
        add_products(direction.corners[k], lanes, along.data(), along.data() + lanes, 1.0f, weight);
      }
    } else {
      for (std::uint32_t e = bin.first; e < bin.end; ++e)
        for (const bool right : {false, true}) {
          const std::size_t row = right ? spans_[e].right : spans_[e].left;
          const double cosine = of_time(0).facing(normal, sun_[row]);
          if (!(cosine > 0.0)) continue;
          const float* __restrict one = combined_row(direction, row, right);
          const auto scale = static_cast<float>(0.5 * cosine);
          for (std::size_t t = 0; t < 3 * lanes; ++t) weight[t] += scale * one[t];
        }
    }
    for (std::size_t t = 0; t < 3 * lanes; ++t) direction.all[t] += weight[t];
  }
}

const float* ClassesOfTimes::combined_row(DirectionOfTimes& direction, std::size_t row, bool right) const {
  const std::size_t number = 2 * row + (right ? 1 : 0);
  if (direction.has_row.empty()) {
    direction.has_row.assign(2 * sun_.size(), 0);
    direction.row.resize(2 * sun_.size() * 3 * lanes_);
  }
  float* const rows = direction.row.data() + 3 * number * lanes_;
  if (direction.has_row[number] != 0) return rows;
  std::fill_n(rows, 3 * lanes_, 0.0f);
  for (const DirectionOfTimes::Corner& corner : direction.corners) {
    if (corner.node == nullptr) break;
    const auto& gains = right ? corner.node->right : corner.node->left;
    add_products(corner, lanes_, row_of(gains[0], row), row_of(gains[1], row), 1.0f, rows);
  }
  direction.has_row[number] = 1;
  return rows;
}

void ClassesOfTimes::combine_bends(DirectionOfTimes& direction) const {
  const std::size_t lanes = lanes_, all = bins() * lanes;
  direction.kernel.assign(all, 0.0f);
  direction.bent.assign(all, 0.0f);
  for (const DirectionOfTimes::Corner& corner : direction.corners) {
    if (corner.node == nullptr) break;
    const NodeOfTimes& node = *corner.node;
    for (std::size_t b = 0; b < bins(); ++b)
      for (std::size_t t = 0; t < lanes; ++t) {
        const std::size_t at = b * lanes + t;
        direction.kernel[at] += 0.5f * corner.share * (node.sum[0][at] + node.sum[1][at]);
        direction.bent[at] += corner.share * node.difference[at];
      }
  }
  direction.bend.resize(all);
  for (std::size_t at = 0; at < all; ++at)
    direction.bend[at] = bend_of(direction.bent[at], direction.kernel[at]);
}

}  // namespace ifov::thermal
