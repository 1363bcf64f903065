#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "io/document/document_values.h"

namespace ifov::io {

/// Numbers of detector columns by channel: a line for each column of the image, a field for each channel in the order of the document.
struct ColumnTable {
  DocumentFile file;
};

/// Differences from what a channel is told to have, by powers of the place across the track, which is -1 at the first column's
/// outer side and 1 at the last one's. Empty: none.
struct SmilePolynomial {
  std::vector<double> centre_um, fwhm_um;
};
struct SmileTable {
  ColumnTable centres;
  std::optional<ColumnTable> widths;
  double um_per_unit = 1.0;
};
/// Of responses that differ from column to column. One of these: alike in all channels; of the shortest wavelength and the
/// longest, and in between by wavelength; a table.
struct SmileDocument {
  struct Ends {
    SmilePolynomial shortest, longest;
  };
  std::optional<SmilePolynomial> polynomial;
  std::optional<Ends> between;
  std::optional<SmileTable> table;
  SourcePosition position;
};

/// Places of channels across the track, to the right, likewise.
struct KeystonePolynomial {
  std::vector<double> shift_px;
};
struct KeystoneDocument {
  struct Ends {
    KeystonePolynomial shortest, longest;
  };
  std::optional<KeystonePolynomial> polynomial;
  std::optional<Ends> between;
  std::optional<ColumnTable> table;
  SourcePosition position;
};

/// Filters on a frame's elements: names of channels by place in a pattern that repeats, row by row.
struct MosaicDocument {
  std::vector<std::vector<DocumentName>> rows;
  SourcePosition position;
};

}  // namespace ifov::io
