# SPDX-License-Identifier: GPL-3.0-or-later
# plekton_options(target): how every target of the project is compiled.
# plekton_library(name PUBLIC libraries... PRIVATE libraries...): the library plekton::<name> from the sources of the
#   current folder.

function(plekton_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -ffp-contract=off)
  if(PLEKTON_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()

function(plekton_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)  # headers only
    add_library(plekton_${name} INTERFACE)
    add_library(plekton::${name} ALIAS plekton_${name})
    target_link_libraries(plekton_${name} INTERFACE ${arg_PUBLIC} ${arg_PRIVATE})
    target_include_directories(plekton_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_compile_features(plekton_${name} INTERFACE cxx_std_20)
    return()
  endif()
  add_library(plekton_${name} STATIC ${sources})
  add_library(plekton::${name} ALIAS plekton_${name})
  set_target_properties(plekton_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(plekton_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/plekton>)
  target_link_libraries(plekton_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  plekton_options(plekton_${name})
endfunction()
