#include "io/mesh/gltf_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <vector>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/files/inputs.h"
#include "io/json/json_adapter.h"

namespace ifov::io {
namespace {

constexpr std::size_t kGlbHeader = 20;  // file header and the header of the first chunk

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

bool is_binary(const std::string& bytes) { return bytes.starts_with("glTF"); }

/// The JSON text of either form.
std::string json_of(const std::string& bytes, const std::string& name) {
  if (!is_binary(bytes)) return bytes;
  constexpr std::uint32_t kJson = 0x4e4f534a;
  if (bytes.size() < kGlbHeader)
    throw InputError(format("{}: byte {}: the file ends in its header", name, bytes.size()), {name, 0, 0});
  if (const std::uint32_t version = word_at(bytes, 4); version != 2)
    throw InputError(format("{}: byte 4: expected glTF version 2, found {}", name, version), {name, 0, 0});
  const std::uint32_t length = word_at(bytes, 12);
  if (word_at(bytes, 16) != kJson)
    throw InputError(format("{}: byte 16: expected a chunk of JSON", name), {name, 0, 0});
  if (length > bytes.size() - kGlbHeader)
    throw InputError(format("{}: byte 12: the chunk of JSON announces {} bytes, {} are left", name, length,
                            bytes.size() - kGlbHeader),
                     {name, 0, 0});
  return bytes.substr(kGlbHeader, length);
}

/// The files that the buffers name, the only ones that are opened.
struct OpenableFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;

  bool has(const std::filesystem::path& path) const {
    std::error_code error;
    const auto real = std::filesystem::weakly_canonical(path, error);
    return !error && std::find(files.begin(), files.end(), real) != files.end() &&
           std::filesystem::is_regular_file(real, error);
  }
};

OpenableFiles openable_files(const DocumentTree& tree, const std::filesystem::path& path) {
  OpenableFiles open;
  open.folder = std::filesystem::weakly_canonical(path.has_parent_path() ? path.parent_path() : ".");
  const DocumentNode* buffers =
      tree.root->type() == DocumentNode::Type::object ? tree.root->find("buffers") : nullptr;
  if (buffers == nullptr || buffers->type() != DocumentNode::Type::list) return open;
  for (const DocumentNode& buffer : buffers->items()) {
    const DocumentNode* uri = buffer.type() == DocumentNode::Type::object ? buffer.find("uri") : nullptr;
    if (uri == nullptr || uri->type() != DocumentNode::Type::text || uri->text().starts_with("data:"))
      continue;
    const std::string decoded = decoded_uri(uri->text());
    if (is_asset_name(path.native()))
      uri->fail(
          format("found the buffer '{}'; expected those of a mesh in memory within it: a data URI, or a .glb",
                 decoded));
    std::error_code error;
    const auto real = std::filesystem::weakly_canonical(open.folder / decoded, error);
    const auto within = error ? std::filesystem::path("..") : real.lexically_relative(open.folder);
    if (within.empty() || *within.begin() == "..")
      uri->fail(format("the buffer '{}' does not lie in the folder of this file", decoded));
    if (!std::filesystem::is_regular_file(real, error))
      uri->fail(format("there is no file '{}'", real.string()));
    open.files.push_back(real);
  }
  return open;
}

bool file_exists(const std::string& path, void* open) { return static_cast<OpenableFiles*>(open)->has(path); }
std::string same_path(const std::string& path, void*) { return path; }
bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                     void* open) {
  if (!static_cast<OpenableFiles*>(open)->has(path)) {
    *error = "not a buffer of this file";
    return false;
  }
  const std::string bytes = read_input(path);
  out->assign(bytes.begin(), bytes.end());
  return true;
}
bool no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
              void*) {
  return true;
}
/// Of images in buffers the library has not looked whether they lie within.
bool keep_inline_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                       const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

DocumentTree tree_of(const std::filesystem::path& path) {
  const std::string bytes = read_input(path);
  JsonRules rules;
  rules.max_bytes = rules.max_values = bytes.size();
  return parse_json(json_of(bytes, path.string()), path.string(), rules);
}

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return text.substr(0, 500);
}

}  // namespace

std::string decoded_uri(const std::string& uri) {
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    unsigned code = 0;
    const char* digits = uri.data() + k + 1;
    if (uri[k] == '%' && k + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      text += static_cast<char>(code);
      k += 2;
    } else {
      text += uri[k] == '+' ? ' ' : uri[k];
    }
  }
  return text;
}

tinygltf::Model load_gltf(const std::filesystem::path& path, LogSink* log, GltfImages images) {
  const std::string name = path.string();
  std::string bytes = read_input(path);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.size() > std::numeric_limits<int>::max())
    throw InputError(format("{}: the file is larger than 2 GiB", name), {name, 0, 0});
  JsonRules rules;
  rules.comments = false;
  rules.max_bytes = bytes.size();
  // Our parser goes first: it bounds the depth and names the place of what is wrong.
  const DocumentTree tree = parse_json(json_of(bytes, name), name, rules);
  OpenableFiles open = openable_files(tree, path);
  if (log != nullptr && images == GltfImages::left_out && tree.root->type() == DocumentNode::Type::object &&
      tree.root->find("images") != nullptr)
    log->warn(format(
        "{}: its images are not used; give materials and maps in the document, or say \"from_file\"", name));

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(images == GltfImages::kept ? keep_inline_image : no_image, nullptr);
  loader.SetFsCallbacks({file_exists, same_path, read_whole_file, nullptr, &open});
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  bool good = false;
  try {
    good =
        is_binary(bytes)
            ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                          open.folder.string())
            : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, open.folder.string());
  } catch (const SystemError&) {
    throw;
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  if (!good)
    throw InputError(
        format("{}: not a valid glTF 2 file: {}", name, error.empty() ? "unreadable" : one_line(error)),
        {name, 0, 0});
  if (model.asset.version.substr(0, 2) != "2.")
    throw InputError(format("{}: expected glTF version 2, found '{}'", name, one_line(model.asset.version)),
                     {name, 0, 0});
  return model;
}

std::vector<std::filesystem::path> gltf_buffers(const std::filesystem::path& path) {
  try {
    return openable_files(tree_of(path), path).files;
  } catch (const InputError&) {
    return {};
  }
}

std::vector<std::string> gltf_image_uris(const std::filesystem::path& path) {
  std::vector<std::string> uris;
  try {
    const DocumentTree tree = tree_of(path);
    const DocumentNode* images =
        tree.root->type() == DocumentNode::Type::object ? tree.root->find("images") : nullptr;
    if (images == nullptr || images->type() != DocumentNode::Type::list) return uris;
    for (const DocumentNode& image : images->items()) {
      const DocumentNode* uri = image.type() == DocumentNode::Type::object ? image.find("uri") : nullptr;
      if (uri != nullptr && uri->type() == DocumentNode::Type::text && !uri->text().starts_with("data:"))
        uris.push_back(decoded_uri(uri->text()));
    }
  } catch (const InputError&) {
  }
  return uris;
}

}  // namespace ifov::io
