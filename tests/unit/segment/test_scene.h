#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/core/random.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// Ray-cast scenes of ellipsoids and planes with the true object of every pixel: enough to stand for people in rooms.
class TestScene {
 public:
  CameraModel camera;
  double noise = 0.0;  // [1/m] standard deviation of the depth, times depth^2

  // `R`: from the ellipsoid's axes to the camera's.
  void addEllipsoid(int object, const Eigen::Vector3d& center, const Eigen::Vector3d& radii,
                    const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) {
    const Eigen::Matrix3d to_unit_sphere = radii.cwiseInverse().asDiagonal() * R.transpose();
    ellipsoids_.push_back({object, center, to_unit_sphere});
  }
  // n.p + d = 0, seen from the side where n.p + d > 0.
  void addPlane(int object, const Eigen::Vector4d& plane) { planes_.push_back({object, plane}); }
  // An axis-aligned panel facing the camera.
  void addPanel(int object, const Eigen::Vector3d& center, double half_width, double half_height) {
    panels_.push_back({object, center, half_width, half_height});
  }
  // A standing person of 1.75 m with lowered arms, feet at `feet`, `up` from there.
  void addPerson(int object, const Eigen::Vector3d& feet, const Eigen::Vector3d& up = {0, -1, 0}) {
    Eigen::Matrix3d R;
    R << Eigen::Vector3d::UnitX(), -up, Eigen::Vector3d::UnitX().cross(-up);
    const auto add = [&](double x, double height, double forward, const Eigen::Vector3d& radii) {
      addEllipsoid(object, feet + R * Eigen::Vector3d(x, -height, -forward), radii, R);
    };
    add(0, 1.62, 0, {0.09, 0.13, 0.10});
    add(0, 1.46, 0, {0.06, 0.09, 0.06});
    add(0, 1.15, 0, {0.19, 0.37, 0.12});
    add(0, 0.88, 0, {0.16, 0.14, 0.12});
    for (const double side : {-1.0, 1.0}) {
      add(side * 0.22, 1.12, 0, {0.05, 0.35, 0.06});
      add(side * 0.10, 0.45, 0, {0.08, 0.48, 0.09});
      add(side * 0.10, 0.04, 0.06, {0.05, 0.04, 0.12});
    }
  }

  DepthImage render(Image<int>* objects = nullptr) const {
    DepthImage depth(camera.width, camera.height, 0.0F);
    if (objects != nullptr) objects->reset(camera.width, camera.height, 0);
    Random random(17);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        int object = 0;
        double z = castRay(camera.unproject(x, y, 1.0), object);
        if (object == 0) continue;
        z += noise * z * z * random.normal();
        depth.at(x, y) = static_cast<float>(z);
        if (objects != nullptr) objects->at(x, y) = object;
      }
    }
    return depth;
  }

 private:
  struct Ellipsoid {
    int object;
    Eigen::Vector3d center;
    Eigen::Matrix3d to_unit_sphere;
  };
  struct Plane {
    int object;
    Eigen::Vector4d plane;
  };
  struct Panel {
    int object;
    Eigen::Vector3d center;
    double half_width, half_height;
  };

  // Depth along the ray (x, y, 1) t; object 0 if nothing is hit within 9 m.
  double castRay(const Eigen::Vector3d& ray, int& object) const {
    double nearest = 9.0;
    const auto hit = [&](double t, int what) {
      if (t > 0.1 && t < nearest) {
        nearest = t;
        object = what;
      }
    };
    for (const Ellipsoid& e : ellipsoids_) {
      const Eigen::Vector3d r = e.to_unit_sphere * ray;
      const Eigen::Vector3d c = e.to_unit_sphere * e.center;
      const double b = r.dot(c);
      const double discriminant = b * b - r.squaredNorm() * (c.squaredNorm() - 1.0);
      if (discriminant > 0) hit((b - std::sqrt(discriminant)) / r.squaredNorm(), e.object);
    }
    for (const Plane& p : planes_) {
      const double along = p.plane.head<3>().dot(ray);
      if (along < -1e-6) hit(-p.plane[3] / along, p.object);
    }
    for (const Panel& p : panels_) {
      const Eigen::Vector3d at = ray * p.center.z() - p.center;
      if (std::abs(at.x()) < p.half_width && std::abs(at.y()) < p.half_height) hit(p.center.z(), p.object);
    }
    return nearest;
  }

  std::vector<Ellipsoid> ellipsoids_;
  std::vector<Plane> planes_;
  std::vector<Panel> panels_;
};

// Objects from here on are no people.
inline constexpr int kFirstThing = 3;

// What a perfect room classifier says of a picture: every eighth pixel that is measured, things taken for shell.
inline RoomLook mapOf(const Image<int>& objects) {
  return [objects, map = RoomMap{}](const DepthImage& depth) mutable -> const RoomMap& {
    map = {};
    map.stride = 8;
    map.offset = 2;
    map.width = (objects.width - map.offset + map.stride - 1) / map.stride;
    map.height = (objects.height - map.offset + map.stride - 1) / map.stride;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const int column = x * map.stride + map.offset;
        const int row = y * map.stride + map.offset;
        const int object = depth.at(column, row) > 0 ? objects.at(column, row) : 0;
        const float odds = object == 0 ? 0.0F : object < kFirstThing ? 3.0F : -3.0F;
        map.person.push_back(odds);
        map.shell.push_back(-odds);
        map.measured.push_back(object == 0 ? 0 : 1);
      }
    }
    return map;
  };
}

// Intersection over union of a mask with one object's pixels.
inline double overlap(const MaskImage& mask, const Image<int>& objects, int object) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < mask.data.size(); ++i) {
    const bool a = mask.data[i] != 0;
    const bool b = objects.data[i] == object;
    both += a && b ? 1 : 0;
    either += a || b ? 1 : 0;
  }
  return either == 0 ? 1.0 : static_cast<double>(both) / either;
}

}  // namespace depthmocap
