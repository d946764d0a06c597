# SPDX-License-Identifier: GPL-3.0-or-later
# Defaults for the whole build, taken only when Plekton is not part of another project.

# Shared libraries keep what they use to themselves: a user needs no development package of CGAL, FCL, libccd or zlib.
option(BUILD_SHARED_LIBS "Build shared libraries" ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

find_program(PLEKTON_CCACHE ccache DOC "Compiler cache, used when found")
if(PLEKTON_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this it does not keep what is compiled with precompiled headers, as tests are.
  set(CMAKE_CXX_COMPILER_LAUNCHER sh ${CMAKE_CURRENT_LIST_DIR}/cached_compiler.sh ${PLEKTON_CCACHE})
endif()
