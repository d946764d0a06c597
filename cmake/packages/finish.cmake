# SPDX-License-Identifier: GPL-3.0-or-later
# What Debian asks of every package beside its files; CPack runs this between installing and packing: copyright, change
# logs, the manual page compressed, where a tool for documentation finds the site, and links to what Debian has packages of.
find_program(GZIP gzip REQUIRED)

# compress(file): FILE.gz in its place, without its time, so that the same build gives the same bytes.
function(compress file)
  execute_process(COMMAND ${GZIP} -9 -n -f ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# SOURCE_DATE_EPOCH sets this date too.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(change_log "plekton (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; urgency=medium

  * Packages of this version; what is new in it stands in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")

set(folder ${CPACK_PLEKTON_SOURCE}/cmake/packages)
set(pairs ${CPACK_PLEKTON_PACKAGES})
while(pairs)
  list(POP_FRONT pairs component package)
  set(tree ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  if(NOT EXISTS ${tree})
    continue()
  endif()
  set(documents ${tree}/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  configure_file(${folder}/copyright ${documents}/copyright COPYONLY)
  file(WRITE ${documents}/changelog.Debian "${change_log}")
  configure_file(${CPACK_PLEKTON_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  compress(${documents}/changelog.Debian)
  compress(${documents}/changelog)
  if(EXISTS ${folder}/overrides/${package})
    configure_file(${folder}/overrides/${package} ${tree}/share/lintian/overrides/${package} COPYONLY)
  endif()
endwhile()

set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
compress(${root}/program${CPACK_PACKAGING_INSTALL_PREFIX}/share/man/man1/plekton.1)
configure_file(${folder}/doc-base ${root}/documentation${CPACK_PACKAGING_INSTALL_PREFIX}/share/doc-base/plekton-doc.plekton COPYONLY)

# link_to_same(files... FROM folders...): files of the site that Debian has too, the same bytes under the same name, become links.
function(link_to_same)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILES;FROM")
  foreach(file IN LISTS arg_FILES)
    cmake_path(GET file FILENAME name)
    file(SHA256 ${file} hash)
    foreach(folder IN LISTS arg_FROM)
      if(EXISTS ${folder}/${name})
        file(SHA256 ${folder}/${name} theirs)
        if(hash STREQUAL theirs)
          file(RELATIVE_PATH here ${root}/documentation ${file})
          cmake_path(GET here PARENT_PATH here)
          file(RELATIVE_PATH target /${here} ${folder}/${name})
          file(REMOVE ${file})
          file(CREATE_LINK ${target} ${file} SYMBOLIC)
          break()
        endif()
      endif()
    endforeach()
  endforeach()
endfunction()

set(static ${root}/documentation${CPACK_PACKAGING_INSTALL_PREFIX}/share/doc/plekton-doc/html/_static)
file(GLOB scripts ${static}/*.js)
file(GLOB_RECURSE katex ${static}/katex/*)
link_to_same(FILES ${scripts} ${katex} FROM /usr/share/javascript/sphinxdoc/1.0 /usr/share/javascript/katex
  /usr/share/javascript/katex/contrib /usr/share/fonts/truetype/katex)
