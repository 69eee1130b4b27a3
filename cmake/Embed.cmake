# depthmocap_embed(<target> <file> <function>)
#
# Builds the bytes of a file into a target, as `std::string_view depthmocap::<function>()`. What the library cannot do
# without is part of it and is never looked for at run time.
function(depthmocap_embed target file function)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" bytes
         "${bytes}")
  cmake_path(GET file FILENAME name)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/embedded/${function}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT [=[
// Made by cmake/Embed.cmake from @name@.
#include <string_view>

namespace depthmocap {
std::string_view @function@();
std::string_view @function@() {
  static constexpr unsigned char kBytes[] = {@bytes@};
  return {reinterpret_cast<const char*>(kBytes), sizeof kBytes};
}
}  // namespace depthmocap
]=])
  target_sources(${target} PRIVATE "${source}")
endfunction()
