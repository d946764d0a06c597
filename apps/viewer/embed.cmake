# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D DIST=FOLDER -D OUT=FILE -P embed.cmake: viewer.html and viewer.js of a folder as C++ source (viewer_files.hpp).
# A literal may be no longer than 65536 bytes, so they are cut.
function(pieces file result)
  file(READ ${file} text)
  string(LENGTH "${text}" length)
  set(literals "")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 16000 piece)
    string(APPEND literals "    R\"~plekton~(${piece})~plekton~\"sv,\n")
    math(EXPR at "${at} + 16000")
  endwhile()
  set(${result} "${literals}" PARENT_SCOPE)
endfunction()

pieces(${DIST}/viewer.html html)
pieces(${DIST}/viewer.js code)
file(WRITE ${OUT} "// Written by apps/viewer/embed.cmake.
#include \"apps/viewer/viewer_files.hpp\"

namespace plekton::apps {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kHtml[] = {
${html}};
constexpr std::string_view kCode[] = {
${code}};

}  // namespace

std::span<const std::string_view> viewer_html() { return kHtml; }
std::span<const std::string_view> viewer_code() { return kCode; }

}  // namespace plekton::apps
")
