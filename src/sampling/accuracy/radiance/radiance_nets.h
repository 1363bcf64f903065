#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ifov::sampling {

class BorderModel;
class ControlVariates;
class LabelTable;
class RayLedger;
class StrayValues;
struct SourcePixel;
struct StratumMoments;
struct StratumNets;

/// Replicated nets of paths, in strata whose paths make the variance.
class RadianceNets {
 public:
  RadianceNets(std::vector<SourcePixel>& pixels, const BorderModel& model, const StrayValues& strays,
               const LabelTable& table, RayLedger& ledger, const ControlVariates& controls,
               std::uint64_t seed);

  /// Few replicates know their variance badly: with 8, one interval in a hundred errs by four standard errors.
  static constexpr int kReplicates = 24;

  /// Replaces a stratum's values by nets of `count` values per replicate, or makes its nets that large.
  void plan(std::size_t pixel, std::size_t stratum, std::uint32_t count);
  /// Traces what was planned.
  void trace();

  /// Mean over the replicates and its variance; `out` is zero, of as many columns.
  static void moments(const StratumNets& nets, std::span<const int> columns, StratumMoments& out);

 private:
  struct Planned {
    std::size_t pixel, stratum;
  };
  template <class Request>
  void request_net(std::size_t pixel, std::size_t stratum, const Request& request);

  std::vector<SourcePixel>& pixels_;
  const BorderModel& model_;
  const StrayValues& strays_;
  const LabelTable& table_;
  RayLedger& ledger_;
  const ControlVariates& controls_;
  std::uint64_t seed_;
  std::size_t stride_;
  std::vector<Planned> planned_;
};

}  // namespace ifov::sampling
