#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/spectrometer_document.h"
#include "io/document/tables/spectrometer_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostCoefficients = 9;
constexpr const char* kPowers =
    "by powers of the place across the track, which is -1 at the first column's outer side and 1 at the last one's";

SchemaType<std::vector<double>> coefficients(const SchemaType<double>& type) {
  return list(type, 1, kMostCoefficients);
}

SchemaType<SmilePolynomial> smile_polynomial() {
  Record<SmilePolynomial> record(
      "smile polynomial", std::string("Differences from the channel's own response, ") + kPowers + ".");
  const auto difference = coefficients(quantity(kWavelengthDifference));
  record
      .optional("center", &SmilePolynomial::centre_um, difference,
                "of the centre: the coefficients, the constant one first")
      .optional("fwhm", &SmilePolynomial::fwhm_um, difference, "of the full width at half maximum, likewise")
      .check([](const SmilePolynomial& read, const DocumentNode& node) {
        if (read.centre_um.empty() && read.fwhm_um.empty())
          node.fail("a smile polynomial needs 'center', 'fwhm' or both");
      });
  return record.type();
}

SchemaType<KeystonePolynomial> keystone_polynomial() {
  Record<KeystonePolynomial> record(
      "keystone polynomial",
      std::string("Where what an element sees lies across the track, ") + kPowers + ".");
  record.required("shift", &KeystonePolynomial::shift_px,
                  coefficients(quantity(kPixels, Range::between(-8.0, 8.0, "px"))),
                  "to the right of the element: the coefficients, the constant one first");
  return record.type();
}

template <class Document, class Polynomial>
SchemaType<typename Document::Ends> ends(const char* name, const SchemaType<Polynomial>& polynomial) {
  using Ends = typename Document::Ends;
  Record<Ends> record(name, "By wavelength, straight from the shortest channel's to the longest one's.");
  record
      .required("shortest", &Ends::shortest, polynomial,
                "of the channel whose centre has the shortest wavelength")
      .required("longest", &Ends::longest, polynomial, "of that with the longest");
  return record.type();
}

}  // namespace

SchemaType<SmileDocument> smile_type(bool of_sensor) {
  Record<SmileDocument> record(
      of_sensor ? "smile" : "smile of a channel",
      "How responses differ from detector column to detector column. What a pixel measures is by the response of its column.");
  record.exactly_one().one("polynomial", &SmileDocument::polynomial, smile_polynomial(),
                           of_sensor ? "alike in all channels" : "a polynomial");
  if (!of_sensor) return record.type();
  Record<SmileTable> table(
      "smile table",
      "A line of numbers for each detector column, a number for each channel in the order of the document.");
  const auto column_table = [&] {
    return converted<ColumnTable>(
        file(), [](DocumentFile name) { return ColumnTable{std::move(name)}; },
        [](const ColumnTable& of) { return std::optional(of.file); });
  };
  table.required("centers", &SmileTable::centres, column_table(), "file of the channels' centres")
      .optional("fwhm", &SmileTable::widths, column_table(),
                "file of their full widths at half maximum; those of the channels if not given")
      .required("wavelength_unit", &SmileTable::um_per_unit, um_per_unit_type(), "unit of both");
  record
      .one("between", &SmileDocument::between, ends<SmileDocument>("smile by wavelength", smile_polynomial()),
           "by wavelength")
      .one("table", &SmileDocument::table, table.type(), "for every column and channel");
  return record.type();
}

SchemaType<KeystoneDocument> keystone_type(bool of_sensor) {
  Record<KeystoneDocument> record(
      of_sensor ? "keystone" : "keystone of a channel",
      "How far across the track what an element sees lies from the element, by channel and detector column.");
  record.exactly_one().one("polynomial", &KeystoneDocument::polynomial, keystone_polynomial(),
                           of_sensor ? "alike in all channels, as lenses distort" : "a polynomial");
  if (!of_sensor) return record.type();
  Record<ColumnTable> table(
      "keystone table",
      "A line of numbers for each detector column, a number of pixels for each channel in the order of the document.");
  table.required("file", &ColumnTable::file, file(), "the file");
  record
      .one("between", &KeystoneDocument::between,
           ends<KeystoneDocument>("keystone by wavelength", keystone_polynomial()), "by wavelength")
      .one("table", &KeystoneDocument::table, table.type(), "for every column and channel");
  return record.type();
}

SchemaType<MosaicDocument> mosaic_type() {
  using Rows = std::vector<std::vector<DocumentName>>;
  constexpr std::size_t kMostAlong = 16;
  return located<MosaicDocument>(
      list(list(name_of("a channel"), 1, kMostAlong), 1, kMostAlong),
      [](Rows rows, const DocumentNode& node) {
        for (std::size_t row = 1; row < rows.size(); ++row)
          if (rows[row].size() != rows.front().size())
            node.items()[row].fail(
                format("row {} of the mosaic has {} channels; expected {}, as the first has", row + 1,
                       rows[row].size(), rows.front().size()));
        return MosaicDocument{std::move(rows), node.position()};
      },
      [](const MosaicDocument& mosaic) { return std::optional(mosaic.rows); });
}

}  // namespace ifov::io
