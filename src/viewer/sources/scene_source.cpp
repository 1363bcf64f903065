#include "viewer/sources/scene_source.h"

#include "core/call_scope.h"
#include "core/error.h"
#include "io/json/document_override.h"

namespace ifov::viewer {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

}  // namespace

/// Takes down how far loading is.
class SceneSource::Teller final : public ProgressSink {
 public:
  Teller(SceneSource& source, std::uint64_t version) : source_(source), version_(version) {}
  void report(const Progress& progress) override {
    const std::lock_guard lock(source_.mutex_);
    if (source_.state_.version != version_) return;
    source_.state_.done = progress.pixels_done, source_.state_.of = progress.pixels_total;
  }
  void phase(const std::string& what) override {
    const std::lock_guard lock(source_.mutex_);
    if (source_.state_.version == version_) source_.state_.phase = what;
  }

 private:
  SceneSource& source_;
  std::uint64_t version_;
};

SceneSource::SceneSource(std::filesystem::path file, std::vector<std::string> set)
    : file_(std::move(file)), set_(std::move(set)) {}

SceneSource::~SceneSource() {
  {
    const std::lock_guard lock(mutex_);
    if (cancel_) cancel_->cancel();
  }
  if (loading_.joinable()) loading_.join();
}

SceneSource::State SceneSource::state() {
  const std::lock_guard lock(mutex_);
  if (!cancel_) {
    cancel_ = std::make_shared<CancelToken>();
    begun_ = std::chrono::steady_clock::now();
    loading_ = std::thread([this, version = state_.version, cancel = cancel_, inputs = current_call().inputs,
                            before = std::move(loading_)]() mutable {
      if (before.joinable()) before.join();
      const Call call{inputs, cancel.get()};
      const CallScope scope(call);
      load(version);
    });
  }
  State now = state_;
  if (!now.model && now.failure.empty()) now.elapsed_s = seconds_since(begun_);
  return now;
}

void SceneSource::follow(std::uint64_t version) {
  const std::lock_guard lock(mutex_);
  if (version <= state_.version) return;
  if (cancel_) cancel_->cancel();
  cancel_.reset();
  state_ = {};
  state_.version = version;
}

bool SceneSource::is_loading() {
  const std::lock_guard lock(mutex_);
  return cancel_ && !state_.model && state_.failure.empty();
}

void SceneSource::load(std::uint64_t version) {
  std::shared_ptr<const session::SceneModel> model;
  std::vector<session::DocumentFault> faults;
  std::string failure;
  Teller teller(*this, version);
  try {
    std::vector<io::DocumentOverride> overrides;
    for (const std::string& written : set_) overrides.push_back(io::read_override(written));
    model = session::SceneModel::load(file_.string(), overrides, &teller, &faults);
  } catch (const std::bad_alloc&) {
    failure = "memory ran out while the scene was loaded";
  } catch (const std::exception& error) {
    failure = error.what();
  }
  const std::lock_guard lock(mutex_);
  if (state_.version != version) return;
  state_.model = std::move(model);
  state_.failure = std::move(failure);
  state_.faults = std::move(faults);
  state_.elapsed_s = seconds_since(begun_);
}

}  // namespace ifov::viewer
