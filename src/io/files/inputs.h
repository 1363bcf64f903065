#pragma once

#include <any>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/call_scope.h"

namespace ifov::io {

/// What a document names where it names a file, and a program has in memory: "asset:dem".
inline constexpr std::string_view kAssetPrefix = "asset:";
inline bool is_asset_name(std::string_view name) { return name.starts_with(kAssetPrefix); }

/// Meshes, rasters, spectra, lists of copies and whole files that a program has in memory, by name. They are what the readers
/// of files make: read_mesh() gives a geometry::TriangleMesh, read_raster() a Raster, read_csv_spectrum() the columns
/// of a SpectrumColumns, read_instance_csv() a list of Instance; or a FileBytes, which every reader takes in place of a file.
class Assets {
 public:
  struct Asset {
    std::any content;
    std::string what;                     ///< "a raster of 40 x 30 cells"
    std::uint64_t bytes = 0;              ///< of its numbers
    std::array<std::uint64_t, 2> hash{};  ///< XXH3, 128 bits, of all that it consists of
  };

  /// In place of what had the name. `name` without the prefix; InputError on one that is empty.
  void add(const std::string& name, Asset asset);
  /// Null where there is none; `name` with the prefix.
  const Asset* find(std::string_view name) const;
  std::vector<std::string> names() const;  ///< without the prefix, sorted

 private:
  std::map<std::string, Asset, std::less<>> assets_;
};

/// Two columns of numbers, as a table of text has them.
struct SpectrumColumns {
  std::vector<double> wavelength, value;
};

/// What a file would hold; InputFile gives it out.
struct FileBytes {
  std::shared_ptr<const std::string> bytes;
};

/// What a call may read: files anywhere or below a folder, and assets.
struct Inputs final : Call::Data {
  std::filesystem::path below;           ///< without links; empty: files may lie anywhere
  std::shared_ptr<const Assets> assets;  ///< null: there are none
};

/// Of the call of this thread.
const Inputs& current_inputs();

/// The asset of the current call with a name ("asset:dem"). InputError where there is none, which says which there are.
const Assets::Asset& asset_named(const std::string& name);

/// Its content. InputError where it is something else; `expected`: "a raster".
template <class T>
const T& asset_as(const std::string& name, std::string_view expected);

/// The arrays of an asset: null where a file is named, or an asset that holds the bytes of one. InputError as of asset_as().
template <class T>
const T* arrays_of_asset(const std::filesystem::path& name, std::string_view expected) {
  if (!is_asset_name(name.native()) || std::any_cast<FileBytes>(&asset_named(name).content)) return nullptr;
  return &asset_as<T>(name, expected);
}

/// Whether there is a plain file, or an asset that holds the bytes of one.
bool input_exists(const std::filesystem::path& name);

[[noreturn]] void refuse_asset(const std::string& name, const std::string& what, std::string_view expected);

template <class T>
const T& asset_as(const std::string& name, std::string_view expected) {
  const Assets::Asset& asset = asset_named(name);
  if (const T* content = std::any_cast<T>(&asset.content)) return *content;
  refuse_asset(name, asset.what, expected);
}

/// A folder below which inputs have to lie, without links. InputError where it is not there.
std::filesystem::path folder_of_inputs(const std::filesystem::path& folder);

}  // namespace ifov::io
