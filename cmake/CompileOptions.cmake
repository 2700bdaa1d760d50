# Language, optimisation and warnings; the same for every target, because Eigen's alignment depends on -march.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

# -fno-math-errno: sqrt and sin need not set errno, so they vectorise. -fno-trapping-math: nobody traps floating-point
# exceptions. Neither changes a result. -ffast-math is never used: it breaks NaN checks and bitwise repeatability.
# Programs built with -march=native do not run on older processors, and libraries that pass Eigen objects must be compiled
# alike: packagers, and who links this library from a package of their own with other flags, turn it off.
option(HEERK_NATIVE "Optimise for this machine's processor (-march=native -fno-math-errno -fno-trapping-math)" ON)

add_compile_options(-Wall -Wextra)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC bug 105593 and its kin: AVX intrinsics of its own header, inlined into Eigen's kernels, warn falsely.
    add_compile_options(-Wno-uninitialized -Wno-maybe-uninitialized -Wno-array-bounds)
  endif()
  add_compile_options(-fno-semantic-interposition)  # position-independent functions may still be inlined
endif()
if(HEERK_NATIVE)
  add_compile_options(-march=native -fno-math-errno -fno-trapping-math)
endif()
