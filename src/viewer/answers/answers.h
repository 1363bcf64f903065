#pragma once

#include <memory>
#include <mutex>
#include <semaphore>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/answers/answer.h"
#include "viewer/sources/source.h"

namespace ifov::session {
class SceneModel;
}

namespace ifov::viewer {

class CheckedDocument;
class SceneSource;

/// What the command line names, as folders.
struct ShownFolders {
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> times;  ///< of each, where they are those of a series; else empty
};

/// What the page may ask for, each under a name of a table. Knows nothing of HTTP. From any thread.
class Answers {
 public:
  /// `document` and its `scene` may be null.
  Answers(ShownFolders shown, std::unique_ptr<CheckedDocument> document, std::unique_ptr<SceneSource> scene);
  ~Answers();

  /// Throws Refused; InputError and SystemError as readers do.
  Answer answer(std::string_view name, const Query& query);

  /// Whether what has this name changes something beside what it answers: it is to be posted.
  static bool changes(std::string_view name);

  // Each name's own, for the table.
  Answer sources(const Query& query);
  Answer band(const Query& query);
  Answer spread(const Query& query);
  Answer pixel(const Query& query);
  Answer region(const Query& query);
  Answer projection(const Query& query);
  Answer tile(const Query& query);
  /// The one that changes something: it asks the run that a folder holds to stop.
  Answer stop(const Query& query);
  Answer document(const Query& query);
  Answer materials(const Query& query);
  Answer colours(const Query& query);
  Answer scene(const Query& query);
  Answer look(const Query& query);
  Answer pick(const Query& query);

 private:
  Source& source(const Query& query);
  /// What a source holds. Of a series the one that nobody has asked for longest is closed: a day of times has more files than may be open.
  Source::Now look_at(std::size_t source);
  /// The run of the generation that is asked for; 409 where there is another by now.
  std::shared_ptr<const OpenRun> run(const Query& query);

  /// Which version of the document is shown, after a look at its file; 0 where none is.
  std::uint64_t document_version();
  SceneSource& scene_source();
  std::shared_ptr<const session::SceneModel> scene_model();

  /// A turn that was taken, given back at the end.
  template <class Turns>
  struct Turn {
    explicit Turn(Turns& taken) : turns(&taken) {}
    ~Turn() {
      if (turns != nullptr) turns->release();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    Turns* turns;
  };

  std::vector<std::unique_ptr<Source>> sources_;
  std::vector<std::string> times_;  ///< of each, in a series
  std::mutex recent_mutex_;
  std::vector<std::size_t> recent_;  ///< times of a series that are open, the last that was asked for first
  std::unique_ptr<CheckedDocument> document_;
  std::unique_ptr<SceneSource> scene_;
  std::counting_semaphore<2> large_{2};  ///< what takes much memory waits for its turn
  std::counting_semaphore<1> rays_{1};   ///< so do pictures of the scene
};

/// At most so many values in one answer.
inline constexpr std::size_t kMostValues = std::size_t{1} << 21;

}  // namespace ifov::viewer
