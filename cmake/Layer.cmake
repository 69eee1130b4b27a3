# depthmocap_layer(<name> FOLDER <path from the root> [PUBLIC libs...] [PRIVATE libs...])
#
# One folder is one static library is one layer. Sources are every *.cpp of the folder itself (sub-folders are layers of
# their own); includes are written from the repository root. Third-party libraries come in as imported targets, so their
# headers are system headers and our warnings stay errors.
function(depthmocap_layer name)
  cmake_parse_arguments(ARG "" "FOLDER" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${ARG_FOLDER}/*.cpp")
  if(sources)
    add_library(${name} STATIC ${sources})
    target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/libtracker/include")
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} depthmocap_flags)
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/libtracker/include")
    target_link_libraries(${name} INTERFACE ${ARG_PUBLIC})
  endif()
endfunction()
