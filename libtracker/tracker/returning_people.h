#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// Who left, so that whoever comes gets the number of the one he is most like, by height and place; who is like nobody
// gets a number that nobody had. Numbers count from 0 here. The segmentation knows people by places of its own, which
// stay theirs: a number is given by the place that it stands for.
class ReturningPeople {
 public:
  ReturningPeople(std::size_t people, const CameraModel& camera);

  // The place in the segmentation, of the present frame, of the person who has this number.
  [[nodiscard]] std::size_t placeOf(std::size_t number) const { return places_[number]; }
  // Gives those who are new in `seen` the numbers that suit them. `expected`, by place: empty where somebody new may
  // be.
  void assign(const ExpectedPeople& expected, const Segmentation& seen, const DepthImage& depth);
  // The person of this number was tracked.
  void observe(std::size_t number, const Segmentation& seen, const DepthImage& depth);
  // Nobody is remembered.
  void forget();

 private:
  // How somebody looked.
  struct Look {
    Eigen::Vector3d p_camera = Eigen::Vector3d::Zero();  // [m]
    std::optional<double> top_m;                         // of the head above the floor, where that is in view
  };
  struct Known {
    Look look;        // with the mean height
    int heights = 0;  // [frames] in that mean
  };

  [[nodiscard]] Look lookOf(const PersonRegion& region, const Segmentation& seen, const DepthImage& depth) const;
  [[nodiscard]] double unlikeness(std::size_t number, const Look& look) const;

  CameraModel camera_;
  std::vector<std::size_t> places_;          // one per number
  std::vector<std::optional<Known>> known_;  // likewise
  std::vector<std::size_t> free_;            // numbers that may be given
  std::vector<std::size_t> new_;             // places of those who are new
};

}  // namespace depthmocap
