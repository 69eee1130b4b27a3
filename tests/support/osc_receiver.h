#pragma once
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace depthmocap {

// A receiver by the specification of OSC 1.0, on a UDP socket of its own; nothing of the sender's library.
struct OscMessage {
  std::string address;
  std::string types;
  std::string text;           // the first string argument
  std::vector<float> floats;  // in order
  std::vector<int> ints;
};

class OscReceiver {
 public:
  OscReceiver() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in any{};
    any.sin_family = AF_INET;
    any.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&any), sizeof any), 0);
    socklen_t size = sizeof any;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&any), &size);
    port_ = ntohs(any.sin_port);
    const timeval wait{2, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  }
  ~OscReceiver() { ::close(socket_); }
  OscReceiver(const OscReceiver&) = delete;
  OscReceiver& operator=(const OscReceiver&) = delete;

  [[nodiscard]] std::string target() const { return "127.0.0.1:" + std::to_string(port_); }
  // The messages of one bundle.
  std::vector<OscMessage> receive() {
    std::array<char, 4096> buffer{};
    const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), 0);
    EXPECT_GT(size, 16) << "nothing came";
    EXPECT_LT(size, 1500);
    packet_.assign(buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
    EXPECT_EQ(packet_.substr(0, 8), std::string("#bundle\0", 8));
    std::vector<OscMessage> messages;
    for (at_ = 16; at_ < packet_.size();) {
      const std::size_t end = at_ + 4 + integer(at_);
      at_ += 4;
      messages.push_back(message());
      EXPECT_EQ(at_, end);
    }
    return messages;
  }

 private:
  std::uint32_t integer(std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, packet_.data() + at, 4);
    return ntohl(value);
  }
  std::string text() {
    std::string result(packet_.c_str() + at_);
    at_ += (result.size() / 4 + 1) * 4;
    return result;
  }
  OscMessage message() {
    OscMessage m;
    m.address = text();
    m.types = text();
    for (const char type : m.types.substr(1)) {
      if (type == 's') {
        m.text = text();
        continue;
      }
      const std::uint32_t bits = integer(at_);
      at_ += 4;
      if (type == 'i') m.ints.push_back(static_cast<int>(bits));
      if (type == 'f') {
        float value = 0;
        std::memcpy(&value, &bits, 4);
        m.floats.push_back(value);
      }
    }
    return m;
  }

  int socket_;
  int port_ = 0;
  std::string packet_;
  std::size_t at_ = 0;
};

}  // namespace depthmocap
