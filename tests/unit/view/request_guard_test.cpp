#include "apps/view/request_guard.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

const GuardConfig kLocal{.address = "127.0.0.1", .port = 8010, .token = ""};
const GuardConfig kOpen{.address = "0.0.0.0", .port = 8010, .token = "secret"};

TEST(RequestGuard, AnswersItsOwnNames) {
  for (const char* host : {"127.0.0.1:8010", "localhost:8010"}) {
    EXPECT_EQ(refusal({.target = "/", .host = host}, kLocal), "") << host;
    EXPECT_EQ(refusal({.target = "/", .host = host, .origin = "http://" + std::string(host)}, kLocal), "") << host;
  }
}

TEST(RequestGuard, AnswersTheAddressThatItListensOn) {
  EXPECT_EQ(refusal({.target = "/", .host = "127.0.0.2:8010"}, {.address = "127.0.0.2", .port = 8010}), "");
  EXPECT_EQ(refusal({.target = "/", .host = "[::1]:8010"}, {.address = "::1", .port = 8010}), "");
}

TEST(RequestGuard, KnowsWhatCanBeAToken) {
  for (const char* token : {"secret", "a-b._~", "0123456789abcdef"}) EXPECT_TRUE(isToken(token)) << token;
  for (const char* token : {"", "two words", "a&b", "a#b", "a\nb", "ü", "a=b"}) EXPECT_FALSE(isToken(token)) << token;
  EXPECT_FALSE(isToken(std::string(129, 'x')));
}

TEST(RequestGuard, RefusesOtherNamesOnLoopback) {
  for (const char* host : {"", "[::1]:8010", "127.0.0.2:8010", "evil.example", "evil.example:8010", "localhost",
                           "localhost:80", "127.0.0.1:8010.evil"}) {
    EXPECT_NE(refusal({.target = "/", .host = host}, kLocal), "") << host;
  }
}

TEST(RequestGuard, RefusesForeignOrigins) {
  for (const char* origin : {"http://evil.example", "null", "https://localhost:8010", "http://localhost:8011"}) {
    EXPECT_NE(refusal({.target = "/stream", .host = "localhost:8010", .origin = origin}, kLocal), "") << origin;
  }
}

TEST(RequestGuard, LetsInTheOriginsThatAreNamed) {
  GuardConfig config = kLocal;
  config.allowed_origins = {"http://localhost:3000", "https://studio.example"};
  const auto from = [&](std::string_view origin) {
    return refusal({.target = "/ik", .host = "localhost:8010", .origin = origin}, config);
  };
  for (const char* origin : {"", "http://localhost:8010", "http://localhost:3000", "https://studio.example"}) {
    EXPECT_EQ(from(origin), "") << origin;
  }
  for (const char* origin :
       {"http://localhost:3001", "https://localhost:3000", "http://studio.example", "https://studio.example.evil",
        "https://evil.example", "https://studio.exampl", "null", "*"}) {
    EXPECT_NE(from(origin), "") << origin;
  }
  // Another host name is still refused: an origin that is let in is no way around it.
  EXPECT_NE(refusal({.target = "/ik", .host = "evil.example", .origin = "https://studio.example"}, config), "");
}

TEST(RequestGuard, KnowsWhatCanBeAnOrigin) {
  for (const char* origin : {"http://localhost:3000", "https://studio.example", "http://[::1]:80", "http://10.0.0.2"}) {
    EXPECT_TRUE(isOrigin(origin)) << origin;
  }
  for (const char* origin : {"", "*", "null", "localhost:3000", "http://", "http://a/", "http://a/b", "HTTP://a",
                             "http://A", "http://a b", "http://a\r\nX: y", "file://x", "https"}) {
    EXPECT_FALSE(isOrigin(origin)) << origin;
  }
  EXPECT_FALSE(isOrigin("http://" + std::string(300, 'a')));
}

TEST(RequestGuard, AsksForNoTokenInAPreflight) {
  GuardConfig config = kOpen;
  config.allowed_origins = {"https://studio.example"};
  RequestClaim claim{.target = "/ik", .host = "mocap.lan:8010", .origin = "https://studio.example"};
  EXPECT_NE(refusal(claim, config), "");
  claim.preflight = true;
  EXPECT_EQ(refusal(claim, config), "");
  claim.origin = "https://evil.example";
  EXPECT_NE(refusal(claim, config), "");
}

TEST(RequestGuard, AsksForTheToken) {
  const auto with = [](std::string_view target, std::string_view authorization) {
    return refusal({.target = target, .host = "mocap.lan:8010", .authorization = authorization}, kOpen);
  };
  EXPECT_EQ(with("/?token=secret", ""), "");
  EXPECT_EQ(with("/?a=b&token=secret&c=d", ""), "");
  EXPECT_EQ(with("/", "Bearer secret"), "");
  for (const char* target :
       {"/", "/?token=", "/?token=secre", "/?token=secretx", "/?xtoken=secret", "/?token", "/?&&"}) {
    EXPECT_NE(with(target, ""), "") << target;
  }
  EXPECT_NE(with("/", "Basic secret"), "");
}

TEST(RequestGuard, KnowsLoopback) {
  EXPECT_TRUE(isLoopback("127.0.0.1"));
  EXPECT_TRUE(isLoopback("127.3.0.1"));
  EXPECT_TRUE(isLoopback("::1"));
  EXPECT_FALSE(isLoopback("0.0.0.0"));
  EXPECT_FALSE(isLoopback("192.168.1.5"));
}

}  // namespace
}  // namespace depthmocap
