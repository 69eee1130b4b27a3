#include "apps/view/web_server.h"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "apps/view/connection_pool.h"
#include "apps/view/request_guard.h"
#include "apps/view/stream_hub.h"
#include "depthmocap/error.h"
#include "libtracker/core/background.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// Largest body of a POST [bytes].
constexpr std::size_t kMostBodyBytes = 64 * 1024;

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kHeaderTime{5};          // for the first header of a connection to arrive
constexpr std::chrono::seconds kRequestTime{10};        // for what follows: bodies, answers, further requests
constexpr std::chrono::milliseconds kAcceptPause{100};  // where the system has no file descriptor left
constexpr int kMostAside = 32;                          // requests that wait for the slow handlers
constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr const char* kStreamPath = "/stream";
constexpr const char* kPreflightAge = "600";  // [s] that a browser may keep what a preflight said

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

WebContent errorContent(int status, const std::string& text) {
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {"application/json", nlohmann::json{{"error", text}}.dump(-1, ' ', false, replace), status};
}

// A worker gives way to the tracker from its first request on.
void runWorkerInBackground() {
  thread_local const bool done = (runInBackground(), true);
  (void)done;
}

template <typename Header>
Response responseOf(WebContent content, const Header& request) {
  Response response{static_cast<http::status>(content.status), request.version()};
  response.set(http::field::content_type, content.type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Content-Security-Policy",
               "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws: wss:; frame-ancestors 'none'");
  response.keep_alive(request.keep_alive() && content.status < 400);
  response.body() = std::move(content.body);
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();  // its length stays in the header
  return response;
}

}  // namespace

struct WebServer::Impl {
  explicit Impl(WebServerConfig c);

  void listen();
  void accept();
  WebContent answer(const Request& request);
  // What a request is refused with by its header alone; nothing if it may be read on.
  [[nodiscard]] std::optional<WebContent> refused(const http::request_header<>& header) const;
  // Whether a browser asks if a page of an allowed origin may send a request.
  [[nodiscard]] bool isPreflight(const http::request_header<>& header) const;
  // Tells a browser that a page of an allowed origin may read the response, and what it may ask.
  void allowOrigin(Response& response, const http::request_header<>& header) const;

  WebServerConfig config;
  GuardConfig guard;
  ConnectionPool pool;    // server's thread only; outlives the connections that io still holds
  int waiting_aside = 0;  // likewise
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  asio::steady_timer pause{io};
  struct File {
    WebContent content;
    bool open = false;
  };
  std::map<std::string, File> files;
  std::map<std::pair<http::verb, std::string>, Handler> handlers;
  std::set<std::string> aside;  // paths whose POST is answered by a worker
  StreamHub stream;
  asio::thread_pool workers{static_cast<std::size_t>(config.workers)};
  std::thread thread;
};

