#include <algorithm>

#include "core/error.h"
#include "io/document/schema/made_once.h"
#include "io/document/schema/record.h"
#include "io/document/spectrum_document.h"
#include "io/document/tables/tables.h"
#include "io/library/material_library.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostTableRows = 100000;

template <class Source>
struct Entry {
  Source source;
  OutsideRange outside = OutsideRange::error;
  std::optional<std::array<double, 2>> range_um;
  SourcePosition position;
};

/// The key that all tables share, and the entry as a spectrum.
template <class Source>
SchemaType<SpectrumDocument> finished(Record<Entry<Source>>& record, SpectrumOf quantity_of) {
  record.with_default(
      "outside", &Entry<Source>::outside,
      choice<OutsideRange>({{"error", OutsideRange::error}, {"extend", OutsideRange::extend}}), "\"error\"",
      "wavelengths beyond the table: an error, or the end values repeated");
  return converted<SpectrumDocument>(
      record.type(),
      [quantity_of](Entry<Source> entry) {
        return SpectrumDocument{std::move(entry.source), quantity_of, entry.range_um, entry.outside,
                                std::move(entry.position)};
      },
      [](const SpectrumDocument& spectrum) -> std::optional<Entry<Source>> {
        const Source* source = std::get_if<Source>(&spectrum.source);
        if (source == nullptr) return std::nullopt;
        return Entry<Source>{*source, spectrum.outside, spectrum.range_um, {}};
      });
}

/// The same for what is read from a file.
template <class Source>
SchemaType<SpectrumDocument> finished_file(Record<Entry<Source>>& record, SpectrumOf quantity_of) {
  record
      .optional("range", &Entry<Source>::range_um,
                tuple<double, 2>(quantity(kWavelength, Range::above(0.0, "um"))),
                "first and last wavelength that count; what is noise beyond them is not looked at")
      .check([](const Entry<Source>& entry, const DocumentNode& node) {
        if (entry.range_um && !((*entry.range_um)[0] < (*entry.range_um)[1]))
          node.given("range").fail(format("{} does not rise", node.given("range").title()));
      });
  return finished(record, quantity_of);
}

/// The dimension of a spectrum's values; null for those that have no unit.
const Dimension* dimension_of(SpectrumOf quantity) {
  switch (quantity) {
    case SpectrumOf::radiance: return &kRadiance;
    case SpectrumOf::irradiance: return &kIrradiance;
    case SpectrumOf::reflectance:
    case SpectrumOf::emissivity:
    case SpectrumOf::transmittance:
    case SpectrumOf::fraction:
    case SpectrumOf::number: break;
  }
  return nullptr;
}

std::string name_for(std::string_view form, SpectrumOf quantity) {
  switch (quantity) {
    case SpectrumOf::radiance: return format("{} of radiance", form);
    case SpectrumOf::irradiance: return format("{} of irradiance", form);
    case SpectrumOf::reflectance:
    case SpectrumOf::emissivity:
    case SpectrumOf::transmittance:
    case SpectrumOf::fraction: break;
    case SpectrumOf::number: return format("{} of a number", form);
  }
  return std::string(form);
}

SchemaType<double> value_type(SpectrumOf quantity_of) {
  const Dimension* dimension = dimension_of(quantity_of);
  if (quantity_of == SpectrumOf::number) return number();
  if (dimension == nullptr) return number(Range::between(0.0, 1.0));
  return quantity(*dimension, Range::at_least(0.0, dimension->units[0].spelling));
}

SchemaType<double> unit_factor_type(const Dimension& dimension) {
  std::vector<std::pair<std::string, double>> words;
  for (const Unit& unit : dimension.units) words.emplace_back(unit.spelling, unit.factor);
  return choice<double>(words);
}

/// Whether a factor is that of one of the dimension's units.
bool is_unit(const Dimension* dimension, double factor) {
  return dimension != nullptr && std::any_of(dimension->units.begin(), dimension->units.end(),
                                             [&](const Unit& unit) { return unit.factor == factor; });
}

SchemaType<SpectrumDocument> constant_type(SpectrumOf quantity_of) {
  const SchemaType<double> value = value_type(quantity_of);
  return located<SpectrumDocument>(
      value,
      [quantity_of](double constant, const DocumentNode& node) {
        return SpectrumDocument{
            ConstantSpectrum{constant}, quantity_of, {}, OutsideRange::error, node.position()};
      },
      [](const SpectrumDocument& spectrum) {
        const auto* constant = std::get_if<ConstantSpectrum>(&spectrum.source);
        return constant != nullptr ? std::optional(constant->value) : std::nullopt;
      });
}

