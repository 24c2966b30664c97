// A study's plan as people and programs read it.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/plan.h"

namespace app {

/// "T = 3.1 MPa, zeta = 5"; empty if nothing varies.
std::string setting_words(const study::Plan& plan, const study::Task& task);

/// The tasks, one a line up to a few dozen of them, then the estimate.
std::vector<std::string> plan_lines(const study::Plan& plan, int threads);

/// name, tasks[] (number, specimen, seed, ..., key, seconds, bytes), estimate{}.
nlohmann::ordered_json plan_json(const study::Plan& plan, int threads);

}  // namespace app
