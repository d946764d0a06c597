# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian packages, by CPack, of the components of the install rules; build.sh makes them in one go.
# Before 1.0 a new minor version may change the interface, so the package of the libraries is named by both numbers, as
# their soname is.
set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(packages_by_component program plekton library libplekton${abi} development libplekton-dev python python3-plekton
  documentation plekton-doc)

# The pages of the site, where docs/build.sh has made them for packages.
install(DIRECTORY ${PROJECT_BINARY_DIR}/site/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/plekton-doc/html
  COMPONENT documentation EXCLUDE_FROM_ALL)

# Who stands for the packages, by the variables that Debian's tools know. The address is nobody's until it is set.
set(name "$ENV{DEBFULLNAME}")
set(address "$ENV{DEBEMAIL}")
if(NOT name)
  set(name "The Plekton contributors")
endif()
if(NOT address)
  set(address "plekton@example.org")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program library development python documentation)
if(NOT TARGET plekton_python)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/packages/finish.cmake)
set(CPACK_PLEKTON_PACKAGES ${packages_by_component})
set(CPACK_PLEKTON_SOURCE ${PROJECT_SOURCE_DIR})

set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "discrete element method with deformable structures")
set(CPACK_PACKAGE_CONTACT "${name} <${address}>")
set(CPACK_DEBIAN_PACKAGE_RELEASE 0plekton1)  # below the -1 of a package of Debian's own
set(CPACK_DEBIAN_PACKAGE_SOURCE plekton)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

# Libraries of others that are needed, by dpkg-shlibdeps; ours are named, in the version that they are built with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS)
foreach(library IN LISTS libraries)
  get_target_property(folder plekton_${library} BINARY_DIR)
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${folder})
endforeach()
set(our_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(ours "libplekton${abi} ${our_version}")

# What every description ends with; its lines are shorter than 80 characters.
set(about "Plekton simulates grains and what holds them: soil on geotextiles, rockfall
nets, tubes, membranes. Spheres, cylinders and thick facets collide with one
contact point where there is one, exactly decided, and with the same bits on
any number of threads.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME plekton)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${ours}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "plekton-doc, python3-plekton, gnuplot, paraview, yade")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${about}
.
This package has the program, which runs scenario files, and examples.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libplekton${abi})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# CPack would write scripts that call ldconfig; a trigger does it once for all packages.
set(control ${PROJECT_BINARY_DIR}/packages_control)
set(shlibs)
foreach(library IN LISTS libraries)
  string(APPEND shlibs "libplekton_${library} ${abi} ${ours}\n")
endforeach()
file(WRITE ${control}/shlibs "${shlibs}")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${control}/shlibs;${control}/triggers")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${about}
.
This package has the libraries for programs at run time.")

# Headers hold templates of Eigen; everything else is inside of the libraries.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libplekton-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${ours}, libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "plekton-doc, libopenmpi-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}
.
This package has what programs are compiled with: headers, and files for CMake
and pkg-config.")

# The module is compiled for one version of Python.
if(TARGET plekton_python)
  get_target_property(python_minor plekton_python PLEKTON_PYTHON_MINOR)
  math(EXPR next_python "${python_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${ours}, python3 (>= 3.${python_minor}), python3 (<< 3.${next_python}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-plekton)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "plekton, plekton-doc, jupyter-notebook")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/cmake/packages/python/postinst;${PROJECT_SOURCE_DIR}/cmake/packages/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${about}
.
This package has the module for Python, with numpy's arrays in and out.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME plekton-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_DEPENDS "libjs-sphinxdoc, libjs-katex, fonts-katex")  # finish.cmake links to them
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "${about}
.
This package has the documentation as pages for a browser: tutorials, how-to,
reference, theory, validation, and the interface in C++.")
include(CPack)
