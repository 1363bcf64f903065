#include "viewer/view_server.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <map>
#include <thread>

#include "core/call_scope.h"
#include "core/error.h"
#include "ifov/series.h"
#include "io/files/own_files.h"
#include "viewer/answers/answers.h"
#include "viewer/http/bounded_server.h"
#include "viewer/http/guard.h"
#include "viewer/page.h"
#include "viewer/sources/checked_document.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/scene_source.h"

extern char** environ;

namespace ifov::viewer {
namespace {

constexpr std::string_view kApi = "/api/";

Reply refusal(int status, const std::string& why) {
  return {status, "application/json", why_refused(why), {}};
}

std::string token_of(const ViewOptions& options) {
  if (!options.token_file.empty()) return token_in(options.token_file.string());
  if (!options.address.empty() && !is_loopback(options.address))
    throw InputError(
        format("--listen {}: others reach this address; --token-file FILE must hold a token that only "
               "those have who may look",
               options.address));
  return new_token();
}

std::string address_of(const ViewOptions& options) {
  if (options.address.empty()) return "127.0.0.1";
  if (options.address == "0.0.0.0" || options.address == "::" || options.address == "*")
    throw InputError(
        format("--listen {}: expected one address of this machine; with all of them it could not be told "
               "whether a request is meant for it",
               options.address));
  return options.address;
}

/// Of the document that is shown; null where none is.
std::unique_ptr<SceneSource> scene_of(const ViewOptions& options, const CheckedDocument* document) {
  if (document == nullptr) return nullptr;
  return std::make_unique<SceneSource>(options.what.front(), options.set);
}

std::unique_ptr<CheckedDocument> document_of(const ViewOptions& options) {
  for (const std::filesystem::path& what : options.what) {
    if (!std::filesystem::exists(what))
      throw SystemError(format("there is no '{}'; expected a folder of products or of a run, or a document",
                               what.string()));
    if (std::filesystem::is_directory(what) || what.filename().string().ends_with("_run.json")) continue;
    if (options.what.size() > 1)
      throw InputError(format(
          "'{}' is no folder; expected a document alone, or one or two folders of products", what.string()));
    return std::make_unique<CheckedDocument>(what, options.set);
  }
  return nullptr;
}

/// Folders of products; of a series those of its times.
ShownFolders folders_of(const ViewOptions& options, const CheckedDocument* document) {
  std::vector<std::filesystem::path> named;
  if (document != nullptr) {
    if (!document->output_folder().empty()) named.push_back(document->output_folder());
  } else {
    for (const std::filesystem::path& what : options.what) {
      named.push_back(std::filesystem::is_directory(what) ? what : what.parent_path());
      if (named.back().empty()) named.back() = ".";
    }
  }
  ShownFolders shown;
  for (const std::filesystem::path& folder : named) {
    if (const auto series = series_info(folder)) {
      if (named.size() > 1)
        throw InputError(
            format("'{}' holds a series of {} times; expected it alone: its times are compared "
                   "with each other",
                   folder.string(), series->times.size()));
      for (const SeriesInfo::Time& one : series->times) {
        shown.folders.push_back(one.folder);
        shown.times.push_back(one.time);
      }
      continue;
    }
    shown.folders.push_back(folder);
    // What cannot be shown is said before a browser opens; a run that has not begun may still begin.
    if (document == nullptr && !signature_of(folder).empty()) static_cast<void>(open_run(folder));
  }
  return shown;
}

}  // namespace

struct ViewServer::Inside {
  std::string token, address;
  Call call;
  Guard guard;
  Answers answers;
  BoundedServer server;
  std::filesystem::path handed_over;

  Inside(const ViewOptions& options, std::unique_ptr<CheckedDocument> document,
         std::unique_ptr<SceneSource> scene)
      : token(token_of(options)),
        address(address_of(options)),
        call(current_call()),
        guard(token, address),
        answers(folders_of(options, document.get()), std::move(document), std::move(scene)),
        server(address, options.port,
               [this](const BoundedServer::Request& request) { return reply(request); }) {}

  Reply reply(const BoundedServer::Request& request) {
    const CallScope scope(call);
    const PageFile* file = page_file(request.path);
    const bool changes = request.path.starts_with(kApi) && Answers::changes(request.path.substr(kApi.size()));
    const Guard::Verdict verdict = guard.judge(request.origin, file == nullptr, changes ? "POST" : "GET");
    if (verdict.status != 0) return refusal(verdict.status, verdict.why);
    if (file != nullptr) return {200, std::string(file->type), std::string(file->content), {}};
    try {
      if (!request.path.starts_with(kApi)) return refusal(404, "there is no such page");
      std::map<std::string, std::string> values;
      request.each_value(
          [&](const std::string& name, const std::string& value) { values.emplace(name, value); });
      Answer answer =
          answers.answer(request.path.substr(kApi.size()), Query(std::move(values), request.nobody_waits));
      return {200, std::move(answer.type), std::move(answer.body), std::move(answer.about)};
    } catch (const Refused& refused) {
      return refusal(refused.status(), refused.what());
    } catch (const InputError& error) {
      return refusal(400, error.what());
    } catch (const SystemError& error) {
      return refusal(503, error.what());
    } catch (const std::bad_alloc&) {
      return refusal(503, "memory ran out");
    } catch (const std::exception& error) {
      return refusal(500, error.what());
    }
  }
};

ViewServer::ViewServer(const ViewOptions& options) {
  std::unique_ptr<CheckedDocument> document = document_of(options);
  std::unique_ptr<SceneSource> scene = scene_of(options, document.get());
  inside_ = std::make_unique<Inside>(options, std::move(document), std::move(scene));
}

ViewServer::~ViewServer() {
  if (inside_->handed_over.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(inside_->handed_over, ignored);
}

std::string ViewServer::url() const {
  const bool is_v6 = inside_->address.find(':') != std::string::npos;
  return format("http://{}{}{}:{}/#{}", is_v6 ? "[" : "", inside_->address, is_v6 ? "]" : "",
                inside_->server.port(), inside_->token);
}

bool ViewServer::open_browser() {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  std::error_code error;
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  std::string pattern =
      ((runtime != nullptr ? std::filesystem::path(runtime) : std::filesystem::temp_directory_path(error)) /
       "ifov-view-XXXXXX")
          .string();
  if (mkdtemp(pattern.data()) == nullptr) return false;
  inside_->handed_over = pattern;
  const std::filesystem::path page = inside_->handed_over / "open.html";
  io::write_new_file(page,
                     "<!doctype html><meta charset=\"utf-8\"><title>ifov view</title>"
                     "<meta http-equiv=\"refresh\" content=\"0;url=" +
                         url() + "\">\n");
  const std::string path = page.string();
  const char* const words[] = {"xdg-open", path.c_str(), nullptr};
  // What it prints is not for this terminal.
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, words[0], &actions, nullptr, const_cast<char* const*>(words), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  std::thread([child] {
    int status = 0;
    waitpid(child, &status, 0);
  }).detach();
  return true;
}

void ViewServer::serve(const CancelToken& cancel) {
  std::atomic<bool> over{false};
  std::thread stopper([&] {
    while (!over) {
      if (cancel.cancelled()) inside_->server.stop();  // more than once: it may not have begun yet
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  inside_->server.serve();
  over = true;
  stopper.join();
}

}  // namespace ifov::viewer
