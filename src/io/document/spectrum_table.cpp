#include "core/format.h"
#include "io/document/record.h"
#include "io/document/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostTableRows = 100000;

template <class Source>
struct Entry {
  Source source;
  OutsideRange outside = OutsideRange::error;
  SourcePosition position;
};

template <class Source>
Kind<SpectrumDocument> finished(Record<Entry<Source>>& record) {
  record.with_default(
      "outside", &Entry<Source>::outside,
      choice<OutsideRange>({{"error", OutsideRange::error}, {"extend", OutsideRange::extend}}), "\"error\"",
      "wavelengths beyond the table: an error, or the end values repeated");
  return converted<SpectrumDocument>(record.kind(), [](Entry<Source> entry) {
    return SpectrumDocument{std::move(entry.source), entry.outside, std::move(entry.position)};
  });
}

/// The dimension of a spectrum's values; null for fractions, which have no unit.
const Dimension* dimension_of(SpectrumOf quantity) {
  if (quantity == SpectrumOf::radiance) return &kRadiance;
  return quantity == SpectrumOf::irradiance ? &kIrradiance : nullptr;
}

std::string name_for(std::string_view form, SpectrumOf quantity) {
  if (quantity == SpectrumOf::radiance) return format("{} of radiance", form);
  return quantity == SpectrumOf::irradiance ? format("{} of irradiance", form) : std::string(form);
}

Kind<double> value_kind(SpectrumOf quantity_of) {
  const Dimension* dimension = dimension_of(quantity_of);
  if (dimension == nullptr) return number(Range::between(0.0, 1.0));
  return quantity(*dimension, Range::at_least(0.0, dimension->units[0].spelling));
}

Kind<double> unit_factor_kind(const Dimension& dimension) {
  std::vector<std::pair<std::string, double>> words;
  for (const Unit& unit : dimension.units) words.emplace_back(unit.spelling, unit.factor);
  return choice<double>(words);
}

Kind<SpectrumDocument> constant_kind(SpectrumOf quantity_of) {
  const Kind<double> value = value_kind(quantity_of);
  return {value.description, [read = value.read](const DocumentNode& node) {
            return SpectrumDocument{ConstantSpectrum{read(node)}, OutsideRange::error, node.position()};
          }};
}

Kind<SpectrumDocument> csv_kind(SpectrumOf quantity_of) {
  using Csv = Entry<CsvSpectrum>;
  Record<Csv> record(
      name_for("CSV spectrum", quantity_of),
      "Columns of numbers with the wavelength first; separators and lines of text at the top are "
      "recognised.");
  record
      .required(
          "csv", [](Csv& e, DocumentFile f) { e.source.file = std::move(f); }, file(), "the file")
      .required(
          "wavelength_unit", [](Csv& e, double um) { e.source.um_per_unit = um; }, um_per_unit_kind(),
          "unit of the wavelength column")
      .with_default(
          "column", [](Csv& e, int column) { e.source.column = column; }, integer(2, 100000), "2",
          "column of the values, counted from 1")
      .with_default(
          "scale", [](Csv& e, double scale) { e.source.scale = scale; }, number(Range::above(0.0)), "1",
          "factor on the values; 0.01 where they are percent");
  if (const Dimension* dimension = dimension_of(quantity_of)) {
    record.required(
        "unit", [](Csv& e, double factor) { e.source.scale *= factor; }, unit_factor_kind(*dimension),
        "unit of the values");
  }
  return finished(record);
}

Kind<SpectrumDocument> ecostress_kind() {
  using Ecostress = Entry<EcostressSpectrum>;
  const auto one = converted<std::vector<DocumentFile>>(
      file(), [](DocumentFile f) { return std::vector<DocumentFile>{std::move(f)}; });
  Record<Ecostress> record(
      "ECOSTRESS spectrum",
      "A spectrum file of the ECOSTRESS library, or a vswir and a tir file that are joined.");
  record.required(
      "ecostress", [](Ecostress& e, std::vector<DocumentFile> f) { e.source.files = std::move(f); },
      either(one, list(file(), 1, 2)), "the file, or two of them");
  return finished(record);
}

Kind<TableSpectrum> table_kind(SpectrumOf quantity_of) {
  Record<TableSpectrum> record(name_for("table of a spectrum", quantity_of),
                               "As many values as wavelengths, linear in between.");
  record
      .required("wavelength", &TableSpectrum::wavelength_um,
                list(quantity(kWavelength, Range::above(0.0, "um")), 1, kMostTableRows), "rising wavelengths")
      .required("values", &TableSpectrum::values, list(value_kind(quantity_of), 1, kMostTableRows),
                "one value for each wavelength")
      .check([](const TableSpectrum& table, const DocumentNode& node) {
        if (table.values.size() != table.wavelength_um.size()) {
          node.find("values")->fail(format("{} has {} values for {} wavelengths", node.title(),
                                           table.values.size(), table.wavelength_um.size()));
        }
        for (std::size_t i = 1; i < table.wavelength_um.size(); ++i) {
          if (table.wavelength_um[i] > table.wavelength_um[i - 1]) continue;
          const DocumentNode& late = node.find("wavelength")->items()[i];
          late.fail(format("{} does not rise above the wavelength before it", late.title()));
        }
      });
  return record.kind();
}

Kind<SpectrumDocument> written_table_kind(SpectrumOf quantity_of) {
  using Table = Entry<TableSpectrum>;
  Record<Table> record(name_for("table spectrum", quantity_of), "A spectrum written in the document.");
  record.required("table", &Table::source, table_kind(quantity_of), "wavelengths and values");
  return finished(record);
}

}  // namespace

Kind<double> um_per_unit_kind() { return choice<double>({{"um", 1.0}, {"nm", 1e-3}}); }

Kind<SpectrumDocument> spectrum_kind(SpectrumOf quantity_of) {
  std::vector<std::pair<std::vector<std::string>, Kind<SpectrumDocument>>> cases;
  cases.push_back({{"csv"}, csv_kind(quantity_of)});
  if (dimension_of(quantity_of) == nullptr) cases.push_back({{"ecostress"}, ecostress_kind()});
  cases.push_back({{"table"}, written_table_kind(quantity_of)});
  return either(constant_kind(quantity_of), tagged(cases));
}

}  // namespace ifov::io
