#include "calibrate/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "calibrate/specimen_set.h"
#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/parallel.h"
#include "specimens/virtual_tests/elastic.h"

namespace calibrate {
namespace {

using specimens::Specimen;

std::vector<LaboratoryBench> laboratory_benches(const CalibrationCase& wanted, const SpecimenSet& set) {
  std::vector<LaboratoryBench> benches;
  for (std::size_t t = 0; t < wanted.laboratory.size(); ++t)
    benches.push_back(
        {&wanted.laboratory[t], wanted.laboratory[t].packing ? &set.laboratory[t] : &set.specimens});
  return benches;
}

/// Where the fit starts if the case does not say. The tables are measured on a 2,700-element box (nu 0.2); they
/// only save evaluations. Where zeta is left to fc/ft, the start is the most brittle pair: Co so high that fc
/// no longer feels it, zeta just large enough for the ratio. The fit lowers Co from there.
void choose_start(const CalibrationCase& wanted, dem::MaterialCard& card) {
  static const std::vector<std::pair<double, double>> zeta_by_ratio_free{
      {5.5, 3}, {9.0, 8}, {10.9, 15}, {12.9, 25}, {16.3, 40}};
  static const std::vector<std::pair<double, double>> zeta_by_ratio_fixed{
      {7.5, 3}, {11.8, 8}, {15.2, 15}, {18.2, 25}, {22.4, 40}};
  const Target* ft = wanted.target(Quantity::tensile_strength);
  const Target* fc = wanted.target(Quantity::compressive_strength);
  const bool tension_sees_zeta = wanted.target(Quantity::tension_peak_strain) != nullptr ||
                                 wanted.target(Quantity::fracture_energy) != nullptr ||
                                 wanted.target(Quantity::tension_curve) != nullptr;
  card.softening = wanted.softening.value;
  const bool moments = card.link_law == dem::LinkLawKind::moment_transfer;
  card.slip_softening = wanted.slip_softening.value;
  if (!moments && !wanted.softening.given && !tension_sees_zeta && ft != nullptr && fc != nullptr) {
    const bool fixed = wanted.compression.ends == dem::EndCondition::fixed;
    card.softening = std::clamp(
        1.1 * log_interpolate(fixed ? zeta_by_ratio_fixed : zeta_by_ratio_free, fc->value / ft->value), 1.0,
        60.0);
  }
  card.softening = std::clamp(card.softening, wanted.softening.low, wanted.softening.high);
  const double expected = ft != nullptr ? ft->value : 0.1 * fc->value;
  card.tensile_strength = wanted.tensile_strength.given ? wanted.tensile_strength.value
                                                        : expected / expected_strength_ratio(card.softening);
  card.tensile_strength =
      std::clamp(card.tensile_strength, wanted.tensile_strength.low, wanted.tensile_strength.high);
  // With moments and slip softening of 16, fc is about 8 T (Co/T)^0.6, half as much again without slip
  // softening.
  const double likely_cohesion =
      moments && fc != nullptr
          ? card.tensile_strength * std::pow(fc->value / (5 * card.tensile_strength), 1 / 0.6)
          : 5 * card.tensile_strength;
  card.cohesion = wanted.cohesion.given ? wanted.cohesion.value : likely_cohesion;
  card.cohesion = std::clamp(card.cohesion, wanted.cohesion.low, wanted.cohesion.high);
}

std::vector<virtual_tests::ElasticResult> elastic_results(const std::vector<Specimen>& specimens,
                                                          const dem::MaterialCard& card, int threads) {
  std::vector<virtual_tests::ElasticResult> results(specimens.size());
  dem::for_each_in_parallel(specimens.size(), threads, [&](std::size_t k) {
    results[k] = virtual_tests::run_elastic(specimens[k], card);
  });
  return results;
}

/// The finished card on a set of specimens, specimen by specimen.
std::vector<SpecimenOutcome> outcomes(const CalibrationCase& wanted, const SpecimenSet& set, TestBench& bench,
                                      const dem::MaterialCard& card, Round round, bool seen, int threads) {
  const auto elastic = elastic_results(set.specimens, card, threads);
  const RoundResult tests = bench.run(card, round);
  std::vector<SpecimenOutcome> list;
  for (std::size_t s = 0; s < set.specimens.size(); ++s) {
    SpecimenOutcome o;
    o.label = set.labels[s];
    o.sha256 = set.specimens[s].sha256();
    o.elements = set.specimens[s].elements();
    o.links = set.specimens[s].links.size();
    o.seen = seen;
    o.young_modulus = elastic[s].young_modulus;
    o.poisson_ratio = elastic[s].poisson_ratio;
    RoundResult own;
    if (!tests.tension.empty()) own.tension = {tests.tension[s]}, o.tension = tests.tension[s];
    if (!tests.compression.empty())
      own.compression = {tests.compression[s]}, o.compression = tests.compression[s];
    for (const std::vector<TestSummary>& of_test : tests.laboratory) own.laboratory.push_back({of_test[s]});
    for (const Target& target : wanted.targets) {
      if (target.quantity == Quantity::young_modulus)
        o.targets.push_back({target, o.young_modulus});
      else if (target.quantity == Quantity::poisson_ratio)
        o.targets.push_back({target, o.poisson_ratio});
      else
        o.targets.push_back({target, achieved(target, own, wanted)});
    }
    list.push_back(std::move(o));
  }
  return list;
}

std::vector<TargetResult> mean_targets(const std::vector<SpecimenOutcome>& list) {
  std::vector<TargetResult> mean = list.empty() ? std::vector<TargetResult>{} : list.front().targets;
  for (std::size_t t = 0; t < mean.size(); ++t) {
    mean[t].achieved = 0;
    for (const SpecimenOutcome& o : list)
      mean[t].achieved += o.targets[t].achieved / static_cast<double>(list.size());
  }
  return mean;
}

std::string in_words(const TargetResult& r) {
  const Display d = display(r.target);
  if (is_curve(r.target.quantity))
    return fmt::format("{}: {:.2g}% of the peak off (allowed {:.2g}%)", d.words, 100 * r.achieved,
                       100 * r.target.tolerance);
  return fmt::format("{} {:.4g} {} against {:.4g} ({:+.1f}%, allowed {:.2g}%)", d.words, r.achieved / d.scale,
                     d.unit, r.target.value / d.scale, 100 * r.relative_error(), 100 * r.target.tolerance);
}

void judge(const CalibrationCase& wanted, CalibrationResult& result) {
  for (const TargetResult& r : result.targets)
    if (!r.met()) result.warnings.push_back("target missed: " + in_words(r));
  for (const ParameterVerdict& p : result.identifiability.parameters)
    if (!p.remark.empty()) result.warnings.push_back(p.remark);
  for (const SpecimenOutcome& o : result.specimens) {
    for (const auto& [test, name] :
         {std::pair(&o.tension, "tension"), std::pair(&o.compression, "compression")}) {
      if (test->curve.empty()) continue;
      if (test->unbalanced_force_ratio > 0.05)
        result.warnings.push_back(
            fmt::format("{} of {} is not quasi-static: the platens differ by {:.1f}%; lower its rate", name,
                        o.label, 100 * test->unbalanced_force_ratio));
      if (!test->passed_peak)
        result.warnings.push_back(
            fmt::format("{} of {} ended at its strain limit without a peak", name, o.label));
    }
    if (o.seen) continue;
    for (const TargetResult& r : o.targets) {
      // A strain at the peak scatters more than a strength: its own, wider tolerance counts where it is wider.
      const double allowed = std::max(wanted.check_tolerance, r.target.tolerance);
      if (std::abs(r.relative_error()) > allowed)
        result.warnings.push_back(
            fmt::format("unseen {}: {}", o.label,
                        in_words({{r.target.quantity, r.target.value, allowed, ""}, r.achieved})));
    }
  }
}

void write_provenance(const CalibrationCase& wanted, CalibrationResult& result) {
  auto& notes = result.card.provenance;
  notes.clear();
  notes.emplace_back("case", wanted.name);
  if (!wanted.concrete.empty()) notes.emplace_back("concrete", wanted.concrete);
  for (std::size_t t = 0; t < result.targets.size(); ++t) {
    const TargetResult& r = result.targets[t];
    std::string text = in_words(r) + (r.met() ? ", met" : ", MISSED") + "; source: " + r.target.source;
    if (t < result.unseen_targets.size() && !is_curve(r.target.quantity))
      text += fmt::format("; unseen specimens {:+.1f}%", 100 * result.unseen_targets[t].relative_error());
    notes.emplace_back(fmt::format("target_{}", name_of(r.target)), text);
  }
  std::string fitted, unseen;
  for (const SpecimenOutcome& o : result.specimens) {
    std::string& list = o.seen ? fitted : unseen;
    list += (list.empty() ? "" : ", ") + o.label;
  }
  notes.emplace_back("fitted_on", fitted);
  notes.emplace_back("checked_on", unseen.empty() ? "no unseen specimen"
                                                  : fmt::format("{}: worst single error {:.1f}%", unseen,
                                                                100 * result.worst_unseen_error));
  notes.emplace_back("end_condition",
                     fmt::format("tension {}, compression {}", dem::name_of(wanted.tension.ends),
                                 dem::name_of(wanted.compression.ends)));
  for (const ParameterVerdict& p : result.identifiability.parameters)
    notes.emplace_back("uncertainty_" + p.name,
                       p.remark.empty()
                           ? fmt::format("{:.0f}% within the targets' tolerances", 100 * p.relative_uncertainty)
                           : p.remark);
  const dem::Mat3& c = result.elastic.covariance;
  notes.emplace_back("standard_errors",
                     fmt::format("alpha {:.3f}, beta {:.3f}, gamma {:.3f}", std::sqrt(c(0, 0)),
                                 std::sqrt(c(1, 1)), std::sqrt(c(2, 2))));
  for (std::size_t k = 0; k < wanted.notes.size(); ++k)
    notes.emplace_back(fmt::format("note_{}", k + 1), wanted.notes[k]);
}

CalibrationResult fit(const CalibrationCase& wanted, TestJournal& journal, int threads,
                      const dem::ProgressCallback& progress) {
  const auto start = std::chrono::steady_clock::now();
  CalibrationResult result;
  const auto report = [&](const std::string& stage, double done, double total, const std::string& detail) {
    if (progress) progress({stage, done, total, "evaluations", detail});
    if (dem::interrupt_requested()) throw dem::Interrupted("stopped by a signal");
  };

  report("specimens", 0, 0,
         fmt::format("packing {} specimens", wanted.fit_seeds.size() + wanted.check_seeds.size()));
  const SpecimenSet fitted = make_set(wanted, wanted.fit_seeds, wanted.fit_centres, threads);
  const SpecimenSet unseen = make_set(wanted, wanted.check_seeds, wanted.check_centres, threads);

  report("elastic", 0, 0, "alpha, beta, gamma over nine ratios Ks/Kn");
  const double nu = wanted.target(Quantity::poisson_ratio)->value;
  result.elastic = fit_elastic(fitted.specimens, nu, threads);
  dem::MaterialCard card = wanted.card;
  card.name = wanted.name;
  card.young_modulus = wanted.target(Quantity::young_modulus)->value;
  card.poisson_ratio = nu;
  card.alpha = result.elastic.alpha, card.beta = result.elastic.beta, card.gamma = result.elastic.gamma;
  choose_start(wanted, card);

  TestBench bench(fitted.specimens, protocol_for(wanted), journal, threads, laboratory_benches(wanted, fitted));
  const StageWatcher watch = [&](const StageStep& step) {
    result.history.push_back(step);
    std::string detail =
        fmt::format("T {:.3g} MPa, zeta {:.3g}, Co {:.3g} MPa", step.card.tensile_strength / 1e6,
                    step.card.softening, step.card.cohesion / 1e6);
    if (wanted.slip_softening.free) detail += fmt::format(", slip softening {:.3g}", step.card.slip_softening);
    detail += ':';
    for (const TargetResult& r : step.targets) {
      const Display d = display(r.target);
      detail += fmt::format(" {} {:.3g}/{:.3g}", name_of(r.target), r.achieved / d.scale,
                            (is_curve(r.target.quantity) ? r.target.tolerance : r.target.value) / d.scale);
    }
    report(step.stage, step.evaluation, 0, detail);
  };

  const auto has = [&](Quantity q) { return wanted.target(q) != nullptr; };
  const bool strain_or_energy =
      has(Quantity::tension_peak_strain) || has(Quantity::fracture_energy) || has(Quantity::tension_curve);
  std::vector<ParameterSlot> tension_slots{slot_T()};
  if (strain_or_energy) tension_slots.push_back(slot_zeta());  // ft alone cannot tell T from zeta
  const std::vector<Quantity> tension_targets{Quantity::tensile_strength, Quantity::tension_peak_strain,
                                              Quantity::fracture_energy, Quantity::tension_curve};
  const std::vector<Quantity> compression_targets{
      Quantity::compressive_strength, Quantity::compression_peak_strain, Quantity::compression_curve};
  std::vector<Quantity> all_targets = tension_targets;
  all_targets.insert(all_targets.end(), compression_targets.begin(), compression_targets.end());
  all_targets.push_back(Quantity::laboratory);
  Round all{false, false, !wanted.laboratory.empty()};
  for (const Target& t : wanted.targets)
    all.tension = all.tension || needs_tension(t.quantity),
    all.compression = all.compression || needs_compression(t.quantity);

  result.stages.push_back(fit_stage("tension", wanted, bench, card, tension_slots, tension_targets,
                                    {true, false}, {.good_enough = 0.25, .max_evaluations = 15}, watch));
  result.stages.push_back(fit_stage("compression", wanted, bench, card, {slot_Co(), slot_zeta_s()},
                                    compression_targets, {false, true},
                                    {.first_radius = 1, .good_enough = 0.25, .max_evaluations = 8}, watch));
  result.stages.push_back(fit_stage("closing", wanted, bench, card, free_slots(wanted), all_targets, all,
                                    {.good_enough = 0.4, .max_evaluations = 20}, watch));

  report("sensitivity", 0, 0, "what the data determine");
  result.identifiability = assess(wanted, bench, card);

  report("check", 0, 0, fmt::format("{} specimens that the fit never saw", unseen.specimens.size()));
  TestBench check(unseen.specimens, protocol_for(wanted), journal, threads, laboratory_benches(wanted, unseen));
  const Round each{true, true, true};  // the finished card shows both tests, aimed at or not
  result.specimens = outcomes(wanted, fitted, bench, card, each, true, threads);
  result.targets = mean_targets(result.specimens);
  if (!unseen.specimens.empty()) {
    std::vector<SpecimenOutcome> fresh = outcomes(wanted, unseen, check, card, each, false, threads);
    result.unseen_targets = mean_targets(fresh);
    for (const SpecimenOutcome& o : fresh)
      for (const TargetResult& r : o.targets)
        if (!is_curve(r.target.quantity))
          result.worst_unseen_error = std::max(result.worst_unseen_error, std::abs(r.relative_error()));
    result.specimens.insert(result.specimens.end(), std::make_move_iterator(fresh.begin()),
                            std::make_move_iterator(fresh.end()));
  }
  result.card = card;
  judge(wanted, result);
  write_provenance(wanted, result);
  result.virtual_tests = bench.virtual_tests() + check.virtual_tests();
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

bool CalibrationResult::all_met() const {
  return std::all_of(targets.begin(), targets.end(), [](const TargetResult& r) { return r.met(); });
}

CalibrationResult calibrate(const CalibrationCase& wanted, TestJournal& journal, int threads,
                            const dem::ProgressCallback& progress) {
  try {
    CalibrationResult result = fit(wanted, journal, threads, progress);
    journal.save();
    return result;
  } catch (const dem::Interrupted&) {
    journal.save();
    throw;
  }
}

}  // namespace calibrate
