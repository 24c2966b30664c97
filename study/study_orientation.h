// Where the links of a study's specimens point: the paper's Fig. 2.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "study/folder.h"
#include "study/plan.h"

namespace study {

/// The `orientation` of result.json: for each kind of specimen (what differs by nothing but the seed) the
/// number of specimens and of links of internal elements, the smallest and largest eigenvalue of their fabric
/// tensors (1/3 each when isotropic), and counts over those of an even distribution, summed over the kind: by
/// theta, the angle from the specimen's long axis, in rings of equal solid angle, and by phi around it.
/// `deviation` is the standard deviation of the counts in the cells of both, beside that of as many random
/// directions. Specimens that are not in the folder are left out.
nlohmann::ordered_json orientation_json(const Plan& plan, const StudyFolder& folder);

}  // namespace study