// One HTTP connection, until it ends or becomes a stream.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, WebServer::Impl& server) : stream_(std::move(socket)), server_(server) {}
  ~HttpConnection() {
    if (place_) server_.pool.leave(*place_);
  }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void start() {
    error_code ignored;
    const std::string address = stream_.socket().remote_endpoint(ignored).address().to_string();
    place_ = server_.pool.enter({address, [this] { stream_.close(); }});
    read(kHeaderTime);
  }

 private:
  void read(std::chrono::seconds time) {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(time);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return self->failed(failure);
      self->receivedHeader();
    });
  }
  // What is no HTTP, and what is too large, is told so before the connection ends.
  void failed(const error_code& failure) {
    const bool gone = failure == http::error::end_of_stream || failure == beast::error::timeout ||
                      failure == asio::error::operation_aborted;
    if (gone) return;
    const bool too_large = failure == http::error::body_limit || failure == http::error::header_limit;
    Request none;
    none.version(11);
    none.keep_alive(false);
    const std::string text = too_large ? "the request is too large" : "this is no HTTP request: " + failure.message();
    write(responseOf(errorContent(too_large ? 413 : 400, text), none));
  }
  void receivedHeader() {
    server_.pool.progressed(*place_);
    const auto& header = parser_->get();
    if (const auto refused = server_.refused(header)) {
      Response response = responseOf(*refused, header);
      server_.allowOrigin(response, header);
      response.keep_alive(false);  // a body that was not read may follow
      return write(std::move(response));
    }
    stream_.expires_after(kRequestTime);
    if (beast::iequals(header[http::field::expect], "100-continue")) return writeContinue();
    readBody();
  }
  void writeContinue() {
    static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(stream_, asio::buffer(kContinue), [self = shared_from_this()](error_code failure, std::size_t) {
      if (!failure) self->readBody();
    });
  }
  void readBody() {
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return self->failed(failure);
      self->received();
    });
  }
  void received() {
    server_.pool.progressed(*place_);
    Request request = parser_->release();
    const std::string path(pathOf(view(request.target())));
    if (websocket::is_upgrade(request) && path == kStreamPath) return upgrade(request);
    if (request.method() == http::verb::post && server_.aside.contains(path)) return answerAside(std::move(request));
    write(answerTo(request));
  }
  [[nodiscard]] Response answerTo(const Request& request) {
    const bool preflight = server_.isPreflight(request);
    Response response = responseOf(preflight ? WebContent{"text/plain", "", 204} : server_.answer(request), request);
    server_.allowOrigin(response, request);
    return response;
  }
  void answerAside(Request request) {
    if (server_.waiting_aside >= kMostAside) {
      Response response = responseOf(errorContent(503, "too many requests are waiting"), request);
      server_.allowOrigin(response, request);
      return write(std::move(response));
    }
    ++server_.waiting_aside;
    // The connection goes over to a worker and back whole: it must end on the server's thread.
    asio::post(server_.workers, [self = shared_from_this(), request = std::move(request)]() mutable {
      runWorkerInBackground();
      self->response_ = self->answerTo(request);
      asio::io_context& io = self->server_.io;
      asio::post(io, [self = std::move(self)] {
        --self->server_.waiting_aside;
        self->send();
      });
    });
  }
  void upgrade(const Request& request) {
    server_.pool.leave(*place_);
    place_.reset();
    stream_.expires_never();
    startStream(std::move(stream_), server_.stream, request);
  }
  void write(Response response) {
    response_ = std::move(response);
    send();
  }
  void send() {
    stream_.expires_after(kRequestTime);
    http::async_write(stream_, response_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return;
      if (self->response_.keep_alive()) return self->read(kRequestTime);
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  WebServer::Impl& server_;
  std::optional<ConnectionPool::Place> place_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + 64 * 1024};
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
};

WebServer::Impl::Impl(WebServerConfig c) : config(std::move(c)), pool(config.max_connections) {
  DMC_CHECK(config.max_connections >= 2 && config.max_streams >= 1 && config.workers >= 1);
  stream.most = config.max_streams;
  listen();
  guard = {config.address, acceptor.local_endpoint().port(), config.token, config.allowed_origins};
}

void WebServer::Impl::listen() {
  const std::string where = config.address + ":" + std::to_string(config.port);
  error_code failure;
  const auto address = asio::ip::make_address(config.address, failure);
  if (failure) throw Error("is no numeric address", where, "for example 127.0.0.1 or 0.0.0.0");
  if (!isLoopback(config.address) && config.token.empty()) {
    throw Error("an address that others can reach needs a token", where);
  }
  if (!config.token.empty() && !isToken(config.token)) {
    throw Error("the token must be 1 to 128 letters, digits and -._~", where, "it stands in the page's address");
  }
  for (const std::string& origin : config.allowed_origins) {
    if (!isOrigin(origin)) {
      throw Error("is no origin of a page", "--allow-origin " + origin, "for example http://localhost:3000, no path");
    }
  }
  const tcp::endpoint endpoint(address, config.port);
  acceptor.open(endpoint.protocol(), failure);
  if (!failure) acceptor.set_option(asio::socket_base::reuse_address(true), failure);
  if (!failure) acceptor.bind(endpoint, failure);
  if (!failure) acceptor.listen(asio::socket_base::max_listen_connections, failure);
  if (failure) throw Error("cannot be listened on: " + failure.message(), where, "choose another --port");
}

void WebServer::Impl::accept() {
  acceptor.async_accept([this](error_code failure, tcp::socket socket) {
    if (failure == asio::error::operation_aborted) return;
    if (failure) {  // no file descriptor is left, as a rule
      pool.closeSlowest();
      pause.expires_after(kAcceptPause);
      return pause.async_wait([this](error_code ended) {
        if (!ended) accept();
      });
    }
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    std::make_shared<HttpConnection>(std::move(socket), *this)->start();
    accept();
  });
}

std::optional<WebContent> WebServer::Impl::refused(const http::request_header<>& header) const {
  for (const http::field once : {http::field::host, http::field::origin, http::field::authorization}) {
    if (header.count(once) > 1) return errorContent(400, "a field of the header that may stand once stands twice");
  }
  GuardConfig asked = guard;
  const auto file = files.find(std::string(pathOf(view(header.target()))));
  if (file != files.end() && file->second.open) asked.token.clear();
  const std::string why =
      refusal({view(header.target()), view(header[http::field::host]), view(header[http::field::origin]),
               view(header[http::field::authorization]), isPreflight(header)},
              asked);
  if (why.empty()) return std::nullopt;
  return errorContent(403, why);
}

