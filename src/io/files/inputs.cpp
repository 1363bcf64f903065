#include "io/files/inputs.h"

#include "core/error.h"
#include "core/names.h"
#include "io/files/file_reasons.h"

namespace ifov::io {

void Assets::add(const std::string& name, Asset asset) {
  if (name.empty())
    throw InputError("an asset has an empty name; expected one, such as dem for \"asset:dem\"");
  assets_.insert_or_assign(name, std::move(asset));
}

const Assets::Asset* Assets::find(std::string_view name) const {
  if (!is_asset_name(name)) return nullptr;
  const auto found = assets_.find(name.substr(kAssetPrefix.size()));
  return found == assets_.end() ? nullptr : &found->second;
}

std::vector<std::string> Assets::names() const {
  std::vector<std::string> names;
  for (const auto& [name, asset] : assets_) names.push_back(name);
  return names;
}

const Inputs& current_inputs() {
  static const Inputs anything{};
  const Call::Data* data = current_call().inputs.get();
  return data != nullptr ? static_cast<const Inputs&>(*data) : anything;
}

const Assets::Asset& asset_named(const std::string& name) {
  const std::shared_ptr<const Assets>& assets = current_inputs().assets;
  if (!assets || assets->names().empty())
    throw InputError(
        format("there is no '{}': assets are given by the program that loads the document, and it gives none",
               name));
  if (const Assets::Asset* asset = assets->find(name)) return *asset;
  std::vector<std::string> names;
  for (const std::string& one : assets->names()) names.push_back(std::string(kAssetPrefix) + one);
  const std::string hint = did_you_mean(name, names);
  throw InputError(format("there is no '{}'{} Assets of the program: {}", name,
                          hint.empty() ? std::string(".") : hint, list_names(names, "and")));
}

bool input_exists(const std::filesystem::path& name) {
  std::error_code unreadable;
  if (!is_asset_name(name.native())) return std::filesystem::is_regular_file(name, unreadable);
  const Assets* const all = current_inputs().assets.get();
  const Assets::Asset* const asset = all != nullptr ? all->find(name.native()) : nullptr;
  return asset != nullptr && std::any_cast<FileBytes>(&asset->content) != nullptr;
}

void refuse_asset(const std::string& name, const std::string& what, std::string_view expected) {
  throw InputError(format("'{}' is {}; expected {}", name, what, expected));
}

std::filesystem::path folder_of_inputs(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path real = std::filesystem::canonical(folder, error);
  if (error)
    throw InputError(format("ifov: --inputs-below '{}': {}", folder.string(), file_reason(error.value())));
  if (!std::filesystem::is_directory(real, error))
    throw InputError(format("ifov: --inputs-below '{}': found a file; expected a folder", folder.string()));
  return real;
}

}  // namespace ifov::io
