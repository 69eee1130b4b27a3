#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace depthmocap {

// A file or an answer of the server.
struct WebContent {
  std::string type;  // "text/html; charset=utf-8"
  std::string body;
  int status = 200;
  std::filesystem::path file = {};  // sent in place of the body, to be saved under its name: letters, digits, ._-
};

struct WebServerConfig {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8010;  // 0: any that is free
  // Has to be shown by every request where the address is no loopback: ?token=... or Authorization: Bearer ...
  // Empty: none is asked for.
  std::string token = {};
  int max_connections = 32;  // (>= 2) with a request on its way; one more takes the place of the slowest
  // Origins of other pages that may use the server, as "http://localhost:3000" (CORS). "*" is refused.
  std::vector<std::string> allowed_origins = {};
  int workers = 1;       // (>= 1) requests of onPostAside() that are answered at once
  int max_streams = 16;  // (>= 1) clients of /stream; one more takes the place of the quietest
};

// Serves HTTP and WebSocket (Boost.Beast) on a thread of its own. Everything that a client can make grow is bounded:
// connections, header, body and message sizes, the times of a header, a request and a handshake, what waits for the
// slow handlers, and per client one frame and a few texts that wait to be sent. A frame that a client is too slow for
// is replaced by the next one, for that client alone. A client that confirms frames with the text "ready" gets no more
// than two that it has not confirmed.
//
// A request is judged by its header alone: what is refused has no body read. It is answered only for the host names
// that the address has, and where an Origin is named it must be the server's own or an allowed one: pages of others
// cannot reach it. What is wrong gets a 4xx answer with {"error": "..."}.
class WebServer {
 public:
  // Takes the body of a POST or the target of a GET (path and query). Called on the server's thread, but for
  // onPostAside() and onGetAside(). A handler that throws Error answers 400 with its text.
  using Handler = std::function<WebContent(const std::string& body_or_target)>;
  // A text message of a client; the answer, if any, goes to that client.
  using TextHandler = std::function<std::string(const std::string& text)>;

  // Error where the address cannot be used, or is no loopback and there is no token, or the token is none (isToken()),
  // or an allowed origin is none (isOrigin()).
  explicit WebServer(WebServerConfig config);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  // Before start().
  // `open`: scripts and styles, which browsers ask for without the token.
  void serveFile(const std::string& path, WebContent content, bool open = false);
  void onGet(const std::string& path, Handler handler);
  void onPost(const std::string& path, Handler handler);
  // The same for what takes longer than a stream may wait: the handler runs on threads of its own, `workers` requests
  // at a time, in the background.
  void onPostAside(const std::string& path, Handler handler);
  void onGetAside(const std::string& path, Handler handler);
  void onText(TextHandler handler);
  // What every client of /stream is sent first.
  void setGreeting(std::function<std::string()> greeting);
  void start();
  // Nothing is answered any more, and no handler is called. May be called twice; the destructor does it, too.
  void stop();

  // Path and method of every handler, and /stream; the files of serveFile() are not among them.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> routes() const;

  // Any thread. A frame (binary) for all clients of /stream, dropped where one still waits.
  void sendFrame(std::shared_ptr<const std::string> frame);
  // Any thread. A text for all clients of /stream; a client that has too many waiting is closed.
  void sendText(const std::string& text);
  // Any thread. Clients of /stream, and whether one of them has no frame waiting: else making one is wasted.
  [[nodiscard]] int clients() const;
  [[nodiscard]] bool frameWanted() const;
  [[nodiscard]] std::uint16_t port() const;
  // Where a browser finds it, with the token.
  [[nodiscard]] std::string url() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

// 128 random bits of the system as hexadecimal text.
std::string randomToken();

}  // namespace depthmocap
