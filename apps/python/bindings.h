#pragma once
#include <pybind11/pybind11.h>

// Each adds one part of the module depthmocap._core; docstrings say shapes and units, depthmocap/_core.pyi the types.
namespace depthmocap {

void bindCameras(pybind11::module_& module);   // CameraModel, Recording, RecordingWriter, cameras()
void bindFrames(pybind11::module_& module);    // Frame
void bindActors(pybind11::module_& module);    // Actor, calibrate()
void bindTracking(pybind11::module_& module);  // track(), live(), Tracker
void bindIk(pybind11::module_& module);        // Ik
void bindMarkers(pybind11::module_& module);   // Markers, repair()
void bindTracks(pybind11::module_& module);    // joints and pose files

}  // namespace depthmocap
