#pragma once

#include <cstdint>
#include <vector>

#include "sampling/accuracy/edges/probing.h"

namespace ifov::sampling {

class EdgeTracer;
class LabelTable;
struct LatticeValues;

/// Where two labels meet that look alike no border is traced, but a gap may lie between them.
class LikeNeighbours {
 public:
  LikeNeighbours(const EdgeTracer& tracer, Prober& prober, const LatticeValues& values,
                 const LabelTable& table, std::uint64_t seed)
      : tracer_(tracer), prober_(prober), values_(values), table_(table), seed_(seed) {}

  /// One side of the lattice is looked into for each two such labels that meet in a pixel of `worth`, chosen by chance;
  /// where that finds something, all sides there and around.
  void probe_between(const std::vector<std::uint8_t>& worth);
  /// What lies between any two labels that meet in the pixels named (1), one side for each two of them.
  Prober::Finds gaps_in(const std::vector<std::uint8_t>& pixels);

 private:
  /// A side of the lattice in a pixel, between two labels that look alike; in the order of `key` by chance.
  struct Meeting {
    int pixel;
    std::uint32_t low, high;
    std::uint64_t key;
    Prober::Between side;
  };
  static bool same_labels(const Meeting& a, const Meeting& b);
  std::vector<Meeting> meetings(const std::vector<std::uint8_t>& worth, bool of_all) const;

  const EdgeTracer& tracer_;
  Prober& prober_;
  const LatticeValues& values_;
  const LabelTable& table_;
  std::uint64_t seed_;
};

}  // namespace ifov::sampling
