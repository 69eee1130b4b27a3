# Every third-party library, in one place; the reason for each stands in docs/architecture.md. A library is looked for
# only where a component that needs it is built.

# Imported targets must be visible where a project that includes this one links the library.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

# depthmocap_find(<package> <Debian package> <who needs it> [arguments of find_package])
macro(depthmocap_find package debian needed_by)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "${package} was not found; ${needed_by} needs it. On Debian: apt install ${debian}")
  endif()
endmacro()

# The same for a library that only pkg-config knows; target PkgConfig::<prefix>.
macro(depthmocap_find_pc prefix module debian needed_by)
  pkg_check_modules(${prefix} QUIET IMPORTED_TARGET GLOBAL ${module})
  if(NOT ${prefix}_FOUND)
    message(FATAL_ERROR "${module} was not found; ${needed_by} needs it. On Debian: apt install ${debian}")
  endif()
endmacro()

depthmocap_find(Eigen3 libeigen3-dev "the library" NO_MODULE)
depthmocap_find(fmt libfmt-dev "the library")
depthmocap_find(nlohmann_json nlohmann-json3-dev "the library")
depthmocap_find(TBB libtbb-dev "the library")
depthmocap_find(Ceres libceres-dev "the library")
depthmocap_find(PCL libpcl-dev "the library" COMPONENTS common features sample_consensus search segmentation filters)
depthmocap_find(Threads libc6-dev "the library")
depthmocap_find(ZLIB zlib1g-dev "the library")
depthmocap_find(PNG libpng-dev "the library")
depthmocap_find(PkgConfig pkg-config "the library")
depthmocap_find_pc(flann flann libflann-dev "the library")

if(DEPTHMOCAP_OPENNI2)
  depthmocap_find_pc(openni2 libopenni2 libopenni2-dev "DEPTHMOCAP_OPENNI2")
endif()

if(DEPTHMOCAP_PROGRAM OR DEPTHMOCAP_LEARNING)
  set(needed_by "DEPTHMOCAP_PROGRAM or DEPTHMOCAP_LEARNING")
  depthmocap_find(VTK libvtk9-dev "${needed_by}" COMPONENTS CommonCore CommonDataModel FiltersCore)
  depthmocap_find(OpenCV libopencv-dev "${needed_by}" COMPONENTS core imgproc imgcodecs videoio ml)
  add_library(depthmocap_opencv INTERFACE)
  target_include_directories(depthmocap_opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(depthmocap_opencv INTERFACE opencv_core opencv_imgproc)
endif()

if(DEPTHMOCAP_LEARNING)
  depthmocap_find(embree libembree-dev "DEPTHMOCAP_LEARNING" 3)
  depthmocap_find(MPI "libopenmpi-dev openmpi-bin" "DEPTHMOCAP_LEARNING" COMPONENTS CXX)
endif()

if(DEPTHMOCAP_PROGRAM)
  depthmocap_find(CLI11 libcli11-dev "DEPTHMOCAP_PROGRAM")
  depthmocap_find(Boost libboost-dev "DEPTHMOCAP_PROGRAM" 1.74)  # headers: Beast
  depthmocap_find_pc(liblo liblo liblo-dev "DEPTHMOCAP_PROGRAM")
  depthmocap_find_pc(cairo cairo libcairo2-dev "DEPTHMOCAP_PROGRAM")
  # three.js for the live page, copied beside the program.
  find_path(THREE_JS three.min.js PATHS /usr/share/javascript/three)
  if(NOT THREE_JS)
    message(FATAL_ERROR "three.min.js was not found; DEPTHMOCAP_PROGRAM needs it. On Debian: apt install libjs-three")
  endif()
endif()

# The Python package, of Debian's interpreter unless another is named; a build without it is whole.
if(DEPTHMOCAP_PYTHON)
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  set(PYBIND11_FINDPYTHON ON)
  find_package(Python QUIET COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 QUIET)
  if(NOT Python_Development.Module_FOUND OR NOT pybind11_FOUND)
    message(STATUS "The Python package is left out. On Debian: apt install python3-dev pybind11-dev")
    set(DEPTHMOCAP_PYTHON OFF)
  endif()
endif()

# PCL 1.13 has no PCL::PCL target: wrap its components once, as system headers.
set(pcl_libraries ${PCL_COMMON_LIBRARIES} ${PCL_FEATURES_LIBRARIES} ${PCL_SAMPLE_CONSENSUS_LIBRARIES}
    ${PCL_SEARCH_LIBRARIES} ${PCL_SEGMENTATION_LIBRARIES} ${PCL_FILTERS_LIBRARIES})
add_library(depthmocap_pcl INTERFACE)
target_include_directories(depthmocap_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(depthmocap_pcl INTERFACE ${pcl_libraries})
