#include "apps/view/request_guard.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

const GuardConfig kLocal{.loopback = true, .port = 8010, .token = ""};
const GuardConfig kOpen{.loopback = false, .port = 8010, .token = "secret"};

TEST(RequestGuard, AnswersItsOwnNames) {
  for (const char* host : {"127.0.0.1:8010", "localhost:8010", "[::1]:8010"}) {
    EXPECT_EQ(refusal({.target = "/", .host = host}, kLocal), "") << host;
    EXPECT_EQ(refusal({.target = "/", .host = host, .origin = "http://" + std::string(host)}, kLocal), "") << host;
  }
}

TEST(RequestGuard, RefusesOtherNamesOnLoopback) {
  for (const char* host :
       {"", "evil.example", "evil.example:8010", "localhost", "localhost:80", "127.0.0.1:8010.evil"}) {
    EXPECT_NE(refusal({.target = "/", .host = host}, kLocal), "") << host;
  }
}

TEST(RequestGuard, RefusesForeignOrigins) {
  for (const char* origin : {"http://evil.example", "null", "https://localhost:8010", "http://localhost:8011"}) {
    EXPECT_NE(refusal({.target = "/stream", .host = "localhost:8010", .origin = origin}, kLocal), "") << origin;
  }
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
