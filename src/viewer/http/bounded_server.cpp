#include "viewer/http/bounded_server.h"

#include <arpa/inet.h>
#include <httplib.h>
#include <poll.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "core/error.h"

namespace ifov::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kThreads = 12;                 // connections that are answered at a time
constexpr std::size_t kWaiting = 32;                 // accepted connections that wait for one of these
constexpr std::size_t kMostRequestBytes = 16384;     // line and headers
constexpr std::chrono::seconds kMostRequestTime{5};  // for these to come
constexpr std::chrono::seconds kMostReplyTime{60};
constexpr std::chrono::seconds kIdle{2};  // of a connection between two requests
constexpr int kMostRequests = 200;        // of one connection

/// Polls a socket in short steps, so that the server can stop. False where nothing came in time.
bool wait_for(socket_t socket, short what, Clock::time_point until, const std::atomic<bool>& stopping) {
  while (!stopping) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd polled{socket, what, 0};
    const int found = poll(&polled, 1, static_cast<int>(std::min<long long>(left, 100)));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
  }
  return false;
}

/// A socket that gives so many bytes in so much time, whatever the client does: httplib bounds the time between two bytes
/// and not the number of headers.
class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const std::atomic<bool>& stopping)
      : socket_(socket), stopping_(stopping), until_(Clock::now() + kMostRequestTime) {}

  bool is_readable() const override { return wait_for(socket_, POLLIN, until_, stopping_); }
  bool is_writable() const override {
    return wait_for(socket_, POLLOUT, Clock::now() + kMostReplyTime, stopping_);
  }
  ssize_t read(char* to, size_t size) override {
    if (begin_ == end_) {
      if (left_ == 0 || !is_readable()) return -1;
      const ssize_t count = recv(socket_, buffer_, std::min(sizeof buffer_, left_), 0);
      if (count <= 0) return count;
      left_ -= static_cast<std::size_t>(count);
      begin_ = 0;
      end_ = static_cast<std::size_t>(count);
    }
    const std::size_t count = std::min(size, end_ - begin_);
    std::copy_n(buffer_ + begin_, count, to);
    begin_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, size_t size) override {
    if (!writing_) until_write_ = Clock::now() + kMostReplyTime;
    writing_ = true;
    if (!wait_for(socket_, POLLOUT, until_write_, stopping_)) return -1;
    return send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  socket_t socket() const override { return socket_; }

 private:
  socket_t socket_;
  const std::atomic<bool>& stopping_;
  Clock::time_point until_, until_write_{};
  char buffer_[4096];
  std::size_t begin_ = 0, end_ = 0, left_ = kMostRequestBytes;
  bool writing_ = false;
};

/// Threads of which each answers one connection. Who cannot be taken waits in the system's queue.
class Tasks final : public httplib::TaskQueue {
 public:
  explicit Tasks(const std::atomic<bool>& stopping) : stopping_(stopping) {
    for (std::size_t k = 0; k < kThreads; ++k) threads_.emplace_back([this] { work(); });
  }
  void enqueue(std::function<void()> task) override {
    std::unique_lock lock(mutex_);
    while (tasks_.size() >= kWaiting && !stopping_) changed_.wait_for(lock, std::chrono::milliseconds(100));
    tasks_.push_back(std::move(task));
    changed_.notify_all();
  }
  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() {
    while (true) {
      std::function<void()> task;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return closing_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      changed_.notify_all();
      task();
    }
  }

  const std::atomic<bool>& stopping_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::thread> threads_;
  bool closing_ = false;
};

/// The connection that this thread answers.
thread_local socket_t connection = INVALID_SOCKET;

bool has_gone(socket_t socket) {
  pollfd polled{socket, POLLRDHUP, 0};
  return poll(&polled, 1, 0) > 0 && (polled.revents & (POLLRDHUP | POLLHUP | POLLERR | POLLNVAL)) != 0;
}

/// httplib's, but each connection is read through a BoundedStream.
class Server final : public httplib::Server {
 public:
  std::atomic<bool> stopping{false};

 private:
  bool process_and_close_socket(socket_t socket) override {
    const int no_delay = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &no_delay, sizeof no_delay);
    connection = socket;
    bool closed = false;
    for (int k = 0; k < kMostRequests && !closed; ++k) {
      if (!wait_for(socket, POLLIN, Clock::now() + kIdle, stopping)) break;
      BoundedStream stream(socket, stopping);
      if (!process_request(stream, k + 1 == kMostRequests, closed, nullptr)) break;
    }
    ::shutdown(socket, SHUT_RDWR);
    ::close(socket);
    return true;
  }
};

void set_security(httplib::Response& response) {
  response.set_header("Content-Security-Policy",
                      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
                      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
                      "require-trusted-types-for 'script'; trusted-types 'none'");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Cache-Control", "no-store");
}

}  // namespace

struct BoundedServer::Inside {
  Server server;
  int port = 0;
  Handler handler;

  void answer(const httplib::Request& asked, httplib::Response& response) const {
    const socket_t asking = connection;
    const Request request{{asked.method, asked.get_header_value("Host"), asked.get_header_value("Origin"),
                           asked.get_header_value("Sec-Fetch-Site"), asked.get_header_value("X-Ifov-Token"),
                           static_cast<int>(asked.get_header_value_count("Host"))},
                          asked.path,
                          [&](const auto& take) {
                            for (const auto& [name, value] : asked.params) take(name, value);
                          },
                          [this, asking] { return server.stopping || has_gone(asking); }};
    // A reply in thousands of overlapping parts would be a cheap way to a large one.
    const Reply reply = asked.has_header("Range") ? Reply{400, "text/plain", "parts are not given out", {}}
                                                  : handler(request);
    response.status = reply.status;
    if (!reply.about.empty()) response.set_header("X-Ifov-About", reply.about);
    response.set_content(reply.body, reply.type.c_str());
  }
};

BoundedServer::BoundedServer(const std::string& address, int port, Handler handler)
    : inside_(std::make_unique<Inside>()) {
  Server& server = inside_->server;
  inside_->handler = std::move(handler);
  server.new_task_queue = [&server] { return new Tasks(server.stopping); };
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;  // a port that was just given up may be taken again, one in use may not
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_payload_max_length(0);
  // All is answered before httplib looks at methods, bodies and paths.
  server.set_pre_routing_handler([this](const httplib::Request& asked, httplib::Response& response) {
    inside_->answer(asked, response);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_post_routing_handler(
      [](const httplib::Request&, httplib::Response& response) { set_security(response); });
  inside_->port =
      port == 0 ? server.bind_to_any_port(address) : (server.bind_to_port(address, port) ? port : -1);
  if (inside_->port < 0)
    throw SystemError(port == 0
                          ? format("cannot listen at {}: {}", address, std::strerror(errno))
                          : format("cannot listen at {}, port {}: {}", address, port, std::strerror(errno)));
}

BoundedServer::~BoundedServer() { stop(); }

int BoundedServer::port() const { return inside_->port; }

void BoundedServer::serve() {
  if (!inside_->server.stopping) inside_->server.listen_after_bind();
}

void BoundedServer::stop() {
  inside_->server.stopping = true;
  inside_->server.stop();
}

}  // namespace ifov::viewer
