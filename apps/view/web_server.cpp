#include "apps/view/web_server.h"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
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

constexpr std::chrono::seconds kRequestTime{10};  // for a request to arrive and its answer to leave
constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr const char* kStreamPath = "/stream";

using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

WebContent errorContent(int status, const std::string& text) {
  const auto replace = nlohmann::json::error_handler_t::replace;
  return {"application/json", nlohmann::json{{"error", text}}.dump(-1, ' ', false, replace), status};
}

Response responseOf(WebContent content, const Request& request) {
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
  return response;
}

}  // namespace

struct WebServer::Impl {
  explicit Impl(WebServerConfig c);

  void listen();
  void accept();
  WebContent answer(const Request& request);
  [[nodiscard]] std::string refusalOf(const Request& request, bool open = false) const;

  WebServerConfig config;
  GuardConfig guard;
  int connections = 0;  // server's thread only; outlives those that io still holds
  asio::io_context io{1};
  tcp::acceptor acceptor{io};
  struct File {
    WebContent content;
    bool open = false;
  };
  std::map<std::string, File> files;
  std::map<std::pair<http::verb, std::string>, Handler> handlers;
  std::set<std::string> aside;  // paths whose POST is answered by the worker
  StreamHub stream;
  asio::thread_pool worker{1};
  std::thread thread;
};

// One HTTP connection, until it ends or becomes a stream.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, WebServer::Impl& server)
      : stream_(std::move(socket)), server_(server), count_(std::make_shared<ConnectionCount>(server.connections)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code failure, std::size_t) { self->received(failure); });
  }

 private:
  void received(const error_code& failure) {
    if (failure == http::error::end_of_stream || failure == beast::error::timeout) return;
    const bool too_large = failure == http::error::body_limit || failure == http::error::header_limit;
    if (failure) {
      // What is no HTTP, and what is too large, is told so before the connection ends.
      Request none;
      none.version(11);
      none.keep_alive(false);
      return write(
          responseOf(errorContent(too_large ? 413 : 400, too_large ? "the request is too large"
                                                                   : "this is no HTTP request: " + failure.message()),
                     none));
    }
    if (server_.connections > server_.config.max_connections) {
      return write(responseOf(errorContent(503, "too many connections"), parser_->get()));
    }
    Request request = parser_->release();
    if (websocket::is_upgrade(request) && pathOf(view(request.target())) == kStreamPath) return upgrade(request);
    if (request.method() == http::verb::post && server_.aside.contains(std::string(pathOf(view(request.target()))))) {
      return answerAside(std::move(request));
    }
    write(responseOf(server_.answer(request), request));
  }
  void answerAside(Request request) {
    // The connection goes over to the worker and back whole: it must end on the server's thread.
    asio::post(server_.worker, [self = shared_from_this(), request = std::move(request)]() mutable {
      self->response_ = responseOf(self->server_.answer(request), request);
      asio::io_context& io = self->server_.io;
      asio::post(io, [self = std::move(self)] { self->send(); });
    });
  }
  void upgrade(const Request& request) {
    const std::string refused = server_.refusalOf(request);
    if (!refused.empty()) return write(responseOf(errorContent(403, refused), request));
    stream_.expires_never();
    startStream(std::move(stream_), server_.stream, count_, request);
  }
  void write(Response response) {
    response_ = std::move(response);
    send();
  }
  void send() {
    stream_.expires_after(kRequestTime);
    http::async_write(stream_, response_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return;
      if (self->response_.keep_alive()) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  WebServer::Impl& server_;
  std::shared_ptr<ConnectionCount> count_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + 64 * 1024};
  std::optional<http::request_parser<http::string_body>> parser_;
  Response response_;
};

WebServer::Impl::Impl(WebServerConfig c) : config(std::move(c)) {
  DMC_CHECK(config.max_connections >= 1);
  listen();
  guard = {isLoopback(config.address), acceptor.local_endpoint().port(), config.token};
}

void WebServer::Impl::listen() {
  const std::string where = config.address + ":" + std::to_string(config.port);
  error_code failure;
  const auto address = asio::ip::make_address(config.address, failure);
  if (failure) throw Error("is no numeric address", where, "for example 127.0.0.1 or 0.0.0.0");
  if (!isLoopback(config.address) && config.token.empty()) {
    throw Error("an address that others can reach needs a token", where);
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
    if (!failure) {
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      // Twice as many may wait to be told that there are too many; the rest is closed.
      if (connections < 2 * config.max_connections) {
        std::make_shared<HttpConnection>(std::move(socket), *this)->read();
      }
    }
    accept();
  });
}

std::string WebServer::Impl::refusalOf(const Request& request, bool open) const {
  GuardConfig asked = guard;
  if (open) asked.token.clear();
  return refusal({view(request.target()), view(request[http::field::host]), view(request[http::field::origin]),
                  view(request[http::field::authorization])},
                 asked);
}

WebContent WebServer::Impl::answer(const Request& request) {
  const std::string path(pathOf(view(request.target())));
  const auto file = files.find(path);
  const std::string refused = refusalOf(request, file != files.end() && file->second.open);
  if (!refused.empty()) return errorContent(403, refused);
  const http::verb method = request.method();
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
  impl_->worker.stop();
  impl_->worker.join();
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

void WebServer::start() {
  impl_->accept();
  asio::post(impl_->worker, runInBackground);
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
  const std::string& address = impl_->config.address;
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  std::string url = fmt::format("http://{}:{}/", host, port());
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
