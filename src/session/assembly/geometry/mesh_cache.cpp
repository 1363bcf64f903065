#include "session/assembly/geometry/mesh_cache.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/format.h"
#include "geometry/body_record.h"
#include "io/files/inputs.h"
#include "io/instances/instance_csv.h"
#include "io/scene_cache/scene_cache.h"

namespace ifov::session {
namespace {

constexpr std::size_t kLeast_bytes = 1 << 18;
static_assert(sizeof(io::Instance) == 10 * sizeof(double));

bool any_asset(const std::vector<std::string>& files) {
  return std::any_of(files.begin(), files.end(),
                     [](const std::string& file) { return io::is_asset_name(file); });
}

/// A list as it lies in the cache.
class CachedInstances final : public geometry::Placements {
 public:
  explicit CachedInstances(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::size_t count() const override { return bytes_.size() / sizeof(io::Instance); }
  math::Transform at(std::size_t index) const override {
    io::Instance instance;
    std::memcpy(&instance, bytes_.data() + index * sizeof(io::Instance), sizeof(io::Instance));
    return io::transform_of(instance);
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

geometry::Body cached_mesh(io::SceneCache* cache, const MeshSource& source,
                           const std::function<geometry::TriangleMesh()>& read, std::string* words) {
  if (cache == nullptr || any_asset(source.files)) return geometry::body_of(read());
  std::string name = format("mesh{}", source.more);
  for (const std::string& file : source.files) name += format(" {}", cache->name_of(file));
  const std::string name_of_words = format("words of {}", name);
  const auto kept_words = words != nullptr ? cache->find(name_of_words) : std::nullopt;
  if (words == nullptr || kept_words)
    if (const auto bytes = cache->find(name)) {
      if (std::optional<geometry::Body> body = geometry::body_from_record(*bytes, cache->keeper())) {
        if (words != nullptr)
          words->assign(reinterpret_cast<const char*>(kept_words->data()), kept_words->size());
        return std::move(*body);
      }
      cache->reject(name);
    }
  std::vector<std::string> files = source.files;
  if (source.further)
    for (std::string& file : source.further()) files.push_back(std::move(file));
  std::vector<io::FileStamp> stamps = cache->stamps(files);
  geometry::Body body = geometry::body_of(read());
  const geometry::BodyRecord record = geometry::record_of(body);
  std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(record.head))};
  pieces.insert(pieces.end(), record.lists.begin(), record.lists.end());
  std::size_t bytes = 0;
  for (const auto& piece : pieces) bytes += piece.size();
  if (bytes < kLeast_bytes) return body;
  if (words != nullptr) {
    const std::span<const std::byte> text = std::as_bytes(std::span(*words));
    cache->put(name_of_words, stamps, std::span(&text, 1));
  }
  cache->put(name, std::move(stamps), pieces);
  return body;
}

std::shared_ptr<const geometry::Placements> cached_instances(
    io::SceneCache* cache, const std::vector<std::string>& files,
    const std::function<std::vector<io::Instance>()>& make, const std::string& more) {
  if (cache == nullptr || any_asset(files)) return std::make_shared<io::InstanceList>(make());
  std::string name = format("instances{}", more);
  for (const std::string& file : files) name += format(" {}", cache->name_of(file));
  if (const auto bytes = cache->find(name)) {
    if (bytes->size() % sizeof(io::Instance) == 0) return std::make_shared<CachedInstances>(*bytes);
    cache->reject(name);
  }
  std::vector<io::FileStamp> stamps = cache->stamps(files);
  auto list = std::make_shared<io::InstanceList>(make());
  const std::span<const std::byte> bytes = std::as_bytes(std::span(list->instances()));
  if (bytes.size() >= kLeast_bytes) cache->put(name, std::move(stamps), std::span(&bytes, 1));
  return list;
}

}  // namespace ifov::session
