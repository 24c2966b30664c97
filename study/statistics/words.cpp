#include "study/statistics/words.h"

#include <fmt/format.h>

namespace study::statistics {
namespace {

std::string sentence(const std::string& factor, double F, std::size_t between, std::size_t within, double p,
                     double eta_squared) {
  return fmt::format("{}: F({}, {}) = {:.2f}, {}, {} (eta^2 = {:.2f}).",
                     p < significance ? "Effect of " + factor + " shown"
                                      : "No effect of " + factor + " shown beyond the scatter",
                     between, within, F, p_words(p), effect_size_words(eta_squared), eta_squared);
}

}  // namespace

std::string effect_size_words(double eta_squared) {
  if (eta_squared < 0.01) return "negligible";
  if (eta_squared < 0.06) return "small";
  if (eta_squared < 0.14) return "medium";
  return "large";
}

std::string p_words(double p) {
  if (p < 0.001) return "p < 0.001";
  return fmt::format("p = {:.{}f}", p, p < 0.1 ? 3 : 2);
}

std::string words_of(const std::string& factor, const std::optional<OneWay>& test) {
  if (!test)
    return "Whether " + factor + " has an effect cannot be said: too few rows, or rows that do not scatter.";
  return sentence(factor, test->F, test->degrees_between, test->degrees_within, test->p, test->eta_squared);
}

std::string words_of(const Term& term, std::size_t residual_degrees) {
  if (term.degrees == 0)
    return "Whether " + term.factor + " has an effect cannot be said: it changes only together with others.";
  return sentence(term.factor, term.F, term.degrees, residual_degrees, term.p, term.partial_eta_squared);
}

}  // namespace study::statistics
