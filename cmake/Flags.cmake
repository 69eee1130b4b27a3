# Warnings are errors in our code. -ffp-contract=off and no -ffast-math: the same input gives the same bytes on every
# machine, whatever it can do beyond the x86-64 baseline (faster code is chosen at run time, in the layers that need it).
add_library(depthmocap_flags INTERFACE)
target_compile_options(depthmocap_flags INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off)

option(DEPTHMOCAP_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
if(DEPTHMOCAP_SANITIZE)
  # The checks left out double the time to compile Eigen's templates; AddressSanitizer finds bad pointers by itself.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Eigen changes its allocator under AddressSanitizer; PCL's library, which frees what our templates allocate, was built
  # without it.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
