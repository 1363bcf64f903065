#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/run_control.h"

namespace ifov::viewer {

/// What `ifov view` shows, and to whom.
struct ViewOptions {
  /// Folders of products or of runs at work, one or two; or a document, whose output folder is shown.
  std::vector<std::filesystem::path> what;
  std::vector<std::string> set;      ///< of a document, as of Document::read
  std::string address;               ///< empty: this machine alone
  int port = 0;                      ///< 0: any that is free
  std::filesystem::path token_file;  ///< empty: a new token; must be given with an address that others reach
};

/// The viewer's page and what it asks for, served to a browser.
class ViewServer {
 public:
  /// Looks at what is to be shown, and begins to listen. Throws InputError on what cannot be shown and on an address without a
  /// token file, SystemError on files that cannot be read and addresses that cannot be had.
  explicit ViewServer(const ViewOptions& options);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// With the token behind '#', where no browser sends it to anybody.
  std::string url() const;

  /// Shows the page in the user's browser, where there is a screen; false where there is none. The token is handed over in a file
  /// of the user's own, because others can read the words a program was started with.
  bool open_browser();

  /// Answers until it is cancelled.
  void serve(const CancelToken& cancel);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace ifov::viewer
