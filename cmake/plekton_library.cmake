# SPDX-License-Identifier: GPL-3.0-or-later
# plekton_options(target): how every target of the project is compiled.
# plekton_computes_little(target): tests, and the program, which reads, checks and writes: what computes is in the libraries.
# plekton_library(name EXCEPT folder PUBLIC libraries... PRIVATE libraries...): the library plekton::<name> from the sources of
#   the current folder, without those of a folder in it, static or shared as BUILD_SHARED_LIBS says.
# plekton_kernels(sources...): those of the current folder that run with the widest vectors of the processor.
# plekton_batches(target): its sources are compiled in fewer, larger units, eight of a folder in each.
# plekton_together(batch sources...): those of the current folder make a batch of their own.
# plekton_precompiled(target headers...): headers of packages that most of its sources need.

# GCC 12 makes fused operations of sums and differences side by side (vfmaddsub) where the processor has them, -ffp-contract=off
# or not: its vectoriser of straight code does not ask.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)
if(PLEKTON_NATIVE)
  set(CMAKE_REQUIRED_FLAGS -march=native)
else()
  set(CMAKE_REQUIRED_FLAGS "")
endif()
check_cxx_source_compiles("#if !defined(__FMA__) && !defined(__AVX512F__)
#error
#endif
int main() {}" PLEKTON_HAS_FUSED_OPERATIONS)
unset(CMAKE_REQUIRED_FLAGS)

function(plekton_options target)
  # Of the compiler with which the tests are run: others have other warnings.
  set(warnings_are_errors $<AND:$<BOOL:${PLEKTON_WARNINGS_AS_ERRORS}>,$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,12>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Public, because headers hold arithmetic too: an inline function compiled with fused multiply-add in a user's file and
  # without in ours would give results that depend on which copy the linker keeps.
  # Nobody reads errno after a square root; with it none could be taken side by side.
  target_compile_options(${target} PUBLIC "$<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off;-fno-math-errno>")
  if(PLEKTON_HAS_FUSED_OPERATIONS)
    target_compile_options(${target} PUBLIC $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-tree-slp-vectorize>)
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 reports it for std::string's operator+ at -O3, wrongly (GCC bug 105651)
    $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>  # below 512 MB GCC looks for what it could free: a tenth of its time
    $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>  # notes on how vectors of lanes are passed; they never leave one file
    $<${warnings_are_errors}:-Werror> $<$<BOOL:${PLEKTON_NATIVE}>:-march=native>)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()

# -O3 would be a tenth to two fifths of the compilation. The bits are the same.
function(plekton_computes_little target)
  # GCC 12 then warns, wrongly, of copies within <vector> and <string> (bug 105651).
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
endfunction()

# Most of the time of a small source goes into the headers that its neighbours need too. Batches stay within a folder, so that a new
# source moves those of its own alone, and have the same options. PLEKTON_BATCHES=OFF, as the preset `dev` has it, compiles one by one:
# less to compile after a change, and a header that is missing shows.
option(PLEKTON_BATCHES "Compile sources in batches" ON)
# Not CMake's own (UNITY_BUILD), whose files lie in the build folder: two builds that share these share the compiler cache.
set(PLEKTON_BATCHES_FOLDER ${PROJECT_BINARY_DIR}/batches CACHE PATH "Where the batches are written")
mark_as_advanced(PLEKTON_BATCHES_FOLDER)

function(plekton_batches target)
  if(PLEKTON_BATCHES)
    # GCC takes the sources of a batch for headers, whose classes should have no members of types of their own.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    # When the options of all sources are known.
    cmake_language(EVAL CODE "cmake_language(DEFER CALL plekton_write_batches ${target})")
  endif()
endfunction()

# plekton_alone(sources...): each takes as long as a batch.
function(plekton_alone)
  set_property(SOURCE ${ARGV} PROPERTY PLEKTON_IS_ALONE ON)
endfunction()

function(plekton_together batch)
  set_property(SOURCE ${ARGN} PROPERTY PLEKTON_BATCH ${batch})
endfunction()

# With the batches, for the same reason. Not for libraries: what is precompiled is of one build folder, and a build within another
# project would share nothing with ours in the compiler cache. None of our own headers: GCC knows a header with `#pragma once` by its
# time too, and would take it for another one where what is precompiled comes out of the cache of an older copy.
function(plekton_precompiled target)
  if(PLEKTON_BATCHES)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

function(plekton_write_batches target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(IS_PREFIX CMAKE_CURRENT_SOURCE_DIR "${source}" is_own)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(NOT options)
      set(options "")
    endif()
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    get_source_file_property(is_alone ${source} PLEKTON_IS_ALONE)
    if(is_own AND NOT definitions AND NOT is_alone)
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE name)
      if(options)
        string(MD5 key "${options}")
        string(SUBSTRING ${key} 0 6 key)
        string(APPEND name _${key})
      endif()
      get_source_file_property(together ${source} PLEKTON_BATCH)
      if(together)
        set(name ${together})
      endif()
      string(MAKE_C_IDENTIFIER "${name}" name)
      math(EXPR batch "0${count_${name}} / 8")
      math(EXPR count_${name} "0${count_${name}} + 1")
      list(APPEND names ${name}_${batch})
      set(options_${name}_${batch} ${options})
      string(APPEND ${name}_${batch} "#include \"${source}\"\n")
      set_source_files_properties(${source} PROPERTIES HEADER_FILE_ONLY ON)
    endif()
  endforeach()
  list(REMOVE_DUPLICATES names)
  foreach(name IN LISTS names)
    set(batch ${PLEKTON_BATCHES_FOLDER}/${target}/${name}.cpp)
    file(CONFIGURE OUTPUT ${batch} CONTENT "${${name}}" @ONLY)
    target_sources(${target} PRIVATE ${batch})
    if(options_${name})
      set_source_files_properties(${batch} PROPERTIES COMPILE_OPTIONS "${options_${name}}")
    endif()
  endforeach()
endfunction()

function(plekton_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXCEPT" "PUBLIC;PRIVATE")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(arg_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${arg_EXCEPT}/")
  endif()
  add_library(plekton_${name} ${sources})
  add_library(plekton::${name} ALIAS plekton_${name})
  set_target_properties(plekton_${name} PROPERTIES
    EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ON
    DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    INSTALL_RPATH $ORIGIN)
  target_include_directories(plekton_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/plekton>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  plekton_options(plekton_${name})
  plekton_batches(plekton_${name})
  # Nobody replaces a function of ours at load time, so the compiler may inline and call directly within a library.
  target_compile_options(plekton_${name} PRIVATE -fno-semantic-interposition)
  target_link_options(plekton_${name} PRIVATE LINKER:-Bsymbolic-functions $<$<CXX_COMPILER_ID:GNU>:LINKER:--no-undefined>)

  # A shared library has its private libraries inside; the exported target must not name them.
  if(BUILD_SHARED_LIBS)
    list(TRANSFORM arg_PRIVATE REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  endif()
  target_link_libraries(plekton_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# Types are laid out for the whole file, whose processor has vectors of two numbers: GCC 12 copies what consists of wider ones in
# pieces of two, also in functions for wider vectors, and a vector that is read from pieces just stored waits for them.
check_cxx_compiler_flag("-mmove-max=512 -mstore-max=512" PLEKTON_MOVES_WHOLE_VECTORS)

function(plekton_kernels)
  plekton_alone(${ARGV})
  if(PLEKTON_MOVES_WHOLE_VECTORS)
    set_property(SOURCE ${ARGV} APPEND PROPERTY COMPILE_OPTIONS -mmove-max=512 -mstore-max=512)
  endif()
endfunction()
