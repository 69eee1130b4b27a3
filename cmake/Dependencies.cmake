# Every third-party library, in one place; the reason for each stands in docs/architecture.md.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs videoio ml)
find_package(Ceres REQUIRED)
find_package(PCL REQUIRED COMPONENTS common features sample_consensus search segmentation filters)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore)
find_package(embree 3 REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers: Beast
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(PkgConfig REQUIRED)
pkg_check_modules(flann REQUIRED IMPORTED_TARGET flann)
pkg_check_modules(openni2 REQUIRED IMPORTED_TARGET libopenni2)
pkg_check_modules(liblo REQUIRED IMPORTED_TARGET liblo)

# PCL 1.13 has no PCL::PCL target: wrap its components once, as system headers.
add_library(depthmocap_pcl INTERFACE)
target_include_directories(depthmocap_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(depthmocap_pcl INTERFACE ${PCL_COMMON_LIBRARIES} ${PCL_FEATURES_LIBRARIES} ${PCL_SAMPLE_CONSENSUS_LIBRARIES}
                      ${PCL_SEARCH_LIBRARIES} ${PCL_SEGMENTATION_LIBRARIES} ${PCL_FILTERS_LIBRARIES})

add_library(depthmocap_opencv INTERFACE)
target_include_directories(depthmocap_opencv SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(depthmocap_opencv INTERFACE opencv_core opencv_imgproc opencv_imgcodecs opencv_videoio)

# three.js for the live page, copied beside the program.
find_path(THREE_JS three.min.js PATHS /usr/share/javascript/three REQUIRED)
