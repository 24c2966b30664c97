#include "calibrate/test_bench.h"

#include <fmt/format.h>

#include <exception>

#include "libdem/core/sha256.h"
#include "libdem/io/hdf5.h"

namespace calibrate {
namespace {

constexpr const char* journal_format = "spall-calibration-journal";
constexpr std::size_t scalars = 10, columns = 6;

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
                             static_cast<double>(s.steps)};
  for (const virtual_tests::CurvePoint& p : s.curve)
    values.insert(values.end(), {p.strain, p.stress, p.strain_axial, p.strain_lateral, p.broken, p.unbalanced});
  return values;
}

TestSummary unpack(const std::vector<double>& v) {
  TestSummary s{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8] != 0, static_cast<std::int64_t>(v[9]), {}};
  for (std::size_t k = scalars; k + columns <= v.size(); k += columns)
    s.curve.push_back({v[k], v[k + 1], v[k + 2], v[k + 3], v[k + 4], v[k + 5]});
  return s;
}

TestSummary summarise(virtual_tests::UniaxialResult result) {
  return {result.peak_stress,          result.peak_strain,
          result.young_modulus,        result.poisson_ratio,
          result.work_of_fracture,     result.unbalanced_force_ratio,
          result.energy_balance_error, result.damage_ratio(),
          result.passed_peak,          result.steps,
          std::move(result.curve)};
}

}  // namespace

TestJournal::TestJournal(std::filesystem::path path, bool resume) : file(std::move(path)) {
  if (!resume || !std::filesystem::exists(file)) return;
  const dem::Hdf5File in = dem::open_spall_file(file, journal_format, 1);
  if (!in.has("tests")) return;
  for (const std::string& name : in.names_in("tests")) {
    const std::vector<double> values = in.read<double>("tests/" + name);
    if (values.size() >= scalars) summaries[name] = unpack(values);
  }
}

const TestSummary* TestJournal::find(const std::string& key) const {
  const auto found = summaries.find(key);
  return found == summaries.end() ? nullptr : &found->second;
}

void TestJournal::add(const std::string& key, TestSummary summary) { summaries[key] = std::move(summary); }

void TestJournal::save() const {
  if (file.empty()) return;
  dem::create_spall_file(file, journal_format, 1, [&](dem::Hdf5File& out) {
    for (const auto& [name, summary] : summaries) out.write("tests/" + name, pack(summary));
  });
}

TestBench::TestBench(const std::vector<specimens::Specimen>& wanted, TestProtocol how, TestJournal& results,
                     int thread_count)
    : all(wanted), protocol(how), journal(results), threads(thread_count) {
  for (const specimens::Specimen& specimen : all) specimen_hashes.push_back(specimen.sha256());
}

std::string TestBench::key(std::size_t specimen, const dem::MaterialCard& card,
                           const virtual_tests::UniaxialOptions& o) const {
  std::string text = specimen_hashes[specimen] + "|" + dem::identity_text(card);
  text += fmt::format("|{}|{}|{}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}", virtual_tests::name_of(o.loading),
                      dem::name_of(o.ends), o.axis, o.platen_friction, o.expected_strength, o.velocity, o.rate,
                      o.damping, o.time_step_fraction, o.stop_at, o.max_strain);
  return dem::sha256_of(text);
}

RoundResult TestBench::run(const dem::MaterialCard& card, Round round) {
  struct Task {
    std::size_t specimen;
    const virtual_tests::UniaxialOptions* options;
    std::string key;
    std::exception_ptr failure;
    TestSummary summary;
  };
  std::vector<Task> tasks;  // the longest first, so that the cores end together
  for (const auto& [wanted, options] :
       {std::pair(round.compression, &protocol.compression), std::pair(round.tension, &protocol.tension)})
    for (std::size_t s = 0; wanted && s < all.size(); ++s)
      tasks.push_back({s, options, key(s, card, *options), nullptr, {}});
  test_count += static_cast<long>(tasks.size());

  bool fresh = false;
  const auto count = static_cast<std::ptrdiff_t>(tasks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) reduction(|| : fresh)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    Task& task = tasks[static_cast<std::size_t>(k)];
    try {
      if (const TestSummary* known = journal.find(task.key)) {
        task.summary = *known;
        continue;
      }
      virtual_tests::UniaxialOptions options = *task.options;
      options.threads = 1;  // the bench uses the cores for specimens
      task.summary = summarise(virtual_tests::run_uniaxial(all[task.specimen], card, options));
      fresh = true;
    } catch (...) {
      task.failure = std::current_exception();
    }
  }
  RoundResult result;
  std::exception_ptr failure;
  for (Task& task : tasks) {
    if (task.failure) {
      if (!failure) failure = task.failure;
      continue;
    }
    if (journal.find(task.key) == nullptr) journal.add(task.key, task.summary);
    auto& list = task.options == &protocol.tension ? result.tension : result.compression;
    list.push_back(std::move(task.summary));
  }
  if (fresh) journal.save();
  if (failure) std::rethrow_exception(failure);
  return result;
}

}  // namespace calibrate
