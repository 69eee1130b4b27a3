#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

namespace depthmocap {

// One connection to a server of this machine that sends this and no more; ends when the server has answered.
inline std::string askedOnce(std::uint16_t port, std::string_view bytes) {
  std::string all;
  const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(client, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0) {
    (void)::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ::shutdown(client, SHUT_WR);
    char answer[4096];
    for (ssize_t got = 0; (got = ::recv(client, answer, sizeof answer, 0)) > 0;) {
      all.append(answer, static_cast<std::size_t>(got));
    }
  }
  ::close(client);
  return all;
}

// What opens /stream as a WebSocket.
inline std::string webSocketHandshake(const std::string& host) {
  return "GET /stream HTTP/1.1\r\nHost: " + host +
         "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

}  // namespace depthmocap
