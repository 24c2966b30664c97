// The files that a page carries inside itself. The build puts them into the program as they are (assets.cpp):
// the style is written by hand, the scripts are bundled from report/web and committed, so that no Node is
// needed here.
#pragma once
#include <string_view>

namespace report::assets {
std::string_view style();   ///< page.css
std::string_view page();    ///< web/dist/page.js: dark and light; in every page
std::string_view curves();  ///< web/dist/curves.js: in pages with a Chart
std::string_view space();   ///< web/dist/space.js: in pages with a Scene
}  // namespace report::assets