SchemaType<SpectrumDocument> csv_type(SpectrumOf quantity_of) {
  using Csv = Entry<CsvSpectrum>;
  const Dimension* dimension = dimension_of(quantity_of);
  Record<Csv> record(
      name_for("CSV spectrum", quantity_of),
      "Columns of numbers with the wavelength first; separators and lines of text at the top are "
      "recognised.");
  record.required("csv", path(&Csv::source, &CsvSpectrum::file), file(), "the file")
      .required("wavelength_unit", path(&Csv::source, &CsvSpectrum::um_per_unit), um_per_unit_type(),
                "unit of the wavelength column")
      .with_default("column", path(&Csv::source, &CsvSpectrum::column), integer(2, 100000), "2",
                    "column of the values, counted from 1")
      .with_default("scale",
                    via([](Csv& e, double scale) { e.source.scale = scale; },
                        [dimension](const Csv& e) {
                          return is_unit(dimension, e.source.scale) ? 1.0 : e.source.scale;
                        }),
                    number(Range::above(0.0)), "1", "factor on the values; 0.01 where they are percent");
  if (dimension != nullptr) {
    record.required(
        "unit",
        via([](Csv& e, double factor) { e.source.scale *= factor; },
            [dimension](const Csv& e) { return is_unit(dimension, e.source.scale) ? e.source.scale : 1.0; }),
        unit_factor_type(*dimension), "unit of the values");
  }
  return finished_file(record, quantity_of);
}

SchemaType<SpectrumDocument> ecostress_type(SpectrumOf quantity_of) {
  using Ecostress = Entry<EcostressSpectrum>;
  const auto one = converted<std::vector<DocumentFile>>(
      file(), [](DocumentFile f) { return std::vector<DocumentFile>{std::move(f)}; },
      [](const std::vector<DocumentFile>& files) {
        return files.size() == 1 ? std::optional(files.front()) : std::nullopt;
      });
  Record<Ecostress> record(
      "ECOSTRESS spectrum",
      "A spectrum file of the ECOSTRESS library, or a vswir and a tir file that are joined.");
  record.required("ecostress", path(&Ecostress::source, &EcostressSpectrum::files),
                  either(one, list(file(), 1, 2)), "the file, or two of them");
  return finished_file(record, quantity_of);
}

SchemaType<SpectrumDocument> usgs_type(SpectrumOf quantity_of) {
  using Usgs = Entry<UsgsSpectrum>;
  Record<Usgs> record("USGS spectrum",
                      "A spectrum file of the USGS spectral library, version 6 (.asc) or 7.");
  record.required("usgs", path(&Usgs::source, &UsgsSpectrum::file), file(), "the file")
      .optional("wavelengths", path(&Usgs::source, &UsgsSpectrum::wavelengths), file(),
                "the file of wavelengths that belongs to it; not for version 6");
  return finished_file(record, quantity_of);
}

SchemaType<SpectrumDocument> asd_type(SpectrumOf quantity_of) {
  using Asd = Entry<AsdSpectrum>;
  Record<Asd> record("ASD spectrum",
                     "A file of an ASD field spectrometer: reflectance, or counts with a white reference.");
  record.required("asd", path(&Asd::source, &AsdSpectrum::file), file(), "the file");
  return finished_file(record, quantity_of);
}

using Selector = std::variant<int, std::string>;

/// A number that counts from 1, or a name.
SchemaType<Selector> selector() {
  return either(converted<Selector>(
                    integer(1, 1000000), [](int n) { return Selector(n); },
                    [](const Selector& which) { return target::as<int>(which); }),
                converted<Selector>(
                    label(), [](std::string n) { return Selector(std::move(n)); },
                    [](const Selector& which) { return target::as<std::string>(which); }));
}

SchemaType<SpectrumDocument> sli_type(SpectrumOf quantity_of) {
  using Sli = Entry<SliSpectrum>;
  Record<Sli> record("ENVI library spectrum",
                     "A spectrum of an ENVI spectral library, in the quantity that is asked for.");
  record
      .required("sli", path(&Sli::source, &SliSpectrum::file), file(),
                "the data or the header; the other lies beside it")
      .required("spectrum", path(&Sli::source, &SliSpectrum::which), selector(),
                "which of its spectra: a name, or a number that counts from 1")
      .with_default("scale", path(&Sli::source, &SliSpectrum::scale), number(Range::above(0.0)), "1",
                    "factor on the values, beyond the header's own");
  return finished_file(record, quantity_of);
}

SchemaType<SpectrumDocument> ems_type(SpectrumOf quantity_of) {
  using Ems = Entry<EmsSpectrum>;
  Record<Ems> record("DIRSIG spectrum",
                     "A curve of a DIRSIG emissivity file; its weights by angle are not used.");
  record.required("ems", path(&Ems::source, &EmsSpectrum::file), file(), "the file")
      .with_default("curve", path(&Ems::source, &EmsSpectrum::curve), integer(1, 1000000), "1",
                    "which of its curves, counted from 1");
  return finished_file(record, quantity_of);
}

/// Calls find(); what it finds wrong becomes an error at the node.
template <class Find>
auto at_node(const DocumentNode& node, const Find& find) {
  try {
    return find();
  } catch (const InputError& error) {
    node.fail(error.what());
  }
}