bool WebServer::Impl::isPreflight(const http::request_header<>& header) const {
  return header.method() == http::verb::options && header.count(http::field::access_control_request_method) > 0 &&
         isAllowedOrigin(view(header[http::field::origin]), guard);
}

void WebServer::Impl::allowOrigin(Response& response, const http::request_header<>& header) const {
  if (guard.allowed_origins.empty()) return;
  response.set(http::field::vary, "Origin");
  const beast::string_view origin = header[http::field::origin];
  if (!isAllowedOrigin(view(origin), guard)) return;
  response.set(http::field::access_control_allow_origin, origin);
  if (!isPreflight(header)) return;
  response.set(http::field::access_control_allow_methods, "GET, HEAD, POST");
  response.set(http::field::access_control_allow_headers, "authorization, content-type");
  response.set(http::field::access_control_max_age, kPreflightAge);
  // Of pages on the internet that ask a computer of the user's own network.
  if (header.count("Access-Control-Request-Private-Network") > 0) {
    response.set("Access-Control-Allow-Private-Network", "true");
  }
}

WebContent WebServer::Impl::answer(const Request& request) {
  const std::string path(pathOf(view(request.target())));
  const auto file = files.find(path);
  // HEAD is GET without the body.
  const http::verb method = request.method() == http::verb::head ? http::verb::get : request.method();
  if (const auto handler = handlers.find({method, path}); handler != handlers.end()) {
    try {
      return handler->second(request.body());
    } catch (const Error& error) {
      return errorContent(400, error.what());
    }
  }
  if (file != files.end() && method == http::verb::get) return file->second.content;
  const bool known =
      file != files.end() || handlers.contains({http::verb::get, path}) || handlers.contains({http::verb::post, path});
  if (known) return errorContent(405, "this method is not served here");
  return errorContent(404, "there is nothing here");
}

WebServer::WebServer(WebServerConfig config) : impl_(std::make_unique<Impl>(std::move(config))) {}

WebServer::~WebServer() {
  if (!impl_->thread.joinable()) return;
  impl_->workers.stop();
  impl_->workers.join();
  impl_->io.stop();
  impl_->thread.join();
  impl_->stream.clear();
}

void WebServer::serveFile(const std::string& path, WebContent content, bool open) {
  impl_->files[path] = {std::move(content), open};
}

void WebServer::onGet(const std::string& path, Handler handler) {
  impl_->handlers[{http::verb::get, path}] = std::move(handler);
}

void WebServer::onPost(const std::string& path, Handler handler) {
  impl_->handlers[{http::verb::post, path}] = std::move(handler);
}

void WebServer::onPostAside(const std::string& path, Handler handler) {
  onPost(path, std::move(handler));
  impl_->aside.insert(path);
}

void WebServer::onText(TextHandler handler) {
  impl_->stream.on_text = std::move(handler);
}

void WebServer::setGreeting(std::function<std::string()> greeting) {
  impl_->stream.greeting = std::move(greeting);
}

std::vector<std::pair<std::string, std::string>> WebServer::routes() const {
  std::vector<std::pair<std::string, std::string>> routes = {{kStreamPath, "GET"}};
  for (const auto& [route, handler] : impl_->handlers) routes.emplace_back(route.second, http::to_string(route.first));
  return routes;
}

void WebServer::start() {
  impl_->accept();
  impl_->thread = std::thread([this] {
    runInBackground();
    impl_->io.run();
  });
}

void WebServer::sendFrame(std::shared_ptr<const std::string> frame) {
  asio::post(impl_->io, [this, frame = std::move(frame)] { impl_->stream.sendFrame(frame); });
}

void WebServer::sendText(const std::string& text) {
  asio::post(impl_->io, [this, text] { impl_->stream.sendText(text); });
}

int WebServer::clients() const {
  return impl_->stream.count();
}

bool WebServer::frameWanted() const {
  return impl_->stream.frameWanted();
}

std::uint16_t WebServer::port() const {
  return impl_->guard.port;
}

std::string WebServer::url() const {
  std::string url = fmt::format("http://{}:{}/", hostName(impl_->config.address), port());
  if (!impl_->config.token.empty()) url += "?token=" + impl_->config.token;
  return url;
}

std::string randomToken() {
  std::random_device system;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", system());
  return token;
}

}  // namespace depthmocap
