#include "study/plan.h"
#include "study/study_file.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_file.h"

void fuzz::study_file(std::string_view bytes) {
  read_as_file("study.toml", bytes, [](const auto& file) { study::make_plan(study::read_study(file)); });
}
