#include "study/plan_key.h"

#include <fmt/format.h>

#include "libdem/core/sha256.h"
#include "libdem/law/cohesive_link.h"

namespace study {

std::string key_text(const SpecimenRecipe& recipe) {
  if (!recipe.file.empty()) return "specimen " + recipe.sha256;
  const specimens::PackingOptions& p = recipe.packing;
  return fmt::format("packed {}|{}|{:a} {:a} {:a}|{}|{}|{}|{:a}|{:a}|{:a}|{:a}", packing_version,
                     specimens::name_of(p.shape), p.size.x(), p.size.y(), p.size.z(), p.elements, p.seed,
                     static_cast<int>(p.grading.kind), p.grading.size_ratio, p.grading.log_deviation,
                     p.dense_solid_fraction, p.solid_fraction);
}

std::string key_of(const SpecimenRecipe& recipe) { return dem::sha256_of(key_text(recipe)); }

std::string task_key(const SpecimenRecipe& recipe, const dem::MaterialCard& card, const VirtualTest& test) {
  const std::string text = fmt::format("spall-study-result {}|{}", result_version, key_text(recipe));
  if (test.kind == TestKind::elastic) {
    const dem::LinkLaw law = dem::make_link_law(card);
    return dem::sha256_of(fmt::format("{}|{}|{:a}|{:a}", text, virtual_tests::text_of(test.options),
                                      law.normal_modulus, law.shear_ratio));
  }
  return dem::sha256_of(
      fmt::format("{}|{}|{}", text, dem::identity_text(card), virtual_tests::text_of(test.options)));
}

}  // namespace study
