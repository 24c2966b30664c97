#include "report/assets.h"

// The assembler reads the files as they are: no copy in C++ to make, and nothing for the compiler to parse.
// REPORT_FOLDER is this folder, from the build.
#define EMBED(name, file)                                                                           \
  __asm__(".section .rodata\n.balign 16\nspall_asset_" #name ":\n.incbin \"" REPORT_FOLDER "/" file \
          "\"\nspall_asset_" #name "_end:\n.byte 0\n.previous\n");                                  \
  extern "C" const char spall_asset_##name[] __attribute__((visibility("hidden")));                 \
  extern "C" const char spall_asset_##name##_end[] __attribute__((visibility("hidden")))

EMBED(style, "page.css");
EMBED(page, "web/dist/page.js");
EMBED(curves, "web/dist/curves.js");
EMBED(space, "web/dist/space.js");

namespace report::assets {
namespace {
std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}
}  // namespace

std::string_view style() { return between(spall_asset_style, spall_asset_style_end); }
std::string_view page() { return between(spall_asset_page, spall_asset_page_end); }
std::string_view curves() { return between(spall_asset_curves, spall_asset_curves_end); }
std::string_view space() { return between(spall_asset_space, spall_asset_space_end); }

}  // namespace report::assets
