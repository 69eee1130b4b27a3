# depthmocap_layer(<name> FOLDER <path from the root> [PUBLIC libs...] [PRIVATE libs...] [IF_BUILT layers...]
#                  [WITHOUT files...])
#
# One folder is one static library is one layer. Sources are every *.cpp of the folder itself (sub-folders are layers of
# their own) but those named by WITHOUT; includes are written from the repository root. Third-party libraries come in as
# imported targets, so their headers are system headers and our warnings stay errors. A layer is built where something
# links it. IF_BUILT names layers of components (Dependencies.cmake) that are linked where they are part of this build.
function(depthmocap_layer name)
  cmake_parse_arguments(ARG "" "FOLDER" "PUBLIC;PRIVATE;IF_BUILT;WITHOUT" ${ARGN})
  set(folder "${PROJECT_SOURCE_DIR}/${ARG_FOLDER}")
  set(includes "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/libtracker/include" "${PROJECT_BINARY_DIR}/include")
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  list(TRANSFORM ARG_WITHOUT PREPEND "${folder}/")
  list(REMOVE_ITEM sources ${ARG_WITHOUT})
  foreach(layer IN LISTS ARG_IF_BUILT)
    if(TARGET ${layer})
      list(APPEND ARG_PUBLIC ${layer})
    endif()
  endforeach()
  if(sources)
    add_library(${name} STATIC EXCLUDE_FROM_ALL ${sources})
    target_include_directories(${name} PUBLIC ${includes})
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} depthmocap_flags)
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${includes})
    target_link_libraries(${name} INTERFACE ${ARG_PUBLIC})
  endif()
endfunction()

# depthmocap_tool(<name> FOLDER <path from the root> PRIVATE libs...): a program that the build itself runs, from every
# *.cpp of the folder.
function(depthmocap_tool name)
  cmake_parse_arguments(ARG "" "FOLDER" "PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${ARG_FOLDER}/*.cpp")
  add_executable(${name} EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(${name} PRIVATE ${ARG_PRIVATE} depthmocap_flags)
endfunction()
