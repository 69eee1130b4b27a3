#include "apps/view/http_connection.h"

#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "libtracker/core/background.h"

namespace depthmocap {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostBodyBytes = 64 * 1024;  // of a POST
constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr std::chrono::seconds kHeaderTime{5};    // for the first header of a connection to arrive
constexpr std::chrono::seconds kRequestTime{10};  // for what follows: bodies, answers, each piece of a file
constexpr int kMostAside = 32;                    // requests that wait for the slow handlers

// A worker gives way to the tracker from its first request on.
void runWorkerInBackground() {
  thread_local const bool done = (runInBackground(), true);
  (void)done;
}

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
  using FileResponse = http::response<http::file_body>;

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
    WebRequest none;
    none.version(11);
    none.keep_alive(false);
    const std::string text = too_large ? "the request is too large" : "this is no HTTP request: " + failure.message();
    write(responseOf(errorContent(too_large ? 413 : 400, text), none));
  }
  void receivedHeader() {
    server_.pool.progressed(*place_);
    const auto& header = parser_->get();
    if (const auto refused = server_.refused(header)) {
      WebResponse response = responseOf(*refused, header);
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
    request_ = parser_->release();
    const std::string path(pathOf(plainView(request_.target())));
    if (websocket::is_upgrade(request_) && path == WebServer::Impl::kStreamPath) return upgrade();
    if (server_.isPreflight(request_)) return answer({"text/plain", "", 204});
    if (server_.aside.contains({methodOf(request_), path})) return answerAside();
    answer(server_.answer(request_));
  }
  void answerAside() {
    if (server_.waiting_aside >= kMostAside) return answer(errorContent(503, "too many requests are waiting"));
    ++server_.waiting_aside;
    // The connection goes over to a worker and back whole: it must end on the server's thread.
    asio::post(server_.workers, [self = shared_from_this()]() mutable {
      runWorkerInBackground();
      WebContent content = self->server_.answer(self->request_);
      asio::io_context& io = self->server_.io;
      asio::post(io, [self = std::move(self), content = std::move(content)]() mutable {
        --self->server_.waiting_aside;
        self->answer(std::move(content));
      });
    });
  }
  void upgrade() {
    server_.pool.leave(*place_);
    place_.reset();
    stream_.expires_never();
    startStream(std::move(stream_), server_.stream, request_);
  }
  void answer(WebContent content) {
    if (!content.file.empty()) return answerFile(content);
    WebResponse response = responseOf(std::move(content), request_);
    server_.allowOrigin(response, request_);
    write(std::move(response));
  }
  void write(WebResponse response) {
    response_ = std::move(response);
    stream_.expires_after(kRequestTime);
    http::async_write(stream_, response_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return;
      if (self->response_.keep_alive()) return self->read(kRequestTime);
      self->endSending();
    });
  }
  // From the disk, piece by piece; the connection ends with it.
  void answerFile(const WebContent& content) {
    error_code failure;
    FileResponse response{http::status::ok, request_.version()};
    response.body().open(content.file.c_str(), beast::file_mode::scan, failure);
    if (failure) return answer(errorContent(404, "the file is not there any more"));
    setCommonFields(response, content.type);
    response.set(http::field::content_disposition,
                 fmt::format("attachment; filename=\"{}\"", content.file.filename().string()));
    server_.allowOrigin(response, request_);
    response.keep_alive(false);
    response.prepare_payload();
    file_response_ = std::move(response);
    file_pieces_.emplace(*file_response_);
    file_pieces_->split(methodOf(request_) != request_.method());  // HEAD gets the header alone
    writePiece();
  }
  void writePiece() {
    stream_.expires_after(kRequestTime);
    http::async_write_some(stream_, *file_pieces_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return;
      self->server_.pool.progressed(*self->place_);
      const bool header_only = self->file_pieces_->split() && self->file_pieces_->is_header_done();
      if (header_only || self->file_pieces_->is_done()) return self->endSending();
      self->writePiece();
    });
  }
  void endSending() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  WebServer::Impl& server_;
  std::optional<ConnectionPool::Place> place_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + 64 * 1024};
  std::optional<http::request_parser<http::string_body>> parser_;
  WebRequest request_;
  WebResponse response_;
  std::optional<FileResponse> file_response_;
  std::optional<http::response_serializer<http::file_body>> file_pieces_;
};

}  // namespace

void startHttpConnection(tcp::socket socket, WebServer::Impl& server) {
  std::make_shared<HttpConnection>(std::move(socket), server)->start();
}

}  // namespace depthmocap
