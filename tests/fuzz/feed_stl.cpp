#include "impact/impactors/stl.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::stl(std::string_view bytes) {
  take_refusal([&] { impact::parse_stl(bytes, "rock.stl", 0.001); });
}
