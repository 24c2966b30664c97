// Does a quantity depend on shape, size, element size or a parameter beyond the scatter of the disorder?
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "study/statistics/analysis_of_variance.h"
#include "study/statistics/rank_test.h"
#include "study/statistics/reference_test.h"
#include "study/statistics/summary.h"
#include "study/statistics/words.h"
#include "study/study_statistics_parts.h"

namespace study {
namespace {

/// Specimens that differ by nothing but the seed.
struct Group {
  const Row* row = nullptr;  ///< its first
  std::string name;
  std::vector<double> values;
};

bool same_kind(const Row& a, const Row& b) {
  return a.specimen == b.specimen && a.shape == b.shape && a.size == b.size && a.elements == b.elements;
}

/// In the study's order. Named by their [[specimen]], and by size and elements where it has several.
std::vector<Group> groups_of(const Sample& sample) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < sample.rows.size(); ++k) {
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return same_kind(*g.row, *sample.rows[k]); });
    if (found == groups.end())
      found = groups.insert(groups.end(), Group{sample.rows[k], sample.rows[k]->specimen, {}});
    found->values.push_back(sample.values[k]);
  }
  for (Group& group : groups) {
    const auto kinds = std::count_if(groups.begin(), groups.end(), [&](const Group& other) {
      return other.row->specimen == group.row->specimen;
    });
    const dem::Vec3& size = group.row->size;
    if (kinds > 1)
      group.name = fmt::format("{}, {:.4g}x{:.4g}x{:.4g} m, {} elements", group.row->specimen, size.x(),
                               size.y(), size.z(), group.row->elements);
  }
  return groups;
}

Json groups_json(const std::vector<Group>& groups) {
  Json json = Json::array();
  for (const Group& group : groups) {
    const statistics::Summary s = statistics::summarise(group.values);
    json.push_back({{"specimen", group.name},
                    {"count", s.count},
                    {"mean", s.mean},
                    {"std", number_or_null(s.standard_deviation)},
                    {"spread_rel", number_or_null(s.spread)}});
  }
  return json;
}

/// The groups of one specimen, each against the scatter of the largest group.
Json against_reference_json(const std::vector<Group>& groups) {
  const Group& reference = *std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
    return a.values.size() < b.values.size();
  });
  std::vector<const Group*> others;
  std::vector<double> p;
  std::vector<statistics::Outsider> tests;
  for (const Group& group : groups) {
    if (group.values.size() != 1) continue;
    const auto test = statistics::outsider(group.values.front(), reference.values);
    if (!test) continue;
    others.push_back(&group), tests.push_back(*test), p.push_back(test->p);
  }
  if (others.empty()) return nullptr;
  Json json{{"reference", reference.name},
            {"smallest_visible_deviation", statistics::smallest_visible_deviation(reference.values)},
            {"specimens", Json::array()}};
  const std::vector<double> adjusted = statistics::holm(p);
  for (std::size_t k = 0; k < others.size(); ++k)
    json["specimens"].push_back({{"specimen", others[k]->name},
                                 {"deviation", tests[k].deviation},
                                 {"p", tests[k].p},
                                 {"p_holm", adjusted[k]}});
  return json;
}

void add_group_tests(Json& json, const std::vector<Group>& groups) {
  statistics::Groups values;
  for (const Group& group : groups) values.push_back(group.values);
  const auto test = statistics::one_way(values);
  json["effect_of_groups"]["words"] = statistics::words_of("the kind of specimen", test);
  if (test)
    json["effect_of_groups"].update({{"F", test->F},
                                     {"degrees", {test->degrees_between, test->degrees_within}},
                                     {"p", test->p},
                                     {"eta_squared", test->eta_squared},
                                     {"omega_squared", test->omega_squared}});
  if (const auto ranks = statistics::kruskal_wallis(values))
    json["rank_test"] = {{"H", ranks->H}, {"degrees", ranks->degrees}, {"p", ranks->p}};
  if (const auto robust = statistics::welch(values))
    json["welch"] = {
        {"F", robust->F}, {"degrees", {robust->degrees_between, robust->degrees_within}}, {"p", robust->p}};
  if (Json reference = against_reference_json(groups); !reference.is_null())
    json["against_reference"] = std::move(reference);
}

/// Levels by the text that tells them apart. A factor with one level is none.
void add_factor(std::vector<statistics::Factor>& factors, const Sample& sample, const std::string& name,
                const std::function<std::string(const Row&)>& level_of) {
  std::map<std::string, std::size_t> known;
  statistics::Factor factor{name, {}};
  for (const Row* row : sample.rows)
    factor.levels.push_back(known.try_emplace(level_of(*row), known.size()).first->second);
  if (known.size() > 1) factors.push_back(std::move(factor));
}

std::vector<statistics::Factor> factors_of(const Plan& plan, const Sample& sample) {
  std::vector<statistics::Factor> factors;
  add_factor(factors, sample, "shape and size", [](const Row& row) {
    return fmt::format("{} {:.4g} {:.4g} {:.4g}", row.shape, row.size.x(), row.size.y(), row.size.z());
  });
  // Counts are whole, so equal element sizes differ in the last digits.
  add_factor(factors, sample, "element size",
             [](const Row& row) { return fmt::format("{:.2e}", row.element_size); });
  add_factor(factors, sample, "card", [](const Row& row) { return row.card; });
  for (std::size_t p = 0; p < plan.study.parameters.size(); ++p)
    add_factor(factors, sample, plan.study.parameters[p].key,
               [p](const Row& row) { return fmt::format("{}", row.parameters[p]); });
  return factors;
}

Json factors_json(const std::vector<statistics::Factor>& factors, const Sample& sample) {
  const auto effects = statistics::main_effects(sample.values, factors);
  if (!effects) return nullptr;
  Json json = Json::array();
  for (const statistics::Term& term : effects->terms)
    json.push_back({{"factor", term.factor},
                    {"F", number_or_null(term.F)},
                    {"degrees", {term.degrees, effects->residual_degrees}},
                    {"p", number_or_null(term.p)},
                    {"eta_squared", term.eta_squared},
                    {"partial_eta_squared", term.partial_eta_squared},
                    {"words", statistics::words_of(term, effects->residual_degrees)}});
  return json;
}

}  // namespace

Json effects_json(const Plan& plan, const Sample& sample, bool one_setting) {
  Json json = Json::object();
  const std::vector<Group> groups = groups_of(sample);
  if (one_setting && groups.size() > 1) {
    json["groups"] = groups_json(groups);
    add_group_tests(json, groups);
  }
  if (const auto factors = factors_of(plan, sample); !factors.empty())
    if (Json effects = factors_json(factors, sample); !effects.is_null()) json["factors"] = std::move(effects);
  return json;
}

}  // namespace study
