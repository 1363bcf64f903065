#include "session/shared_scene.h"

#include <algorithm>
#include <mutex>

#include "io/document/document.h"
#include "io/scene_cache/file_stamp.h"
#include "session/assembly/whole/scene_assembly.h"

namespace ifov::session {
namespace {

AssembledScene copy_of(const AssembledScene& scene) {
  return {scene::Scene(scene.scene), scene.map_scales, scene.colour_guesses, scene.placed,
          scene.map_offset_m};
}

}  // namespace

/// Keeps what is said.
class SharedScene::Recorder final : public LogSink {
 public:
  explicit Recorder(std::vector<Message>& said) : said_(said) {}
  void info(const std::string& message) override { keep(false, message); }
  void warn(const std::string& message) override { keep(true, message); }

 private:
  void keep(bool is_warning, const std::string& text) {
    const std::scoped_lock lock(mutex_);
    said_.push_back({is_warning, text});
  }
  std::mutex mutex_;
  std::vector<Message>& said_;
};

SharedScene::SharedScene() = default;
SharedScene::~SharedScene() = default;

bool SharedScene::serves(const io::Document& document) {
  const auto& objects = document.scene.objects;
  return std::none_of(objects.begin(), objects.end(),
                      [](const auto& object) { return object.present != nullptr; });
}

AssembledScene SharedScene::scene(const std::function<AssembledScene(LogSink*)>& assemble, LogSink* log) {
  if (!scene_) {
    said_.clear();
    Recorder recorder(said_);
    scene_ = std::make_unique<const AssembledScene>(assemble(&recorder));
  }
  if (log != nullptr)
    for (const Message& message : said_)
      message.is_warning ? log->warn(message.text) : log->info(message.text);
  return copy_of(*scene_);
}

}  // namespace ifov::session
