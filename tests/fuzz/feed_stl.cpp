#include "impact/impactors/stl.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::stl(std::string_view bytes) {
  try {
    impact::parse_stl(bytes, "rock.stl", 0.001);
  } catch (const dem::InputError&) {
  }
}
