#include "libtracker/sensor/sensor_clock_map.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

SensorClock::time_point at(double s) {
  return SensorClock::time_point(std::chrono::duration_cast<SensorClock::duration>(std::chrono::duration<double>(s)));
}

double delay_ms(SensorClockMap& map, double sensor_s, double arrived_s) {
  return std::chrono::duration<double, std::milli>(at(arrived_s) - map.taken(sensor_s, at(arrived_s))).count();
}

TEST(SensorClockMap, SeesDelayAboveTheShortestWay) {
  SensorClockMap map;
  EXPECT_NEAR(delay_ms(map, 0.000, 100.010), 0, 1e-3);
  EXPECT_NEAR(delay_ms(map, 0.033, 100.048), 5, 0.01);
  EXPECT_NEAR(delay_ms(map, 0.067, 100.072), 0, 1e-3);  // a shorter way than any before
  EXPECT_NEAR(delay_ms(map, 0.100, 100.115), 10, 0.01);
}

TEST(SensorClockMap, FollowsAClockThatDrifts) {
  SensorClockMap map;
  double worst_ms = 0;
  for (int i = 0; i < 30 * 3600; ++i) {
    const double sensor_s = i / 30.0;
    worst_ms = std::max(worst_ms, delay_ms(map, sensor_s * (1 - 5e-5), 100 + sensor_s));
  }
  EXPECT_LT(worst_ms, 0.1);
}

}  // namespace
}  // namespace depthmocap
