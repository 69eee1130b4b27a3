#pragma once
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "apps/view/connection_pool.h"
#include "apps/view/request_guard.h"
#include "apps/view/stream_hub.h"
#include "apps/view/web_answer.h"
#include "apps/view/web_server.h"

namespace depthmocap {

// What the server and its connections share. Used on the server's thread, but for answer(), which workers call, too.
struct WebServer::Impl {
  static constexpr const char* kStreamPath = "/stream";

  explicit Impl(WebServerConfig c);

  void listen();
  void accept();
  WebContent answer(const WebRequest& request);
  // What a request is refused with by its header alone; nothing if it may be read on.
  [[nodiscard]] std::optional<WebContent> refused(const WebRequestHeader& header) const;
  // Whether a browser asks if a page of an allowed origin may send a request.
  [[nodiscard]] bool isPreflight(const WebRequestHeader& header) const;
  // Tells a browser that a page of an allowed origin may read the response, and what it may ask.
  void allowOrigin(boost::beast::http::fields& response, const WebRequestHeader& header) const;

  WebServerConfig config;
  GuardConfig guard;
  ConnectionPool pool;    // server's thread only; outlives the connections that io still holds
  int waiting_aside = 0;  // likewise
  boost::asio::io_context io{1};
  boost::asio::ip::tcp::acceptor acceptor{io};
  boost::asio::steady_timer pause{io};
  struct File {
    WebContent content;
    bool open = false;
  };
  std::map<std::string, File> files;
  std::map<std::pair<boost::beast::http::verb, std::string>, Handler> handlers;
  std::set<std::pair<boost::beast::http::verb, std::string>> aside;  // of these handlers, those whom a worker calls
  StreamHub stream;
  boost::asio::thread_pool workers{static_cast<std::size_t>(config.workers)};
  std::thread thread;
};

}  // namespace depthmocap
