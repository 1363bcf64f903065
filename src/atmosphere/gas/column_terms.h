#pragma once

#include <memory>
#include <vector>

#include "atmosphere/gas/continua.h"
#include "atmosphere/gas/gas_term_table.h"
#include "atmosphere/gas/term_overlap.h"

namespace ifov::atmosphere {

/// A table of terms laid over a column of layers: what each of its gases absorbs there, bin by bin.
class ColumnTerms {
 public:
  /// InputError where more than kMostOutside of a gas lies at states that the table does not hold (it is of another air).
  ColumnTerms(std::shared_ptr<const GasTermTable> table, const Profile& profile,
              const std::vector<double>& altitude_km);
  static constexpr double kMostOutside = 0.02;

  const GasTermTable& table() const { return *table_; }
  std::vector<Gas> gases() const;
  /// What all its gases absorb in the bin; one term of depth 0 where none does.
  AbsorptionSet at(std::size_t bin) const;
  /// The same terms with what of these depths may be too much: each gas's depth_error, or `otherwise` of a gas that says none.
  AbsorptionSet off_at(std::size_t bin, double otherwise) const;
  /// Without the continua of gases whose cross sections hold them.
  void leave_out(ContinuumDepths& depths) const;

 private:
  template <class Factor>
  AbsorptionSet sum(std::size_t bin, const Factor& factor) const;
  struct Layered {
    std::vector<LayerGas> layers;
    std::vector<StateGrid::Place> places;
  };
  std::shared_ptr<const GasTermTable> table_;
  std::vector<Layered> gases_;
};

}  // namespace ifov::atmosphere
