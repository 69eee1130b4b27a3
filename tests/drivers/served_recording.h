#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace depthmocap::testdriver {

// A recording in memory as a device would hold it. Read here without the library under test.
struct ServedRecording {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  struct Frame {
    std::uint64_t time_us = 0;
    std::vector<std::uint16_t> steps;  // row-major
  };
  std::vector<Frame> frames;
};

// Empty frames if the folder cannot be read.
ServedRecording readServedRecording(const std::string& folder);

// What shall go wrong, from a text like "drop:10,stall:30:1500,unplug:40:300,mirror".
struct Faults {
  int drop_every = 0;   // of this many frames one never leaves the device; 0 = none
  int stall_after = 0;  // frames, once; then nothing comes for stall_ms
  int stall_ms = 0;
  int unplug_after = 0;  // frames, each time it is plugged in; then it is away for unplug_ms
  int unplug_ms = 0;
  bool stuck_mirror = false;  // mirrors, whatever it is told
};

Faults parseFaults(const std::string& text);

}  // namespace depthmocap::testdriver
