#include "tests/drivers/served_recording.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

namespace depthmocap::testdriver {

ServedRecording readServedRecording(const std::string& folder) {
  ServedRecording recording;
  std::ifstream header_file(folder + "/recording.json");
  std::ifstream index(folder + "/frames.csv");
  if (!header_file || !index) return recording;
  const auto header = nlohmann::json::parse(header_file);
  recording.width = header.at("width");
  recording.height = header.at("height");
  recording.fx = header.at("intrinsics").at("fx");
  recording.fy = header.at("intrinsics").at("fy");
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    const cv::Mat image = cv::imread(folder + "/" + line.substr(second + 1), cv::IMREAD_UNCHANGED);
    if (image.type() != CV_16UC1) continue;
    ServedRecording::Frame frame;
    frame.time_us = static_cast<std::uint64_t>(std::llround(std::stod(line.substr(first + 1)) * 1e6));
    frame.steps.assign(image.ptr<std::uint16_t>(), image.ptr<std::uint16_t>() + image.total());
    recording.frames.push_back(std::move(frame));
  }
  return recording;
}

Faults parseFaults(const std::string& text) {
  Faults faults;
  std::istringstream words(text);
  std::string word;
  while (std::getline(words, word, ',')) {
    std::istringstream fields(word);
    std::string name;
    std::string first;
    std::string second;
    std::getline(fields, name, ':');
    std::getline(fields, first, ':');
    std::getline(fields, second, ':');
    const int a = std::atoi(first.c_str());
    const int b = std::atoi(second.c_str());
    if (name == "drop") faults.drop_every = a;
    if (name == "stall") faults.stall_after = a, faults.stall_ms = b;
    if (name == "unplug") faults.unplug_after = a, faults.unplug_ms = b;
    if (name == "mirror") faults.stuck_mirror = true;
  }
  return faults;
}

}  // namespace depthmocap::testdriver
