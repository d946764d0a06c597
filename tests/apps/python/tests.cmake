# SPDX-License-Identifier: GPL-3.0-or-later
# One ctest entry for each file of tests of the Python module. What cannot be run is said when the build is configured.
set(python_tests ${CMAKE_CURRENT_LIST_DIR})
execute_process(COMMAND ${PLEKTON_PYTHON} -c "import numpy, pytest" RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
if(NOT missing EQUAL 0)
  message(STATUS "The tests of the Python module are left out: ${PLEKTON_PYTHON} has no numpy or no pytest "
    "(Debian: python3-numpy python3-pytest)")
  return()
endif()
if(CMAKE_CXX_FLAGS MATCHES "fsanitize=thread")
  message(STATUS "The tests of the Python module are left out: the interpreter is built without the thread sanitizer")
  return()
endif()

set(environment PYTHONPATH=${PROJECT_BINARY_DIR}/python PLEKTON_PROGRAM=$<TARGET_FILE:plekton>)
if(CMAKE_CXX_FLAGS MATCHES "fsanitize=address")
  # The sanitizer has to be there before the interpreter, and the C++ library before the sanitizer looks for what it
  # throws with. What the interpreter keeps until it ends is no leak of ours.
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    set(sanitizer libclang_rt.asan-${CMAKE_SYSTEM_PROCESSOR}.so)
  else()
    set(sanitizer libasan.so)
  endif()
  foreach(library IN ITEMS ${sanitizer} libstdc++.so)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${library} OUTPUT_VARIABLE path
      OUTPUT_STRIP_TRAILING_WHITESPACE)
    file(REAL_PATH ${path} path)
    if(NOT EXISTS ${path})
      message(FATAL_ERROR "The Python module cannot be tested with the address sanitizer: ${CMAKE_CXX_COMPILER} names no "
        "${library}; install the compiler's runtime (Debian: libclang-rt-14-dev, libgcc-12-dev), or configure with "
        "-DPLEKTON_BUILD_PYTHON=OFF")
    endif()
    list(APPEND preloaded ${path})
  endforeach()
  list(JOIN preloaded ":" preloaded)
  list(APPEND environment LD_PRELOAD=${preloaded} ASAN_OPTIONS=detect_leaks=0)
endif()

file(GLOB files CONFIGURE_DEPENDS ${python_tests}/*_test.py)
foreach(file IN LISTS files)
  cmake_path(GET file STEM name)
  string(REGEX REPLACE "_test$" "" name ${name})
  add_test(NAME python.${name} COMMAND ${PLEKTON_PYTHON} -B -m pytest -q -p no:cacheprovider ${file})
  set_tests_properties(python.${name} PROPERTIES ENVIRONMENT "${environment}")
endforeach()
