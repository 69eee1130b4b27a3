# The manual page and the shell completion, from the program's own help; and packages of what cmake --install takes
# (scripts/package): a .deb, and an archive that may be unpacked anywhere on a machine that has the same libraries.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  set(manual_dir "${PROJECT_BINARY_DIR}/manual")
  set(manual_files "${manual_dir}/depthmocap.1" "${manual_dir}/depthmocap.bash")
  add_custom_command(OUTPUT ${manual_files} DEPENDS ${programs} "${PROJECT_SOURCE_DIR}/cmake/manual.py"
                     COMMAND Python3::Interpreter "${PROJECT_SOURCE_DIR}/cmake/manual.py" "$<TARGET_FILE:depthmocap>"
                             "${manual_dir}" VERBATIM)
  add_custom_target(depthmocap_manual DEPENDS ${manual_files})
  add_dependencies(program depthmocap_manual)
  install(FILES "${manual_dir}/depthmocap.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  install(FILES "${manual_dir}/depthmocap.bash" RENAME depthmocap
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
endif()
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" RENAME copyright DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/depthmocap")

set(CPACK_PACKAGE_NAME depthmocap)
set(CPACK_PACKAGE_VENDOR "the depthmocap developers")
set(CPACK_PACKAGE_CONTACT "the depthmocap developers <depthmocap@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "motion capture with one depth camera, without markers, suit or GPU")
set(CPACK_PACKAGE_DESCRIPTION "Tracks one to six people in the pictures of a depth camera (Kinect, Xtion, RealSense, Orbbec) or
 of a recording, and writes their motion as BVH, glTF, USD, CSV, TRC, C3D or streams.")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/dist")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/PackageKind.cmake")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libopenni2-0")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libeigen3-dev, blender")
include(CPack)
