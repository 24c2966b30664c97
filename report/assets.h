// The files that every page carries inside itself; their definitions are generated at build time (embed.cmake).
#pragma once
#include <string_view>

namespace report::assets {
extern const std::string_view style;   ///< page.css
extern const std::string_view script;  ///< chart.js
}  // namespace report::assets
