#include "calibrate/test_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <tuple>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/sha256.h"
#include "libdem/io/content.h"
#include "libdem/io/hdf5.h"
#include "libdem/run/checkpoint.h"
#include "specimens/virtual_tests/catalogue.h"

namespace calibrate {
namespace {

constexpr const char* journal_format = "spall-calibration-journal";
constexpr int journal_version = 3;
constexpr const char* start_anew = "start anew without --resume";
constexpr std::size_t scalars = 11, columns = 6;

std::vector<double> pack(const TestSummary& s) {
  std::vector<double> values{s.peak_stress,
                             s.peak_strain,
                             s.young_modulus,
                             s.poisson_ratio,
                             s.work_of_fracture,
                             s.unbalanced_force_ratio,
                             s.energy_balance_error,
                             s.damage,
                             s.passed_peak ? 1.0 : 0.0,
                             static_cast<double>(s.steps),
                             static_cast<double>(s.measured.size())};
  values.insert(values.end(), s.measured.begin(), s.measured.end());
  for (const virtual_tests::CurvePoint& p : s.curve)
    values.insert(values.end(), {p.strain, p.stress, p.strain_axial, p.strain_lateral, p.broken, p.unbalanced});
  return values;
}

/// Whether its counts are counts: a damaged file may hold any number there.
bool can_be_unpacked(const std::vector<double>& v) {
  constexpr double most_steps = 1e15;
  return v.size() >= scalars && v[9] >= 0 && v[9] <= most_steps && v[10] >= 0 &&
         v[10] <= static_cast<double>(v.size() - scalars);
}

TestSummary unpack(const std::vector<double>& v) {
  TestSummary s{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8] != 0, static_cast<std::int64_t>(v[9]),
                {},   {}};
  const auto measured = static_cast<std::size_t>(v[10]);
  const auto first = v.begin() + static_cast<std::ptrdiff_t>(scalars);
  s.measured.assign(first, first + static_cast<std::ptrdiff_t>(measured));
  for (std::size_t k = scalars + measured; k + columns <= v.size(); k += columns)
    s.curve.push_back({v[k], v[k + 1], v[k + 2], v[k + 3], v[k + 4], v[k + 5]});
  return s;
}

TestSummary summarise(virtual_tests::UniaxialResult result) {
  return {result.peak_stress,          result.peak_strain,
          result.young_modulus,        result.poisson_ratio,
          result.work_of_fracture,     result.unbalanced_force_ratio,
          result.energy_balance_error, result.damage_ratio(),
          result.passed_peak,          result.steps,
          std::move(result.curve),     {}};
}

}  // namespace

TestJournal::TestJournal(std::filesystem::path path, bool resume) : file(std::move(path)) {
  if (resume && std::filesystem::exists(file))
    read(dem::open_checkpoint(file, journal_format, journal_version));
}

void TestJournal::read(const dem::Hdf5File& in) {
  dem::require_spall_file(in, journal_format, journal_version);
  // Earlier versions name no SHA-256 of their content.
  if (const auto version = in.number_attribute<std::int32_t>("/", "format_version"); version < journal_version)
    throw dem::InputError(in.path().string(),
                          fmt::format("has {} format version {}, this Spall goes on from version {} alone",
                                      journal_format, version, journal_version),
                          start_anew);
  dem::ContentReader content(in, "tests/");
  std::map<std::string, TestSummary> found;
  for (const std::string& name : in.has("tests") ? in.names_in("tests") : std::vector<std::string>()) {
    const auto values = content.get<double>(name);
    if (!can_be_unpacked(values))
      throw dem::InputError(in.path().string(), fmt::format("is damaged: the test {} is not whole", name),
                            start_anew);
    found[name] = unpack(values);
  }
  content.require_seal();
  summaries = std::move(found);
}

const TestSummary* TestJournal::find(const std::string& key) const {
  const auto found = summaries.find(key);
  return found == summaries.end() ? nullptr : &found->second;
}

void TestJournal::add(const std::string& key, TestSummary summary) { summaries[key] = std::move(summary); }

void TestJournal::save_if_due() {
  if (pace.is_due()) save();
}

void TestJournal::save() {
  if (!file.empty()) pace.keep([&] { write(); });
}

void TestJournal::write() const {
  dem::create_spall_file(file, journal_format, journal_version, [&](dem::Hdf5File& out) {
    dem::ContentWriter content(out, "tests/");
    for (const auto& [name, summary] : summaries) content.put(name, pack(summary));
    content.seal();
  });
}

