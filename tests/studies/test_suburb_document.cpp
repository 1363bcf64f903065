// The suburb of studies, as documents elsewhere are made of it.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/document/document.h"
#include "studies/common/suburb_scene.h"

namespace ifov::studies::test_suburb_document {
namespace {

namespace fs = std::filesystem;

/// Documents in other folders call its files by the names that they have here: 'ifov study temperature -o FOLDER' failed where
/// FOLDER was relative, as its default is.
TEST(SuburbDocument, CallsItsFilesByWholeNames) {
  const fs::path before = fs::current_path(), folder = fs::temp_directory_path() / "ifov_suburb_document";
  fs::create_directories(folder);
  fs::current_path(folder);
  StudyOptions options;
  options.output_folder = "study";
  const io::Document document = suburb_document(options, true);
  fs::current_path(before);
  EXPECT_TRUE(fs::path(document.sources.file_name).is_absolute()) << document.sources.file_name;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ifov::studies::test_suburb_document
