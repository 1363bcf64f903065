#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "viewer/http/guard.h"

namespace ifov::viewer {

/// What a client gets.
struct Reply {
  int status = 200;
  std::string type, body;
  std::string about;  ///< of a header of that name; empty: none
};

/// HTTP, with bounds on what strangers may cost: so many connections at a time, bytes of a request, and seconds for it. Each reply
/// forbids pages to load, send, frame or run anything but what this server gives out. The only user of cpp-httplib.
class BoundedServer {
 public:
  struct Request {
    Origin origin;
    std::string path;  ///< decoded
    /// Calls with every name and value of the query.
    std::function<void(const std::function<void(const std::string& name, const std::string& value)>&)>
        each_value;
    /// Whether the client has closed the connection, or the server stops. From any thread while the request is answered.
    std::function<bool()> nobody_waits;
  };
  /// From several threads; throws nothing.
  using Handler = std::function<Reply(const Request&)>;

  /// Binds; `port` 0: any. Throws SystemError where the address cannot be had.
  BoundedServer(const std::string& address, int port, Handler handler);
  ~BoundedServer();
  BoundedServer(const BoundedServer&) = delete;
  BoundedServer& operator=(const BoundedServer&) = delete;

  int port() const;
  /// Returns after stop().
  void serve();
  /// From any thread, also before serve().
  void stop();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace ifov::viewer
