#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace ifov::sampling {

class BorderModel;
class ColumnFootprints;
class Field;
class LabelSpread;
class LabelTable;
class LeafIntegrator;
class Lattice;
class MappedSurface;
class NearbySpread;
class SourcePixels;
struct FocalPoint;
struct LatticeValues;
struct SourcePixel;
struct Stratum;
struct StratumControl;

/// Control variates (Hammersley and Handscomb, Monte Carlo Methods, 1964, section 5.5): where maps tell how the values of a label
/// differ, a value is what they foretell, c = own + E reflectance + a, and a rest. Means of c over strata take no rays; rays
/// are drawn for the rest, whose variance makes the interval: a wrong c costs rays and nothing else. E and a are
/// fitted to the values of the lattice, label by label and column by column, which no estimate of a stratum contains.
class ControlVariates {
 public:
  /// 1 over the variance allowed to a source pixel, by column; valid until the next call.
  using InverseSquares = std::function<std::span<const double>(int source)>;

  ControlVariates(Field& field, const Lattice& lattice, const LabelTable& table, std::uint64_t seed);
  virtual ~ControlVariates();

  /// Whether means of so many source pixels, as the outputs that reach them weigh these, fit into memory.
  static bool affordable(const ColumnFootprints& footprints, int sources, int columns);

  /// Fits what is worth it by the errors allowed: leaves the rests of the lattice's values in `values.rest`, and how those differ in
  /// LabelSpread::rest().
  void fit(LatticeValues& values, LabelSpread& spread, const InverseSquares& allowed);
  bool any() const { return !surfaces_.empty(); }

  /// Marks the strata of pixels that have a control variate (Stratum::control), with its means over them.
  void attach(SourcePixels& pixels, const BorderModel& model, const LeafIntegrator& integrator,
              const NearbySpread& nearby, const LabelSpread& spread, const InverseSquares& allowed) const;
  /// c at points of a stratum that has one: rows of Field::stride() floats.
  void foretell(const SourcePixel& pixel, const Stratum& stratum, std::span<const FocalPoint> points,
                std::span<float> rows) const;

 protected:
  /// Where c is looked up for its mean over a stratum, of a point of that.
  virtual FocalPoint place(const FocalPoint& point) const;

 private:
  /// A control variate is worth its while where a stratum would take more values than this without it.
  static constexpr double kWorthValues = 24.0;
  /// Of a label, by column: c = own + slope * reflectance + constant, where `on`.
  struct Fit {
    std::vector<float> slope, constant;
    std::vector<std::uint8_t> on;
  };
  struct Sums;
  struct Of {
    std::unique_ptr<const MappedSurface> surface;
    std::uint32_t label = 0;
  };
  static std::uint64_t key(int source, std::uint32_t label) {
    return static_cast<std::uint64_t>(source) << 32 | label;
  }
  const MappedSurface* surface(int source, std::uint32_t label) const;
  void foretell(const MappedSurface& surface, std::uint32_t label, std::span<const FocalPoint> points,
                std::span<float> rows) const;
  int owner(std::size_t vertex) const;
  std::vector<std::uint8_t> worth(const LatticeValues& values, const LabelSpread& spread,
                                  const InverseSquares& allowed) const;
  void find_surfaces(const LatticeValues& values, std::vector<std::uint8_t>& wanted);
  void fit_labels(const LatticeValues& values, std::size_t labels);
  void take_rests(LatticeValues& values) const;
  void take_spread(const LatticeValues& values, LabelSpread& spread) const;
  bool drop_useless(const LabelSpread& spread, const std::vector<std::uint8_t>& wanted);
  bool integrate(const SourcePixel& pixel, std::size_t stratum, const BorderModel& model,
                 const LeafIntegrator& integrator, std::span<const double> inverse_squares,
                 Stratum& out) const;
  struct Grid;
  /// Calls back with each block of a grid over a stratum: points and their rows of c.
  template <class Block>
  void walk(const Grid& grid, Block block) const;
  void weigh(const Grid& grid, const LeafIntegrator& integrator, StratumControl& control) const;

  Field& field_;
  const Lattice& lattice_;
  const LabelTable& table_;
  std::uint64_t seed_;
  std::size_t columns_, stride_;
  std::vector<std::size_t> leaders_;                // Field::leader, by column
  std::vector<Fit> fits_;                           // by label
  std::unordered_map<std::uint64_t, Of> surfaces_;  // by source pixel and label
  mutable std::vector<float> own_, reflectance_;
};

}  // namespace ifov::sampling
