#pragma once

namespace ifov::atmosphere {

enum class GasModel {
  /// The far-wing term of the water continuum fades out from 1250 to 1900 cm-1; pairs of oxygen molecules
  /// absorb, and so does nitrogen dioxide in the visible.
  standard,
  lowtran7,  ///< as the program of 1992 computes, for comparison
};

}  // namespace ifov::atmosphere
