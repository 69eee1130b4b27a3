#include "apps/view/connection_pool.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

class ConnectionPoolTest : public testing::Test {
 protected:
  ConnectionPool::Place enter(const std::string& address, const std::string& name) {
    return pool_.enter({address, [this, name] { closed_.push_back(name); }});
  }
  ConnectionPool pool_{4};
  std::vector<std::string> closed_;
};

TEST_F(ConnectionPoolTest, OneAddressTakesPlacesFromItself) {
  enter("a", "a1");
  enter("b", "b1");
  enter("a", "a2");
  EXPECT_TRUE(closed_.empty());
  enter("a", "a3");
  EXPECT_EQ(closed_, std::vector<std::string>{"a1"});
}

TEST_F(ConnectionPoolTest, TheSlowestOfAllMakesRoomForANewAddress) {
  const auto a = enter("a", "a1");
  for (const char* address : {"b", "c", "d"}) enter(address, address);
  pool_.progressed(a);
  enter("e", "e1");
  EXPECT_EQ(closed_, std::vector<std::string>{"b"});
  EXPECT_TRUE(pool_.closeSlowest());
  EXPECT_EQ(closed_.back(), "c");
}

TEST_F(ConnectionPoolTest, APlaceThatIsLeftIsFree) {
  pool_.leave(enter("a", "a1"));
  EXPECT_FALSE(pool_.closeSlowest());
  EXPECT_TRUE(closed_.empty());
}

}  // namespace
}  // namespace depthmocap
