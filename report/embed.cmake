# Writes OUTPUT, a C++ source that holds the text of STYLE and SCRIPT (see assets.h).
foreach(asset STYLE SCRIPT)
  file(READ ${${asset}} ${asset}_TEXT)
  if("${${asset}_TEXT}" MATCHES "\\)spall\"")
    message(FATAL_ERROR "${${asset}}: holds the mark that would end its string in C++")
  endif()
endforeach()
file(WRITE ${OUTPUT}.new "// Generated from page.css and chart.js.
#include \"report/assets.h\"

namespace report::assets {
const std::string_view style = R\"spall(${STYLE_TEXT})spall\";
const std::string_view script = R\"spall(${SCRIPT_TEXT})spall\";
}  // namespace report::assets
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
