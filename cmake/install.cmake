# SPDX-License-Identifier: GPL-3.0-or-later
# The install tree: include/plekton/{geometry,contact,dynamics}, the libraries, the program, and the package
# `find_package(plekton CONFIG COMPONENTS ...)` with one component for each library.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/plekton)
foreach(name IN ITEMS geometry contact dynamics)
  install(TARGETS plekton_${name} EXPORT plekton-${name}-targets)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plekton
    FILES_MATCHING PATTERN "*.hpp")
  install(EXPORT plekton-${name}-targets NAMESPACE plekton:: DESTINATION ${package_folder})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/plekton-config.cmake.in
  ${PROJECT_BINARY_DIR}/plekton-config.cmake INSTALL_DESTINATION ${package_folder})
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/plekton-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plekton-config.cmake ${PROJECT_BINARY_DIR}/plekton-config-version.cmake
  DESTINATION ${package_folder})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

file(RELATIVE_PATH libraries_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
foreach(program IN ITEMS plekton plekton-geometry-check)
  if(TARGET ${program})
    set_target_properties(${program} PROPERTIES INSTALL_RPATH $ORIGIN/${libraries_from_program})
  endif()
endforeach()
if(TARGET plekton)
  install(TARGETS plekton)
endif()
# Built with the tests; an install of a few targets goes without it.
if(TARGET plekton-geometry-check)
  install(TARGETS plekton-geometry-check OPTIONAL)
endif()
