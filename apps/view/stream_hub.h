#pragma once
#include <atomic>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace depthmocap {

class StreamClient;

// The clients of /stream, of whom there are at most so many: a newcomer takes the place of the one that was not heard
// of for longest. Used on the server's thread, but for count() and frameWanted().
class StreamHub {
 public:
  int most = 1;                                                 // (>= 1) clients at a time
  std::function<std::string(const std::string& text)> on_text;  // the answer, if any, goes to that client
  std::function<std::string()> greeting;                        // what every client is sent first

  void sendFrame(const std::shared_ptr<const std::string>& frame);
  void sendText(const std::string& text);
  void clear() { clients_.clear(); }
  // Any thread.
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] bool frameWanted() const { return wanted_; }

  // For clients.
  void join(const std::shared_ptr<StreamClient>& client);
  void leave(const std::shared_ptr<StreamClient>& client);
  void updateWanted();

 private:
  std::set<std::shared_ptr<StreamClient>> clients_;
  std::atomic<int> count_{0};
  std::atomic<bool> wanted_{false};
};

// Answers the request for an upgrade; from then on the connection is a client of the hub, which outlives it.
void startStream(boost::beast::tcp_stream connection, StreamHub& hub,
                 const boost::beast::http::request<boost::beast::http::string_body>& request);

}  // namespace depthmocap