SchemaType<SpectrumDocument> library_type(SpectrumOf quantity_of) {
  using Library = Entry<LibrarySource>;
  Record<Library> record(
      "library spectrum",
      "A curve of the embedded library; `ifov materials` lists what there is. Emissivity is 1 - "
      "reflectance - transmittance.");
  record
      .required("library", path(&Library::source, &LibrarySource::material), label(), "name of the material")
      .with_default("curve",
                    via([](Library&, const Selector&) {},
                        [](const Library& e) { return Selector(static_cast<int>(e.source.curve) + 1); }),
                    selector(), "1", "which of its curves: a number that counts from 1, or a name");
  const SchemaType<SpectrumDocument> entry = finished(record, quantity_of);
  return {entry.description,
          [entry, quantity_of](const DocumentNode& node) {
            SpectrumDocument spectrum = entry.read(node);
            LibrarySource& source = std::get<LibrarySource>(spectrum.source);
            const LibraryMaterial& material = at_node(node.given("library"), [&]() -> const LibraryMaterial& {
              return material_library().find(source.material);
            });
            if (const DocumentNode* curve = node.find("curve")) {
              source.curve = at_node(*curve, [&] {
                return curve->type() == DocumentNode::Type::number
                           ? material.curve_numbered(static_cast<int>(curve->number()))
                           : material.curve_named(curve->text());
              });
            }
            if (quantity_of == SpectrumOf::transmittance && !material.curves[source.curve].transmittance)
              node.fail(format("the library has no transmittance of '{}'", material.name));
            return spectrum;
          },
          entry.write};
}

SchemaType<TableSpectrum> table_type(SpectrumOf quantity_of) {
  Record<TableSpectrum> record(name_for("table of a spectrum", quantity_of),
                               "As many values as wavelengths, linear in between.");
  record
      .required("wavelength", &TableSpectrum::wavelength_um,
                list(quantity(kWavelength, Range::above(0.0, "um")), 1, kMostTableRows), "rising wavelengths")
      .required("values", &TableSpectrum::values, list(value_type(quantity_of), 1, kMostTableRows),
                "one value for each wavelength")
      .check([](const TableSpectrum& table, const DocumentNode& node) {
        if (table.values.size() != table.wavelength_um.size()) {
          node.given("values").fail(format("{} has {} values for {} wavelengths", node.title(),
                                           table.values.size(), table.wavelength_um.size()));
        }
        for (std::size_t i = 1; i < table.wavelength_um.size(); ++i) {
          if (table.wavelength_um[i] > table.wavelength_um[i - 1]) continue;
          const DocumentNode& late = node.given("wavelength").items()[i];
          late.fail(format("{} does not rise above the wavelength before it", late.title()));
        }
      });
  return record.type();
}

SchemaType<SpectrumDocument> written_table_type(SpectrumOf quantity_of) {
  using Table = Entry<TableSpectrum>;
  Record<Table> record(name_for("table spectrum", quantity_of), "A spectrum written in the document.");
  record.required("table", &Table::source, table_type(quantity_of), "wavelengths and values");
  return finished(record, quantity_of);
}

SchemaType<SpectrumDocument> joined_type(const SchemaType<SpectrumDocument>& part, SpectrumOf quantity_of) {
  using Joined = Entry<JoinedSpectrum>;
  Record<Joined> record(
      "joined spectrum",
      "A visible-to-shortwave and a thermal spectrum of one sample, in either order: the thermal one "
      "counts from its first wavelength on, a gap is bridged by a straight line.");
  record.required("join", path(&Joined::source, &JoinedSpectrum::parts), list(part, 2, 2), "the two");
  return finished(record, quantity_of);
}

SchemaType<SpectrumDocument> made_spectrum_type(SpectrumOf quantity_of) {
  using Case = std::pair<std::vector<std::string>, SchemaType<SpectrumDocument>>;
  const bool of_samples = quantity_of == SpectrumOf::reflectance || quantity_of == SpectrumOf::emissivity ||
                          quantity_of == SpectrumOf::transmittance;
  std::vector<Case> cases{{{"csv"}, csv_type(quantity_of)}, {{"table"}, written_table_type(quantity_of)}};
  if (of_samples) {
    cases.insert(cases.end(), {Case{{"ecostress"}, ecostress_type(quantity_of)},
                               Case{{"usgs"}, usgs_type(quantity_of)}, Case{{"asd"}, asd_type(quantity_of)},
                               Case{{"sli"}, sli_type(quantity_of)}, Case{{"ems"}, ems_type(quantity_of)}});
    const SchemaType<SpectrumDocument> joined = joined_type(tagged(cases), quantity_of);
    cases.push_back({{"join"}, joined});
    cases.push_back({{"library"}, library_type(quantity_of)});
  }
  return either(constant_type(quantity_of), tagged(cases));
}

}  // namespace

SchemaType<double> um_per_unit_type() { return choice<double>({{"um", 1.0}, {"nm", 1e-3}}); }

SchemaType<SpectrumDocument> spectrum_type(SpectrumOf quantity_of) {
  return made_once<made_spectrum_type>(quantity_of);
}

}  // namespace ifov::io
