# SPDX-License-Identifier: GPL-3.0-or-later
# The install tree: the public headers below include/plekton, the libraries, the program, and the package: for CMake
# `find_package(plekton CONFIG COMPONENTS ...)` with one component for each library, for others `pkg-config plekton`.
# The COMPONENT of an install rule names the Debian package that the file goes into; see packages/packages.cmake.
include(CMakePackageConfigHelpers)
include(cmake/public_headers.cmake)

# What users include; what these need comes along.
plekton_public_headers(public_headers
  contact/among_ranks.hpp
  contact/law/cohesive_frictional.hpp
  contact/law/dmt_adhesion.hpp
  contact/law/hertz_mindlin.hpp
  contact/law_list.hpp
  contact/models.hpp
  contact/with_parts.hpp
  dynamics/loads/applied_loads.hpp
  dynamics/output/csv_writer.hpp
  dynamics/output/pvd_series.hpp
  dynamics/output/scene_frame.hpp
  dynamics/output/vtk_writer.hpp
  dynamics/measure_sample.hpp
  dynamics/measures/unbalanced_force.hpp
  dynamics/scene_check.hpp
  dynamics/simulation.hpp
  dynamics/structure/beam_bonds.hpp
  dynamics/structure/bonds_along.hpp
  dynamics/structure/membrane_force.hpp
  dynamics/structure/sheet_facets.hpp
  geometry/mesh/generate/closed_tube.hpp
  geometry/mesh/generate/generators.hpp
  geometry/mesh/generate/lattice.hpp
  geometry/mesh/generate/membrane.hpp
  geometry/mesh/generate/polygon.hpp
  geometry/mesh/io/import.hpp
  geometry/mesh/io/mesh_file.hpp
  geometry/mesh/repair/orientation.hpp
  geometry/mesh/repair/remesh.hpp
  geometry/mesh/repair/repair.hpp
  geometry/mesh/repair/reshape.hpp
  geometry/neighbor/cell_neighbours.hpp
  geometry/neighbor/neighbours.hpp
  geometry/queries.hpp
  geometry/version.hpp)
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plekton/${folder}
    COMPONENT development)
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/plekton)
set(libraries geometry contact dynamics)
if(TARGET plekton_distributed)
  list(APPEND libraries distributed)
  install(FILES ${PROJECT_SOURCE_DIR}/dynamics/distributed/mpi_job.hpp
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plekton/dynamics/distributed COMPONENT development)
endif()
foreach(name IN LISTS libraries)
  install(TARGETS plekton_${name} EXPORT plekton-${name}-targets
    LIBRARY COMPONENT library NAMELINK_COMPONENT development ARCHIVE COMPONENT development)
  install(EXPORT plekton-${name}-targets NAMESPACE plekton:: DESTINATION ${package_folder} COMPONENT development)
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/plekton-config.cmake.in
  ${PROJECT_BINARY_DIR}/plekton-config.cmake INSTALL_DESTINATION ${package_folder})
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/plekton-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plekton-config.cmake ${PROJECT_BINARY_DIR}/plekton-config-version.cmake
  DESTINATION ${package_folder} COMPONENT development)
file(RELATIVE_PATH prefix_from_package ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(${PROJECT_SOURCE_DIR}/cmake/plekton.pc.in ${PROJECT_BINARY_DIR}/plekton.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/plekton.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)

file(RELATIVE_PATH libraries_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
foreach(program IN ITEMS plekton plekton-geometry-check)
  if(TARGET ${program})
    set_target_properties(${program} PROPERTIES INSTALL_RPATH $ORIGIN/${libraries_from_program})
  endif()
endforeach()
if(TARGET plekton)
  install(TARGETS plekton COMPONENT program)
  # Written by the program; an install of a few targets goes without them.
  set(generated ${PROJECT_BINARY_DIR}/apps/generated)
  install(FILES ${generated}/plekton.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  install(FILES ${generated}/plekton DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    COMPONENT program OPTIONAL)
  install(FILES ${generated}/scenario.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/plekton COMPONENT program OPTIONAL)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/apps/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/plekton COMPONENT program)
endif()
# Built with the tests; an install of a few targets goes without it.
if(TARGET plekton-geometry-check)
  install(TARGETS plekton-geometry-check COMPONENT tests OPTIONAL)
endif()
