#include "libtracker/classify/part_classifier.h"

namespace depthmocap {

std::vector<ConfigField> ClassifyConfig::fields() {
  return {
      {"stride", &stride, "px", atLeast(1),
       "Every stride-th pixel in x and y is classified, at a focal length of 525 px"},
      {"simd", &simd, "", kAnyNumber, "Use the vector instructions of the processor; the result is the same"},
  };
}

void ClassifyConfig::validate() const {
  checkFieldsOf("ClassifyConfig", *this);
  checkConfig(threads >= 1, "ClassifyConfig", "threads", threads, "at least 1");
}

}  // namespace depthmocap
