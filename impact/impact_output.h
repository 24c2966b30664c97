// What an impact leaves besides its histories and pictures: the keys of its result.json, and its fragments.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "impact/impact_run.h"
#include "impact/scene.h"

namespace impact {

/// The object that becomes result.json. SI units; a quantity that is no number becomes null.
nlohmann::ordered_json result_of(const Scene& scene, const ImpactResult& found, int threads);

/// One row a fragment, the heaviest, which is the main body, first.
std::string fragments_csv(const Fragments& fragments);

}  // namespace impact
