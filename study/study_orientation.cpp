#include "study/study_orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "specimens/interaction_range.h"
#include "specimens/isotropy.h"
#include "specimens/specimen_file.h"
#include "study/plan_key.h"
#include "study/statistics/orientation.h"

namespace study {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t theta_bins = 6, phi_bins = 12;

struct Kind {
  const SpecimenRecipe* recipe = nullptr;  ///< its first
  std::size_t specimens = 0, links = 0;
  double low = 1, high = 0;  ///< eigenvalues
  statistics::OrientationHistogram histogram;
};

bool same_kind(const SpecimenRecipe& a, const SpecimenRecipe& b) {
  return a.group == b.group && a.packing.shape == b.packing.shape && a.packing.size == b.packing.size &&
         a.packing.elements == b.packing.elements;
}

int long_axis(const dem::Vec3& size) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (size[k] > size[axis]) axis = k;
  return axis;
}

void add_specimen(Kind& kind, const specimens::Specimen& specimen) {
  const auto internal = specimens::internal_elements(specimen);
  std::vector<dem::Vec3> directions;
  // An internal element counts all its links, so one between two of them counts twice (specimens/isotropy.h).
  for (const specimens::Link& link : specimen.links)
    for (const std::int32_t end : {link.a, link.b})
      if (internal[static_cast<std::size_t>(end)] != 0)
        directions.emplace_back(specimen.centres[static_cast<std::size_t>(link.b)] -
                                specimen.centres[static_cast<std::size_t>(link.a)]);
  const auto histogram =
      statistics::orientation_histogram(directions, theta_bins, phi_bins, long_axis(specimen.size));
  if (kind.specimens == 0)
    kind.histogram = histogram;
  else
    statistics::add(kind.histogram, histogram);
  const specimens::Isotropy isotropy = specimens::isotropy_of(specimen);
  ++kind.specimens;
  kind.links += isotropy.links;
  kind.low = std::min(kind.low, isotropy.eigenvalues.front());
  kind.high = std::max(kind.high, isotropy.eigenvalues.back());
}

}  // namespace

Json orientation_json(const Plan& plan, const StudyFolder& folder) {
  std::vector<Kind> kinds;
  for (const SpecimenRecipe& recipe : plan.study.specimens) {
    const std::filesystem::path file = recipe.file.empty() ? folder.specimen(key_of(recipe)) : recipe.file;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) continue;
    auto found = std::find_if(kinds.begin(), kinds.end(),
                              [&](const Kind& kind) { return same_kind(*kind.recipe, recipe); });
    if (found == kinds.end()) {
      found = kinds.emplace(kinds.end());
      found->recipe = &recipe;
    }
    add_specimen(*found, specimens::read_specimen(file));
  }
  Json json = Json::array();
  for (const Kind& kind : kinds) {
    const statistics::Uniformity test = statistics::uniformity(kind.histogram);
    const dem::Vec3& size = kind.recipe->packing.size;
    json.push_back({{"specimen", kind.recipe->group},
                    {"size", {size.x(), size.y(), size.z()}},
                    {"elements", kind.recipe->packing.elements},
                    {"specimens", kind.specimens},
                    {"links", kind.links},
                    {"smallest_eigenvalue", kind.low},
                    {"largest_eigenvalue", kind.high},
                    {"by_theta", kind.histogram.relative_by_theta()},
                    {"by_phi", kind.histogram.relative_by_phi()},
                    {"deviation", test.deviation},
                    {"deviation_of_random_directions",
                     std::sqrt(static_cast<double>(theta_bins * phi_bins) / static_cast<double>(kind.links))}});
  }
  return json;
}

}  // namespace study