TestBench::TestBench(const std::vector<specimens::Specimen>& wanted, const TestProtocol& how,
                     TestJournal& results, int thread_count, std::vector<LaboratoryBench> others)
    : all(wanted), laboratory(std::move(others)), protocol(how), journal(results), threads(thread_count) {
  for (const specimens::Specimen& specimen : all) specimen_hashes.push_back(specimen.sha256());
  for (const LaboratoryBench& bench : laboratory) {
    laboratory_hashes.emplace_back();
    for (const specimens::Specimen& specimen : *bench.specimens)
      laboratory_hashes.back().push_back(specimen.sha256());
  }
}

namespace {

/// One test on one specimen.
struct Task {
  std::vector<TestSummary>* list;  ///< where its summary goes
  std::string key;
  std::function<TestSummary()> run;
  std::exception_ptr failure{};
  TestSummary summary{};
};

TestSummary summarise(const virtual_tests::TestOutcome& outcome, const LaboratoryTest& test) {
  TestSummary summary;
  for (const std::string& quantity : test.quantities) summary.measured.push_back(outcome.value(quantity));
  if (!outcome.run) return summary;
  summary.unbalanced_force_ratio = outcome.run->unbalanced_force_ratio;
  summary.energy_balance_error = outcome.run->energy_balance_error;
  summary.passed_peak = outcome.run->passed_peak;
  summary.steps = outcome.run->steps;
  return summary;
}

}  // namespace

RoundResult TestBench::run(const dem::MaterialCard& card, Round round) {
  const std::string card_text = dem::identity_text(card);
  const auto key_of = [&](const std::string& specimen, const virtual_tests::TestOptions& options,
                          const std::string& more) {
    return dem::sha256_of(
        fmt::format("{}|{}|{}|{}", specimen, card_text, virtual_tests::text_of(options), more));
  };
  RoundResult result;
  std::vector<Task> tasks;  // the longest first, so that the cores end together
  if (round.laboratory) {
    result.laboratory.resize(laboratory.size());
    for (std::size_t t = 0; t < laboratory.size(); ++t)
      for (std::size_t s = 0; s < all.size(); ++s) {
        const LaboratoryTest& test = *laboratory[t].test;
        const specimens::Specimen& specimen = (*laboratory[t].specimens)[s];
        tasks.push_back(
            {&result.laboratory[t],
             key_of(laboratory_hashes[t][s], test.options, fmt::format("{}", fmt::join(test.quantities, ","))),
             [&card, &specimen, &test] {
               virtual_tests::TestOptions options = test.options;
               virtual_tests::set_threads(options, 1);
               return summarise(virtual_tests::run_test(specimen, card, options), test);
             }});
      }
  }
  for (const auto& [wanted, options, list] :
       {std::tuple(round.compression, &protocol.compression, &result.compression),
        std::tuple(round.tension, &protocol.tension, &result.tension)})
    for (std::size_t s = 0; wanted && s < all.size(); ++s) {
      virtual_tests::UniaxialOptions own = *options;
      own.threads = 1;  // the bench uses the cores for specimens
      const specimens::Specimen& specimen = all[s];
      tasks.push_back({list, key_of(specimen_hashes[s], own, ""), [&card, &specimen, own] {
                         return summarise(virtual_tests::run_uniaxial(specimen, card, own));
                       }});
    }
  test_count += static_cast<long>(tasks.size());

  bool fresh = false;
  const auto count = static_cast<std::ptrdiff_t>(tasks.size());
  const dem::StopRequest* const stop = dem::stop_request();
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(|| : fresh)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    Task& task = tasks[static_cast<std::size_t>(k)];
    const dem::StopScope scope(stop);
    try {
      if (const TestSummary* known = journal.find(task.key)) {
        task.summary = *known;
        continue;
      }
      task.summary = task.run();
      fresh = true;
    } catch (...) {
      task.failure = std::current_exception();
    }
  }
  std::exception_ptr failure;
  for (Task& task : tasks) {
    if (task.failure) {
      if (!failure) failure = task.failure;
      continue;
    }
    if (journal.find(task.key) == nullptr) journal.add(task.key, task.summary);
    task.list->push_back(std::move(task.summary));
  }
  if (fresh) journal.save_if_due();
  if (failure) std::rethrow_exception(failure);
  return result;
}

}  // namespace calibrate
