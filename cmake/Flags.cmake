# -ffp-contract=off and no -ffast-math: the same input gives the same bytes on every machine, whatever it can do beyond
# the x86-64 baseline (faster code is chosen at run time, in the layers that need it). Warnings are errors in our code,
# where it is we who build it.
add_library(depthmocap_flags INTERFACE)
target_compile_options(depthmocap_flags INTERFACE -ffp-contract=off)
# Packages name more libraries than we use; each that is linked is loaded at every start.
target_link_options(depthmocap_flags INTERFACE LINKER:--as-needed)
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(depthmocap_flags INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror)
endif()

# The same object files serve the program and the shared library, which shows what has DEPTHMOCAP_API and nothing else.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
target_compile_options(depthmocap_flags INTERFACE -fno-semantic-interposition)

set(DEPTHMOCAP_SANITIZE "" CACHE STRING "Build with AddressSanitizer and UndefinedBehaviorSanitizer (memory), ThreadSanitizer (threads) or neither")
if(DEPTHMOCAP_SANITIZE STREQUAL "threads")
  # -Wno-tsan: Boost.Asio has fences that ThreadSanitizer does not see; they are not what orders our data.
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -Wno-tsan)
  add_link_options(-fsanitize=thread)
elseif(DEPTHMOCAP_SANITIZE STREQUAL "memory")
  # The checks left out double the time to compile Eigen's templates; AddressSanitizer finds bad pointers by itself.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Eigen changes its allocator under AddressSanitizer; PCL's library, which frees what our templates allocate, was built
  # without it.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
elseif(DEPTHMOCAP_SANITIZE)
  message(FATAL_ERROR "DEPTHMOCAP_SANITIZE is '${DEPTHMOCAP_SANITIZE}'; it must be memory, threads or empty")
endif()

option(DEPTHMOCAP_FUZZ "Build tests/fuzz as libFuzzer programs; needs clang" OFF)
if(DEPTHMOCAP_FUZZ)
  # Asserts are on, Eigen's too.
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=all -fno-omit-frame-pointer -UNDEBUG)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
