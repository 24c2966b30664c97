#include "study/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libdem/core/error.h"
#include "libdem/material/card_numbers.h"
#include "libdem/material/micro_macro.h"
#include "study/estimate.h"
#include "study/number_list.h"
#include "study/plan_key.h"

namespace study {
namespace {

constexpr double most_tasks = 1e6;

void set_stiffness_ratio(dem::MaterialCard& card, double ratio) {
  dem::LinkStiffness link =
      dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
  link.shear_ratio = ratio;
  const dem::MacroElasticity macro = dem::macro_elasticity(link, card.alpha, card.beta, card.gamma);
  card.young_modulus = macro.young_modulus;
  card.poisson_ratio = macro.poisson_ratio;
}

dem::MaterialCard card_at(const Study& study, const StudyCard& base, const DesignPoint& point) {
  dem::MaterialCard card = base.card;
  std::string setting;
  for (std::size_t p = 0; p < study.parameters.size(); ++p) {
    const Parameter& parameter = study.parameters[p];
    setting += fmt::format("{}{} = {:.6g}", p == 0 ? "" : ", ", parameter.key, point.values[p]);
    if (parameter.key != stiffness_ratio_key) dem::set_number(card, parameter.key, point.values[p]);
  }
  const std::string where = fmt::format("{}: vary, at {} of card {}", study.file.string(), setting, base.name);
  try {
    // After all others: what Kn is depends on them.
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
      if (study.parameters[p].key == stiffness_ratio_key) set_stiffness_ratio(card, point.values[p]);
  } catch (const dem::InputError& error) {
    throw dem::InputError(where, error.what(), "");
  }
  if (!study.parameters.empty()) card.validate(where);
  return card;
}

bool goes_through(const SpecimenRecipe& specimen, const VirtualTest& test) {
  return test.groups.empty() ||
         std::find(test.groups.begin(), test.groups.end(), specimen.group) != test.groups.end();
}

}  // namespace

Plan make_plan(Study study) {
  Plan plan;
  plan.study = std::move(study);
  const Study& s = plan.study;
  plan.points = design_points(s);
  const double count = static_cast<double>(plan.points.size()) * static_cast<double>(s.cards.size()) *
                       static_cast<double>(s.specimens.size()) * static_cast<double>(s.tests.size());
  if (count > most_tasks)
    throw dem::InputError(s.file.string(), fmt::format("there would be {:.3g} tasks", count),
                          "at most a million: take fewer specimens, values or tests");
  for (const StudyCard& base : s.cards)
    for (const DesignPoint& point : plan.points) plan.cards.push_back(card_at(s, base, point));
  plan.tasks.reserve(static_cast<std::size_t>(count));
  for (std::size_t specimen = 0; specimen < s.specimens.size(); ++specimen)
    for (std::size_t card = 0; card < s.cards.size(); ++card)
      for (std::size_t point = 0; point < plan.points.size(); ++point)
        for (std::size_t test = 0; test < s.tests.size(); ++test) {
          if (!goes_through(s.specimens[specimen], s.tests[test])) continue;
          Task task{plan.tasks.size() + 1, specimen, card, point, test, "", 0, 0};
          const dem::MaterialCard& material = plan.card_of(task);
          task.key = task_key(s.specimens[specimen], material, s.tests[test]);
          const Estimate estimate = estimate_test(s.specimens[specimen].packing, material, s.tests[test]);
          task.seconds = estimate.seconds;
          task.bytes = estimate.bytes;
          plan.tasks.push_back(std::move(task));
        }
  return plan;
}

std::vector<std::size_t> choose_tasks(const Plan& plan, const std::string& numbers, const std::string& where) {
  std::vector<std::size_t> chosen;
  if (numbers.empty()) {
    chosen.resize(plan.tasks.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    return chosen;
  }
  for (const std::uint64_t number : parse_number_list(numbers, 1, plan.tasks.size(), where))
    chosen.push_back(static_cast<std::size_t>(number - 1));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<std::size_t> share_of(const Plan& plan, const std::vector<std::size_t>& chosen, std::size_t index,
                                  std::size_t count) {
  std::vector<std::size_t> longest_first = chosen;
  std::stable_sort(longest_first.begin(), longest_first.end(),
                   [&](std::size_t a, std::size_t b) { return plan.tasks[a].seconds > plan.tasks[b].seconds; });
  std::vector<double> load(count, 0);
  std::vector<std::size_t> own;
  for (const std::size_t task : longest_first) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += plan.tasks[task].seconds;
    if (static_cast<std::size_t>(least - load.begin()) == index) own.push_back(task);
  }
  std::sort(own.begin(), own.end());
  return own;
}

}  // namespace study
