#include "apps/view/web_server.h"

#include <boost/asio/post.hpp>
#include <chrono>
#include <random>

#include <fmt/format.h>

#include "apps/view/http_connection.h"
#include "apps/view/web_server_impl.h"
#include "depthmocap/error.h"
#include "libtracker/core/background.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::milliseconds kAcceptPause{100};  // where the system has no file descriptor left
constexpr const char* kPreflightAge = "600";            // [s] that a browser may keep what a preflight said

}  // namespace

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
    startHttpConnection(std::move(socket), *this);
    accept();
  });
}

std::optional<WebContent> WebServer::Impl::refused(const WebRequestHeader& header) const {
  for (const http::field once : {http::field::host, http::field::origin, http::field::authorization}) {
    if (header.count(once) > 1) return errorContent(400, "a field of the header that may stand once stands twice");
  }
  GuardConfig asked = guard;
  const auto file = files.find(std::string(pathOf(plainView(header.target()))));
  if (file != files.end() && file->second.open) asked.token.clear();
  const std::string why =
      refusal({plainView(header.target()), plainView(header[http::field::host]), plainView(header[http::field::origin]),
               plainView(header[http::field::authorization]), isPreflight(header)},
              asked);
  if (why.empty()) return std::nullopt;
  return errorContent(403, why);
}

bool WebServer::Impl::isPreflight(const WebRequestHeader& header) const {
  return header.method() == http::verb::options && header.count(http::field::access_control_request_method) > 0 &&
         isAllowedOrigin(plainView(header[http::field::origin]), guard);
}

void WebServer::Impl::allowOrigin(http::fields& response, const WebRequestHeader& header) const {
  if (guard.allowed_origins.empty()) return;
  response.set(http::field::vary, "Origin");
  const boost::beast::string_view origin = header[http::field::origin];
  if (!isAllowedOrigin(plainView(origin), guard)) return;
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

WebContent WebServer::Impl::answer(const WebRequest& request) {
  const std::string target(plainView(request.target()));
  const std::string path(pathOf(target));
  const http::verb method = methodOf(request);
  if (const auto handler = handlers.find({method, path}); handler != handlers.end()) {
    try {
      return handler->second(method == http::verb::get ? target : request.body());
    } catch (const Error& error) {
      return errorContent(400, error.what());
    }
  }
  const auto file = files.find(path);
  if (file != files.end() && method == http::verb::get) return file->second.content;
  const bool known =
      file != files.end() || handlers.contains({http::verb::get, path}) || handlers.contains({http::verb::post, path});
  if (known) return errorContent(405, "this method is not served here");
  return errorContent(404, "there is nothing here");
}

WebServer::WebServer(WebServerConfig config) : impl_(std::make_unique<Impl>(std::move(config))) {}

WebServer::~WebServer() {
  stop();
}

void WebServer::stop() {
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
  impl_->aside.insert({http::verb::post, path});
}

void WebServer::onGetAside(const std::string& path, Handler handler) {
  onGet(path, std::move(handler));
  impl_->aside.insert({http::verb::get, path});
}

void WebServer::onText(TextHandler handler) {
  impl_->stream.on_text = std::move(handler);
}

void WebServer::setGreeting(std::function<std::string()> greeting) {
  impl_->stream.greeting = std::move(greeting);
}

std::vector<std::pair<std::string, std::string>> WebServer::routes() const {
  std::vector<std::pair<std::string, std::string>> routes = {{Impl::kStreamPath, "GET"}};
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
