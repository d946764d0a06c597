# SPDX-License-Identifier: GPL-3.0-or-later
# Sets PLEKTON_HAS_PYTHON where pybind11 and the headers of the interpreter are found: that of the system, for which
# Debian packages numpy, and not another one that comes first on the path.
set(PLEKTON_PYTHON /usr/bin/python3 CACHE FILEPATH "Interpreter that the Python module is built for")
set(Python_EXECUTABLE ${PLEKTON_PYTHON})
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
if(Python_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)
endif()
if(Python_FOUND AND pybind11_FOUND)
  set(PLEKTON_HAS_PYTHON ON)
else()
  set(PLEKTON_HAS_PYTHON OFF)
  message(STATUS "The Python module is left out: pybind11 or the headers of ${PLEKTON_PYTHON} are missing "
    "(Debian: pybind11-dev python3-dev python3-numpy; another interpreter: -DPLEKTON_PYTHON=FILE; without this message: -DPLEKTON_BUILD_PYTHON=OFF)")
endif()
