#include "apps/view/stream_hub.h"

#include <algorithm>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <utility>

namespace depthmocap {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Request = beast::http::request<beast::http::string_body>;

constexpr std::size_t kMaxMessageBytes = 4 * 1024;  // of a client
constexpr std::size_t kMaxWaitingTexts = 32;        // per client
constexpr std::chrono::seconds kHandshakeTime{5};
constexpr std::chrono::seconds kSilentTime{60};  // a client that does not even answer a ping for so long is gone
constexpr const char* kReady = "ready";
constexpr int kMaxUnconfirmed = 2;

}  // namespace

// One client of /stream. All members are used on the server's thread.
class StreamClient : public std::enable_shared_from_this<StreamClient> {
 public:
  StreamClient(beast::tcp_stream stream, StreamHub& hub) : socket_(std::move(stream)), hub_(hub) {}

  void run(const Request& request) {
    socket_.set_option(websocket::stream_base::timeout{kHandshakeTime, kSilentTime, true});
    socket_.read_message_max(kMaxMessageBytes);
    socket_.control_callback([this](websocket::frame_type, beast::string_view) { heard(); });
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
  [[nodiscard]] std::chrono::steady_clock::time_point lastHeard() const { return last_heard_; }
  [[nodiscard]] bool waitsForFrame() const { return frame_ == nullptr && hasCredit(); }
  void close() {
    hub_.leave(shared_from_this());
    beast::get_lowest_layer(socket_).close();
  }

  // Frames on their way wait in the buffers of the system and the browser, where they only grow old.
  [[nodiscard]] bool hasCredit() const { return !confirms_ || unconfirmed_ < kMaxUnconfirmed; }

 private:
  void heard() { last_heard_ = std::chrono::steady_clock::now(); }
  void joined() {
    hub_.join(shared_from_this());
    if (hub_.greeting) text(hub_.greeting());
    read();
  }
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](error_code failure, std::size_t) {
      if (failure) return self->close();
      self->received();
    });
  }
  void received() {
    heard();
    const bool is_text = socket_.got_text();
    const std::string message = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (is_text && message == kReady) {
      confirms_ = true;
      unconfirmed_ = std::max(0, unconfirmed_ - 1);
      hub_.updateWanted();
    } else if (is_text && hub_.on_text) {
      const std::string answer = hub_.on_text(message);
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
    hub_.updateWanted();
    socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](error_code failure, std::size_t) {
      self->writing_ = nullptr;
      if (failure) return self->close();
      self->write();
    });
  }

  websocket::stream<beast::tcp_stream> socket_;
  StreamHub& hub_;
  std::chrono::steady_clock::time_point last_heard_ = std::chrono::steady_clock::now();
  beast::flat_buffer buffer_;
  bool confirms_ = false;  // the client says "ready" for each frame that it is done with
  int unconfirmed_ = 0;    // frames that were sent and not confirmed
  std::shared_ptr<const std::string> writing_;
  std::shared_ptr<const std::string> frame_;
  std::deque<std::shared_ptr<const std::string>> texts_;
};

void StreamHub::sendFrame(const std::shared_ptr<const std::string>& frame) {
  // A copy: a client that fails leaves the set.
  const auto clients = clients_;
  for (const auto& client : clients) client->frame(frame);
  updateWanted();
}

void StreamHub::sendText(const std::string& text) {
  const auto clients = clients_;
  for (const auto& client : clients) client->text(text);
}

void StreamHub::join(const std::shared_ptr<StreamClient>& client) {
  if (count_ >= most) {
    const auto earlier = [](const auto& a, const auto& b) { return a->lastHeard() < b->lastHeard(); };
    const std::shared_ptr<StreamClient> quietest = *std::ranges::min_element(clients_, earlier);
    quietest->close();
  }
  clients_.insert(client);
  count_ = static_cast<int>(clients_.size());
  updateWanted();
}

void StreamHub::leave(const std::shared_ptr<StreamClient>& client) {
  clients_.erase(client);
  count_ = static_cast<int>(clients_.size());
  updateWanted();
}

void StreamHub::updateWanted() {
  wanted_ = std::any_of(clients_.begin(), clients_.end(), [](const auto& client) { return client->waitsForFrame(); });
}

void startStream(beast::tcp_stream connection, StreamHub& hub, const Request& request) {
  std::make_shared<StreamClient>(std::move(connection), hub)->run(request);
}

}  // namespace depthmocap
