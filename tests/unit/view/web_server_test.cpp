#include "apps/view/web_server.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "tests/support/connection.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

class RunningServer : public testing::Test {
 protected:
  void SetUp() override { start({.port = 0}); }
  void start(WebServerConfig config) {
    server_ = std::make_unique<WebServer>(std::move(config));
    server_->serveFile("/", {"text/html", "<p>page</p>"});
    server_->onPost("/echo", [](const std::string& body) {
      if (body == "bad") throw Error("is bad", "body");
      return WebContent{"text/plain", body};
    });
    server_->onPostAside("/slow", [this](const std::string& body) {
      if (body == "bad") throw Error("is bad", "body");
      for (int i = 0; i < 500 && !may_end_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return WebContent{"text/plain", "slow " + body};
    });
    server_->onGetAside("/file", [this](const std::string& target) {
      if (target != "/file?name=take") throw Error("is not there", target);
      WebContent content{"application/octet-stream", ""};
      content.file = folder_ / "take.bvh";
      return content;
    });
    server_->onText([](const std::string& text) { return "got " + text; });
    server_->setGreeting([] { return std::string("hello"); });
    server_->start();
  }
  [[nodiscard]] std::string host() const { return "127.0.0.1:" + std::to_string(server_->port()); }
  [[nodiscard]] std::string ask(const std::string& method, const std::string& path, const std::string& headers = "",
                                const std::string& body = "") const {
    const Connection connection(server_->port());
    connection.send(method + " " + path + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" + headers +
                    (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" + body);
    return connection.receive(1 << 20);
  }
  // A WebSocket connection after its handshake; `answer` is the first line.
  [[nodiscard]] std::unique_ptr<Connection> stream(std::string& answer, const std::string& headers = "") const {
    auto connection = std::make_unique<Connection>(server_->port());
    connection->send("GET /stream HTTP/1.1\r\nHost: " + host() +
                     "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                     headers + "\r\n");
    const std::string bytes = connection->receive(10);
    answer = bytes.substr(0, bytes.find('\r'));
    return connection;
  }
  void waitForClients(int count) const {
    for (int i = 0; i < 300 && server_->clients() != count; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(server_->clients(), count);
  }
  // Still well after what a test did to it.
  ~RunningServer() override { EXPECT_NE(ask("GET", "/").find("<p>page</p>"), std::string::npos); }

  TemporaryFolder folder_;
  std::atomic<bool> may_end_{false};
  std::unique_ptr<WebServer> server_;
};

// A client's text frame (RFC 6455), masked.
std::string textFrame(const std::string& text) {
  std::string frame = "\x81";
  frame += static_cast<char>(0x80 | text.size());
  frame += std::string(4, '\0');  // a mask of zeros
  return frame + text;
}

TEST_F(RunningServer, AnswersAndRefuses) {
  EXPECT_EQ(ask("GET", "/").rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_EQ(ask("GET", "/../../etc/passwd").rfind("HTTP/1.1 404", 0), 0U);
  EXPECT_EQ(ask("DELETE", "/").rfind("HTTP/1.1 405", 0), 0U);
  EXPECT_EQ(ask("GET", "/", "Origin: http://evil.example\r\n").rfind("HTTP/1.1 403", 0), 0U);
  const std::string echoed = ask("POST", "/echo", "", "some text");
  EXPECT_NE(echoed.find("some text"), std::string::npos);
  const std::string bad = ask("POST", "/echo", "", "bad");
  EXPECT_EQ(bad.rfind("HTTP/1.1 400", 0), 0U);
  EXPECT_NE(bad.find(R"({"error":"body: is bad"})"), std::string::npos) << bad;
}

TEST_F(RunningServer, AnswersOthersWhileASlowHandlerWorks) {
  const Connection slow(server_->port());
  slow.send("POST /slow HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\nContent-Length: 4\r\n\r\nwork");
  EXPECT_NE(ask("GET", "/").find("<p>page</p>"), std::string::npos);
  EXPECT_NE(ask("POST", "/echo", "", "some text").find("some text"), std::string::npos);
  may_end_ = true;
  EXPECT_NE(slow.receive(1 << 20).find("slow work"), std::string::npos);
  EXPECT_EQ(ask("POST", "/slow", "", "bad").rfind("HTTP/1.1 400", 0), 0U);
  EXPECT_EQ(ask("POST", "/slow", "Origin: http://evil.example\r\n", "x").rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(ask("GET", "/slow").rfind("HTTP/1.1 405", 0), 0U);
}

TEST_F(RunningServer, SendsFiles) {
  const std::string bytes(3'000'000, 'x');
  writeBytes(folder_ / "take.bvh", bytes);
  const Connection connection(server_->port());
  connection.send("GET /file?name=take HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
  const std::string answer = connection.receive(bytes.size() + 10000);
  EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_NE(answer.find("Content-Disposition: attachment; filename=\"take.bvh\"\r\n"), std::string::npos);
  EXPECT_EQ(answer.substr(answer.find("\r\n\r\n") + 4), bytes);
  const std::string head = ask("HEAD", "/file?name=take");
  EXPECT_NE(head.find("Content-Length: 3000000\r\n"), std::string::npos) << head;
  EXPECT_EQ(head.find("xxx"), std::string::npos);
  const std::string other = ask("GET", "/file?name=../take.bvh");
  EXPECT_EQ(other.rfind("HTTP/1.1 400", 0), 0U) << other;
  std::filesystem::remove(folder_ / "take.bvh");
  EXPECT_EQ(ask("GET", "/file?name=take").rfind("HTTP/1.1 404", 0), 0U);
  EXPECT_EQ(ask("POST", "/file?name=take").rfind("HTTP/1.1 405", 0), 0U);
}

// Clients that ask for a file and never read it, and those that go while it is sent.
TEST_F(RunningServer, OutlivesThoseWhoLeaveFilesUnread) {
  writeBytes(folder_ / "take.bvh", std::string(20'000'000, 'x'));
  std::vector<std::unique_ptr<Connection>> idle;
  for (int i = 0; i < 40; ++i) {
    idle.push_back(std::make_unique<Connection>(server_->port()));
    idle.back()->send("GET /file?name=take HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
    if (i % 2 == 0) idle.back().reset();
  }
  EXPECT_NE(ask("GET", "/").find("<p>page</p>"), std::string::npos);
}

TEST_F(RunningServer, EndsWhileASlowHandlerWorks) {
  const Connection slow(server_->port());
  slow.send("POST /slow HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 4\r\n\r\nwork");
  EXPECT_NE(ask("GET", "/").find("<p>page</p>"), std::string::npos);
  may_end_ = true;
  server_.reset();
  start({.port = 0});
}

constexpr const char* kOrigin = "Origin: http://localhost:3000\r\n";

TEST_F(RunningServer, KeepsOtherOriginsOutUnlessTheyAreNamed) {
  EXPECT_EQ(ask("POST", "/echo", kOrigin, "x").rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(ask("OPTIONS", "/echo", std::string(kOrigin) + "Access-Control-Request-Method: POST\r\n")
                .rfind("HTTP/1.1 403", 0),
            0U);
  EXPECT_EQ(ask("POST", "/echo", "", "x").find("Access-Control"), std::string::npos);
}

TEST_F(RunningServer, LetsPagesOfANamedOriginReadItsAnswers) {
  server_.reset();
  start({.port = 0, .allowed_origins = {"http://localhost:3000"}});
  const std::string allowed = "Access-Control-Allow-Origin: http://localhost:3000\r\n";
  const std::string answer = ask("POST", "/echo", kOrigin, "some text");
  EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_NE(answer.find(allowed), std::string::npos) << answer;
  EXPECT_NE(answer.find("Vary: Origin\r\n"), std::string::npos) << answer;
  // What went wrong is to be read by the page, too; also what a worker answers.
  EXPECT_NE(ask("POST", "/echo", kOrigin, "bad").find(allowed), std::string::npos);
  may_end_ = true;
  EXPECT_NE(ask("POST", "/slow", kOrigin, "work").find(allowed), std::string::npos);
  EXPECT_EQ(ask("POST", "/echo", "", "x").find("Access-Control-Allow-Origin"), std::string::npos);
  const std::string other = ask("POST", "/echo", "Origin: http://evil.example\r\n", "x");
  EXPECT_EQ(other.rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(other.find("Access-Control-Allow-Origin"), std::string::npos);
}

TEST_F(RunningServer, AnswersThePreflightOfANamedOrigin) {
  server_.reset();
  start({.port = 0, .token = "secret", .allowed_origins = {"http://localhost:3000"}});
  const std::string asks = "Access-Control-Request-Method: POST\r\nAccess-Control-Request-Headers: content-type\r\n";
  const std::string answer = ask("OPTIONS", "/echo", kOrigin + asks);
  EXPECT_EQ(answer.rfind("HTTP/1.1 204", 0), 0U) << answer;
  EXPECT_NE(answer.find("Access-Control-Allow-Methods: GET, HEAD, POST\r\n"), std::string::npos) << answer;
  EXPECT_NE(answer.find("Access-Control-Allow-Headers: authorization, content-type\r\n"), std::string::npos);
  EXPECT_EQ(answer.find("Private-Network"), std::string::npos);
  EXPECT_NE(ask("OPTIONS", "/echo", kOrigin + asks + "Access-Control-Request-Private-Network: true\r\n")
                .find("Access-Control-Allow-Private-Network: true\r\n"),
            std::string::npos);
  // The preflight needs no token, what follows does.
  EXPECT_EQ(ask("POST", "/echo", kOrigin, "x").rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(ask("OPTIONS", "/echo", "Origin: http://evil.example\r\n" + asks).rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_EQ(ask("OPTIONS", "/echo?token=secret").rfind("HTTP/1.1 405", 0), 0U);
  server_.reset();
  start({.port = 0});
}

TEST_F(RunningServer, TakesNoOriginThatIsNone) {
  const std::string error = errorOf([] { const WebServer server({.port = 0, .allowed_origins = {"*"}}); });
  EXPECT_NE(error.find("is no origin of a page"), std::string::npos) << error;
}

TEST_F(RunningServer, AnswersSeveralSlowRequestsAtOnce) {
  std::atomic<int> inside{0};
  server_.reset();
  server_ = std::make_unique<WebServer>(WebServerConfig{.port = 0, .workers = 2});
  server_->serveFile("/", {"text/html", "<p>page</p>"});
  server_->onPostAside("/meet", [&](const std::string&) {
    ++inside;
    for (int i = 0; i < 500 && inside < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return WebContent{"text/plain", inside == 2 ? "both" : "alone"};
  });
  server_->start();
  const Connection first(server_->port());
  first.send("POST /meet HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\nContent-Length: 1\r\n\r\nx");
  EXPECT_NE(ask("POST", "/meet", "", "x").find("both"), std::string::npos);
  EXPECT_NE(first.receive(1 << 20).find("both"), std::string::npos);
}

TEST_F(RunningServer, BoundsWhatIsSent) {
  EXPECT_EQ(ask("POST", "/echo", "", std::string(100000, 'x')).rfind("HTTP/1.1 413", 0), 0U);
  EXPECT_EQ(ask("GET", "/", "X: " + std::string(20000, 'x') + "\r\n").rfind("HTTP/1.1 413", 0), 0U);
  const Connection connection(server_->port());
  connection.send("POST /echo HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 99999999999\r\n\r\n");
  EXPECT_EQ(connection.receive(12).rfind("HTTP/1.1 413", 0), 0U);
}

TEST_F(RunningServer, SurvivesGarbage) {
  Random random(9);
  for (int i = 0; i < 40; ++i) {
    std::string garbage;
    for (int k = 0; k < 200; ++k) garbage += static_cast<char>(random.below(256));
    const Connection connection(server_->port());
    connection.send(i % 2 == 0 ? garbage : "GET / HTTP/1.1\r\n" + garbage + "\r\n\r\n");
  }
}

TEST_F(RunningServer, StreamGreetsAnswersAndSendsFrames) {
  std::string answer;
  const auto client = stream(answer);
  EXPECT_EQ(answer, "HTTP/1.1 101 Switching Protocols");
  waitForClients(1);
  client->send(textFrame("play"));
  std::string bytes = client->receive(7 + 10);
  EXPECT_NE(bytes.find("got play"), std::string::npos) << bytes;
  EXPECT_TRUE(server_->frameWanted());
  server_->sendFrame(std::make_shared<const std::string>("FRAME"));
  EXPECT_NE(client->receive(7).find("FRAME"), std::string::npos);
}

TEST_F(RunningServer, StreamRefusesForeignPages) {
  std::string answer;
  const auto client = stream(answer, "Origin: http://evil.example\r\n");
  EXPECT_EQ(answer, "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(server_->clients(), 0);
}

TEST_F(RunningServer, StreamEndsOnLongOrDamagedMessages) {
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    std::string answer;
    const auto client = stream(answer);
    std::string garbage = "\x82\xff" + std::string(8, '\x01');  // a binary message of 72 petabytes
    if (i > 0) garbage.clear();
    for (int k = 0; k < 100; ++k) garbage += static_cast<char>(random.below(256));
    client->send(garbage);
    client->receive(1 << 20);
  }
  waitForClients(0);
}

TEST_F(RunningServer, StalledClientHoldsTwoFramesAndNobodyElseUp) {
  std::string answer;
  const auto stalled = stream(answer);
  const auto reader = stream(answer);
  waitForClients(2);
  const auto frame = std::make_shared<const std::string>(std::string(200000, 'f'));
  const auto start = std::chrono::steady_clock::now();
  std::size_t received = 0;
  for (int i = 0; i < 100; ++i) {
    server_->sendFrame(frame);
    received += reader->receive(frame->size()).size();
  }
  EXPECT_GE(received, 100 * frame->size());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
  // In the test, in the hands of the stalled client's socket, and waiting for it; not a hundred.
  EXPECT_LE(frame.use_count(), 5);
}

TEST_F(RunningServer, ClientThatConfirmsGetsTwoFramesAtATime) {
  std::string answer;
  const auto client = stream(answer);
  waitForClients(1);
  const std::size_t size = 2 + 5;
  const auto send = [&] {
    server_->sendFrame(std::make_shared<const std::string>("FRAME"));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  send();
  client->receive(size);
  client->send(textFrame("ready"));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  for (int i = 0; i < 5; ++i) send();
  const std::string two = client->receive(3 * size);  // no third comes
  EXPECT_EQ(two.find("FRAME", two.find("FRAME", two.find("FRAME") + 1) + 1), std::string::npos);
  EXPECT_FALSE(server_->frameWanted());
  client->send(textFrame("ready"));
  for (int i = 0; i < 300 && !server_->frameWanted(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  send();
  EXPECT_NE(client->receive(size).find("FRAME"), std::string::npos);
}

TEST_F(RunningServer, AnswersWhateverSlowConnectionsHold) {
  std::vector<std::unique_ptr<Connection>> slow;
  for (int i = 0; i < 100; ++i) {
    slow.push_back(std::make_unique<Connection>(server_->port()));
    if (i % 2 == 0) slow.back()->send("POST /echo HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 9\r\n\r\nx");
  }
  for (int i = 0; i < 20; ++i) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(ask("GET", "/").rfind("HTTP/1.1 200", 0), 0U) << i;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100)) << i;
  }
}

TEST_F(RunningServer, AnswersWhoeverHasTheToken) {
  server_.reset();
  start({.port = 0, .token = "secret"});
  std::vector<std::unique_ptr<Connection>> strangers;
  for (int i = 0; i < 70; ++i) strangers.push_back(std::make_unique<Connection>(server_->port()));
  EXPECT_EQ(ask("GET", "/?token=secret").rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_EQ(ask("GET", "/").rfind("HTTP/1.1 403", 0), 0U);
  server_.reset();
  start({.port = 0});
}

TEST_F(RunningServer, ClosesWhoSendsNoHeader) {
  const Connection silent(server_->port());
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 8 && std::chrono::steady_clock::now() - start < std::chrono::seconds(7); ++i) silent.receive(1);
  silent.send("GET / HTTP/1.1\r\nHost: " + host() + "\r\n\r\n");
  EXPECT_EQ(silent.receive(1), "");
}

TEST_F(RunningServer, TheQuietestStreamMakesRoomForANewOne) {
  server_.reset();
  start({.port = 0, .max_streams = 3});
  std::vector<std::unique_ptr<Connection>> clients;
  std::string answer;
  for (int i = 0; i < 3; ++i) clients.push_back(stream(answer));
  waitForClients(3);
  clients[0]->send(textFrame("play"));  // so that the second was silent for longest
  clients[0]->receive(7 + 10);
  clients.push_back(stream(answer));
  EXPECT_EQ(answer, "HTTP/1.1 101 Switching Protocols");
  EXPECT_EQ(ask("GET", "/").rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_EQ(server_->clients(), 3);
  server_->sendFrame(std::make_shared<const std::string>("FRAME"));
  EXPECT_NE(clients[0]->receive(7).find("FRAME"), std::string::npos);
  EXPECT_EQ(clients[1]->receive(1 << 20).find("FRAME"), std::string::npos);
  EXPECT_NE(clients[3]->receive(7 + 7).find("FRAME"), std::string::npos);
  clients.clear();
  waitForClients(0);
}

TEST_F(RunningServer, AnswersHeadWithoutABody) {
  const std::string answer = ask("HEAD", "/");
  EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), 0U);
  EXPECT_NE(answer.find("Content-Length: 11"), std::string::npos);
  EXPECT_EQ(answer.find("<p>"), std::string::npos);
  EXPECT_EQ(ask("HEAD", "/none").rfind("HTTP/1.1 404", 0), 0U);
}

TEST_F(RunningServer, TellsToGoOnBeforeABody) {
  const Connection connection(server_->port());
  connection.send("POST /echo HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" +
                  "Expect: 100-continue\r\nContent-Length: 9\r\n\r\n");
  EXPECT_EQ(connection.receive(25), "HTTP/1.1 100 Continue\r\n\r\n");
  connection.send("some text");
  EXPECT_NE(connection.receive(1 << 20).find("some text"), std::string::npos);
}

// What a proxy and we may take for different hosts.
TEST_F(RunningServer, RefusesAHeaderFieldTwice) {
  EXPECT_EQ(ask("GET", "/", "Host: evil.example\r\n").rfind("HTTP/1.1 400", 0), 0U);
  EXPECT_EQ(
      ask("GET", "/", "Origin: http://" + host() + "\r\nOrigin: http://evil.example\r\n").rfind("HTTP/1.1 400", 0), 0U);
}

// A body is not worth waiting for where the header is refused.
TEST_F(RunningServer, RefusesByTheHeaderAlone) {
  const Connection connection(server_->port());
  connection.send("POST /echo HTTP/1.1\r\nHost: evil.example\r\nContent-Length: 60000\r\n\r\n");
  EXPECT_EQ(connection.receive(12).rfind("HTTP/1.1 403", 0), 0U);
}

TEST(WebServer, PrintsAnAddressThatItAnswers) {
  WebServer server({.address = "127.0.0.2", .port = 0});
  EXPECT_EQ(server.url(), "http://127.0.0.2:" + std::to_string(server.port()) + "/");
  EXPECT_NE(errorOf([] { WebServer other({.port = 0, .token = "two words"}); }).find("token must be"),
            std::string::npos);
}

TEST(WebServer, OtherAddressesNeedAToken) {
  EXPECT_NE(errorOf([] { WebServer server({.address = "0.0.0.0", .port = 0}); }).find("token"), std::string::npos);
  EXPECT_NE(errorOf([] { WebServer server({.address = "example", .port = 0}); }).find("numeric"), std::string::npos);
  WebServer server({.address = "0.0.0.0", .port = 0, .token = "secret"});
  EXPECT_NE(server.url().find("?token=secret"), std::string::npos);
  EXPECT_NE(errorOf([&] { WebServer other({.port = server.port()}); }).find("cannot be listened on"),
            std::string::npos);
  EXPECT_EQ(randomToken().size(), 32U);
  EXPECT_NE(randomToken(), randomToken());
}

}  // namespace
}  // namespace depthmocap
