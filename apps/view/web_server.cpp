#include "apps/view/web_server.h"

#include <algorithm>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "apps/view/request_guard.h"
#include "libtracker/core/check.h"
#include "libtracker/core/error.h"

namespace depthmocap {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kRequestTime{10};  // for a request to arrive and its answer to leave
constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr std::size_t kMaxMessageBytes = 4 * 1024;  // of a client
constexpr std::size_t kMaxWaitingTexts = 32;        // per client
constexpr const char* kReady = "ready";
constexpr int kMaxUnconfirmed = 2;
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

class StreamClient;

struct WebServer::Impl {
  explicit Impl(WebServerConfig c);

  void listen();
  void accept();
  WebContent answer(const Request& request);
  [[nodiscard]] std::string refusalOf(const Request& request, bool open = false) const;
  void updateWanted();

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
  TextHandler text_handler;
  std::function<std::string()> greeting;
  std::set<std::shared_ptr<StreamClient>> stream_clients;  // server's thread only
  std::atomic<int> client_count{0};
  std::atomic<bool> wanted{false};
  std::thread thread;
};

// Counts a connection as long as it lives.
class ConnectionCount {
 public:
  explicit ConnectionCount(int& count) : count_(count) { ++count_; }
  ~ConnectionCount() { --count_; }
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;

 private:
  int& count_;
};

// One client of /stream. All members are used on the server's thread.
class StreamClient : public std::enable_shared_from_this<StreamClient> {
 public:
  StreamClient(beast::tcp_stream stream, WebServer::Impl& server, std::shared_ptr<ConnectionCount> count)
      : socket_(std::move(stream)), server_(server), count_(std::move(count)) {}

  void run(const Request& request) {
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxMessageBytes);
    socket_.async_accept(request, [self = shared_from_this()](error_code failure) {
      if (!failure) self->joined();
    });
  }
  void frame(std::shared_ptr<const std::string> frame) {
    if (!hasCredit()) return;
    frame_ = std::move(frame);
    write();
  }
  void text(const std::string& text) {
    if (texts_.size() >= kMaxWaitingTexts) return close();
    texts_.push_back(std::make_shared<const std::string>(text));
    write();
  }
  [[nodiscard]] bool waitsForFrame() const { return frame_ == nullptr && hasCredit(); }
  void close() {
    server_.stream_clients.erase(shared_from_this());
    server_.client_count = static_cast<int>(server_.stream_clients.size());
    server_.updateWanted();
    beast::get_lowest_layer(socket_).close();
  }

  // Frames on their way wait in the buffers of the system and the browser, where they only grow old.
  [[nodiscard]] bool hasCredit() const { return !confirms_ || unconfirmed_ < kMaxUnconfirmed; }

 private:
  void joined() {
    server_.stream_clients.insert(shared_from_this());
    server_.client_count = static_cast<int>(server_.stream_clients.size());
    server_.updateWanted();
    if (server_.greeting) text(server_.greeting());
    read();
  }
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return self->close();
      self->received();
    });
  }
  void received() {
    const bool is_text = socket_.got_text();
    const std::string message = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (is_text && message == kReady) {
      confirms_ = true;
      unconfirmed_ = std::max(0, unconfirmed_ - 1);
      server_.updateWanted();
    } else if (is_text && server_.text_handler) {
      const std::string answer = server_.text_handler(message);
      if (!answer.empty()) text(answer);
    }
    read();
  }
  void write() {
    if (writing_ || (texts_.empty() && !frame_)) return;
    if (!texts_.empty()) {
      writing_ = texts_.front();
      texts_.pop_front();
      socket_.text(true);
    } else {
      writing_ = std::move(frame_);
      frame_ = nullptr;
      ++unconfirmed_;
      socket_.binary(true);
    }
    server_.updateWanted();
    socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](error_code failure, std::size_t) {
      self->writing_ = nullptr;
      if (failure) return self->close();
      self->write();
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  WebServer::Impl& server_;
  std::shared_ptr<ConnectionCount> count_;
  beast::flat_buffer buffer_;
  bool confirms_ = false;  // the client says "ready" for each frame that it is done with
  int unconfirmed_ = 0;    // frames that were sent and not confirmed
  std::shared_ptr<const std::string> writing_;
  std::shared_ptr<const std::string> frame_;
  std::deque<std::shared_ptr<const std::string>> texts_;
};

// One HTTP connection, until it ends or becomes a stream.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, WebServer::Impl& server)
      : stream_(std::move(socket)), server_(server), count_(std::make_shared<ConnectionCount>(server.connections)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(server_.config.max_body_bytes);
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
    const Request request = parser_->release();
    if (websocket::is_upgrade(request) && pathOf(view(request.target())) == kStreamPath) return upgrade(request);
    write(responseOf(server_.answer(request), request));
  }
  void upgrade(const Request& request) {
    const std::string refused = server_.refusalOf(request);
    if (!refused.empty()) return write(responseOf(errorContent(403, refused), request));
    stream_.expires_never();
    std::make_shared<StreamClient>(std::move(stream_), server_, count_)->run(request);
  }
  void write(Response response) {
    response_ = std::move(response);
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

void WebServer::Impl::updateWanted() {
  wanted = std::any_of(stream_clients.begin(), stream_clients.end(),
                       [](const auto& client) { return client->waitsForFrame(); });
}

WebServer::WebServer(WebServerConfig config) : impl_(std::make_unique<Impl>(std::move(config))) {}

WebServer::~WebServer() {
  if (!impl_->thread.joinable()) return;
  impl_->io.stop();
  impl_->thread.join();
  impl_->stream_clients.clear();
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

void WebServer::onText(TextHandler handler) {
  impl_->text_handler = std::move(handler);
}

void WebServer::setGreeting(std::function<std::string()> greeting) {
  impl_->greeting = std::move(greeting);
}

void WebServer::start() {
  impl_->accept();
  impl_->thread = std::thread([this] { impl_->io.run(); });
}

void WebServer::sendFrame(std::shared_ptr<const std::string> frame) {
  asio::post(impl_->io, [this, frame = std::move(frame)] {
    // A copy: a client that fails leaves the set.
    const auto clients = impl_->stream_clients;
    for (const auto& client : clients) client->frame(frame);
    impl_->updateWanted();
  });
}

void WebServer::sendText(const std::string& text) {
  asio::post(impl_->io, [this, text] {
    const auto clients = impl_->stream_clients;
    for (const auto& client : clients) client->text(text);
  });
}

int WebServer::clients() const {
  return impl_->client_count;
}

bool WebServer::frameWanted() const {
  return impl_->wanted;
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
