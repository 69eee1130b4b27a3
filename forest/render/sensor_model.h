#pragma once
#include "forest/render/depth_renderer.h"
#include "forest/render/named_camera.h"
#include "forest/render/smooth_noise.h"
#include "forest/render/stereo_sensor.h"
#include "forest/render/tof_sensor.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// Structured light: disparity in steps of 1/8 px found by matching windows of a dot pattern. Khoshelham and Elberink
// 2012, Nguyen, Izadi and Lovell 2012. Pixels are those of the 640x480 image; smaller images scale them.
struct Kinect1Noise {
  double baseline_m = 0.075;         // [m] projector to the right of the infrared camera
  double focal_px = 575.8;           // [px] of the matcher, whatever the size of the image handed out
  double disparity_step_px = 0.125;  // [px] depth steps of 2.9 mm at 1 m, 72 mm at 5 m
  double window_noise_px = 0.035;    // [px] disparity noise with the window's correlation, standard deviation
  double pixel_noise_px = 0.006;     // [px] disparity noise of single pixels
  double window_px = 8.0;            // [px] correlation length of the matching window
  double lateral_noise_px = 0.8;     // [px] wobble of silhouettes
  double grazing_cos = 0.12;         // surfaces seen flatter than this give no match
  double edge_dropout = 0.15;        // [0, 1] share of the pixels at a depth edge that give no match
  double hair_cos = 0.5;             // hair is the surface of the head that is seen flatter than this
  double hair_dropout = 0.25;        // [0, 1] share of the hair that gives no match
  double holes = 3.0;                // mean number of holes in a 640x480 image full of surface
  double min_depth_m = 0.5;          // [m]
  double max_depth_m = 8.0;          // [m]
};

// Time of flight: nearly white noise, mixed depths at silhouettes. Sarbolandi, Lefloch and Kolb 2015.
struct Kinect2Noise {
  double noise_m = 0.0015;        // [m] standard deviation close by
  double noise_per_m2 = 0.0003;   // [1/m] more of it per squared metre of distance
  double multipath_m = 0.003;     // [m] slowly varying bias, standard deviation
  double multipath_px = 60.0;     // [px] its correlation length
  double lateral_noise_px = 0.3;  // [px] wobble of silhouettes
  double flying_share = 0.6;      // [0, 1] share of silhouette pixels that mix two depths
  double flying_reach_m = 0.30;   // [m] how far behind the surface they fly where nothing is behind
  double grazing_cos = 0.08;      // surfaces seen flatter than this are dropped
  double min_depth_m = 0.5;       // [m]
  double max_depth_m = 4.5;       // [m]
};

// Turns a noise-free picture into what a sensor delivers. Keeps its working memory: use one object per thread.
class SensorModel {
 public:
  explicit SensorModel(SensorKind kind);

  // Of these, the one that belongs to the kind counts.
  Kinect1Noise kinect1;
  Kinect2Noise kinect2;
  StereoSensor stereo;  // D435 and Orbbec
  TofSensor tof;        // Azure

  // What render() must compute for apply().
  [[nodiscard]] RenderOptions renderOptions() const;

  // depth [m] in whole millimetres, 0 = no measurement; parts is the part of what each pixel measured, 0 where depth is
  // 0 or mixes the body with what is behind it. `view` rendered with renderOptions(). Equal random states, equal
  // results.
  void apply(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth, PartImage& parts);

 private:
  void applyKinect1(const RenderedView& view, double scale, Random& random, DepthImage& depth, PartImage& parts);
  void applyKinect2(const RenderedView& view, double scale, Random& random, DepthImage& depth, PartImage& parts);

  void applyOnItsSide(const RenderedView& view, const CameraModel& camera, Random& random, DepthImage& depth,
                      PartImage& parts);

  SensorKind kind_;
  RenderedView turned_;
  DepthImage turned_depth_;
  PartImage turned_parts_;
  SmoothNoise shift_x_, shift_y_, error_, dropout_;
  DepthImage unfiltered_;
};

}  // namespace depthmocap
