// A Scene as a part of a page: what it shows in words, and its data for the script.
#pragma once
#include <string>

#include "report/scene.h"

namespace report {

/// "20,000 elements in 12 frames, from t = 0 ms to t = 2 ms. At the end: damage up to 1, 345 links broken."
std::string scene_words(const Scene& scene);

/// One <figure>. Throws as report::pack does.
std::string scene_html(const Scene& scene);

}  // namespace report
