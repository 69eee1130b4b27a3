# The library `depthmocap::depthmocap`, made of the run-time layers, and what is installed for those who link it.
# Symbols with DEPTHMOCAP_API (depthmocap/export.h) are visible; docs/reference/api.md says what they promise.
set(run_time_layers dmc_core dmc_skeleton dmc_actor dmc_recording dmc_posedb dmc_segment dmc_classify dmc_markers dmc_prior
    dmc_solve dmc_match dmc_shape dmc_tracker dmc_ik dmc_sensor dmc_smooth dmc_session dmc_calibration)
set(run_time_libraries Ceres::ceres ${pcl_libraries} PkgConfig::flann ZLIB::ZLIB PNG::PNG fmt::fmt TBB::tbb
    Threads::Threads)
if(DEPTHMOCAP_OPENNI2)
  list(APPEND run_time_layers dmc_openni)
  list(APPEND run_time_libraries PkgConfig::openni2)
endif()

set(objects)
foreach(layer IN LISTS run_time_layers)
  list(APPEND objects $<TARGET_OBJECTS:${layer}>)
endforeach()
set(library_type SHARED)
if(DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
  set(library_type STATIC)
endif()
# The program has the name `depthmocap` among the targets.
add_library(depthmocap_library ${library_type} ${objects})
add_library(depthmocap::depthmocap ALIAS depthmocap_library)
target_compile_features(depthmocap_library INTERFACE cxx_std_20)
target_include_directories(depthmocap_library INTERFACE
                           $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/libtracker/include>
                           $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(depthmocap_library PUBLIC Eigen3::Eigen PRIVATE ${run_time_libraries})
set_target_properties(depthmocap_library PROPERTIES
                      EXPORT_NAME depthmocap OUTPUT_NAME depthmocap LINKER_LANGUAGE CXX
                      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
                      LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib"
                      ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
target_link_options(depthmocap_library PRIVATE LINKER:--as-needed)
if(NOT DEPTHMOCAP_SANITIZE)  # the sanitizers' functions come with the program
  target_link_options(depthmocap_library PRIVATE LINKER:--no-undefined)
endif()

# Types of Eigen are larger or otherwise aligned where the processor's wide registers are switched on (-mavx). The header
# holds what the library was built with, so that a program that differs does not compile.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES Eigen3::Eigen)
foreach(bytes 16 32 64)
  check_cxx_source_compiles("#include <Eigen/Core>
    static_assert(EIGEN_MAX_STATIC_ALIGN_BYTES == ${bytes}); int main() {}" DEPTHMOCAP_ALIGNED_TO_${bytes})
  if(DEPTHMOCAP_ALIGNED_TO_${bytes})
    set(eigen_alignment ${bytes})
    break()
  endif()
endforeach()
unset(CMAKE_REQUIRED_LIBRARIES)
configure_file("${PROJECT_SOURCE_DIR}/cmake/version.h.in" "${PROJECT_BINARY_DIR}/include/depthmocap/version.h" @ONLY)

if(NOT DEPTHMOCAP_INSTALL)
  return()
endif()

# The prefix may be moved: the package's files find it from where they lie.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/depthmocap")
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
file(RELATIVE_PATH prefix_from_pkgconfig "/prefix/${pkgconfig_dir}" "/prefix")
if(library_type STREQUAL STATIC)
  set(package_is_static ON)
  set(pc_requires "eigen3 fmt tbb libpng zlib flann pcl_features pcl_segmentation pcl_filters")
  set(pc_libraries "-lceres -lglog")
  if(DEPTHMOCAP_OPENNI2)
    string(APPEND pc_requires " libopenni2")
  endif()
else()
  set(package_is_static OFF)
  set(pc_requires eigen3)
endif()
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/depthmocapConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/package/depthmocapConfig.cmake"
                              INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/depthmocapConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
configure_file("${PROJECT_SOURCE_DIR}/cmake/depthmocap.pc.in" "${PROJECT_BINARY_DIR}/package/depthmocap.pc" @ONLY)

install(TARGETS depthmocap_library EXPORT depthmocapTargets)
install(EXPORT depthmocapTargets NAMESPACE depthmocap:: DESTINATION "${package_dir}")
install(FILES "${PROJECT_BINARY_DIR}/package/depthmocapConfig.cmake"
        "${PROJECT_BINARY_DIR}/package/depthmocapConfigVersion.cmake" DESTINATION "${package_dir}")
install(FILES "${PROJECT_BINARY_DIR}/package/depthmocap.pc" DESTINATION "${pkgconfig_dir}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/libtracker/include/depthmocap" "${PROJECT_BINARY_DIR}/include/depthmocap"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")
