#include "core/format.h"
#include "io/document/atmosphere_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {

SchemaType<ImportedDocument> imported_type() {
  constexpr std::size_t kMostFiles = 8, kMostRuns = 3;
  Record<ImportedDocument> record("imported atmosphere",
                                  "Output of another radiative transfer code for this Sun and this line of "
                                  "sight: MODTRAN (tape7, .7sc, .chn, .csv), "
                                  "libRadtran's uvspec, or a table of paths.");
  record
      .required("files", &ImportedDocument::files, list(file(), 1, kMostFiles),
                "one to three runs over level grounds that differ in albedo alone, in one file or several; "
                "others may "
                "tell the direct sunlight")
      .optional("albedos", &ImportedDocument::albedos, list(number(Range::between(0.0, 1.0)), 1, kMostRuns),
                "of these grounds, in the order of the runs, where the files do not say; a single run is "
                "over black "
                "ground if nothing says otherwise")
      .optional("uvspec_inputs", &ImportedDocument::uvspec_inputs, list(file(), 1, kMostFiles),
                "the input files of uvspec, one for each of 'files', all of which are its output then; "
                "without them those "
                "of the same name beside the output (.inp, .INP, .in)")
      .check([](const ImportedDocument& imported, const DocumentNode& node) {
        if (!imported.uvspec_inputs.empty() && imported.uvspec_inputs.size() != imported.files.size())
          node.find("uvspec_inputs")
              ->fail(format("{} has {} files for {} outputs of uvspec; expected one for each", node.title(),
                            imported.uvspec_inputs.size(), imported.files.size()));
      });
  return record.type();
}

}  // namespace ifov::io
