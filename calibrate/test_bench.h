// The virtual laboratory of a fit: the same tests on several specimens, side by side on the cores, never twice.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"
#include "libdem/run/checkpoint_interval.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace dem {
class Hdf5File;
}

namespace calibrate {

/// What a fit keeps of one virtual test.
struct TestSummary {
  double peak_stress = 0, peak_strain = 0;  ///< [Pa], [-]
  double young_modulus = 0, poisson_ratio = 0;
  double work_of_fracture = 0;  ///< [J/m2]
  double unbalanced_force_ratio = 0, energy_balance_error = 0, damage = 0;
  bool passed_peak = false;
  std::int64_t steps = 0;
  virtual_tests::Curve curve;
  std::vector<double> measured;  ///< of another laboratory test: its quantities that are targets
};

/// Results by the hash of everything that they depend on. Saved between rounds of tests, so that a run that was
/// stopped replays what it had and goes on: bit for bit, since a test's result does not depend on when it was
/// computed. Rounds that are not in it are computed again.
class TestJournal {
 public:
  TestJournal() = default;
  /// `file` is written by the two below; read at once if `resume` and it exists. Throws InputError if it is no
  /// journal.
  TestJournal(std::filesystem::path file, bool resume);
  /// Takes over what an open journal holds. Throws InputError, and changes nothing, if it is none or damaged.
  void read(const dem::Hdf5File& journal);
  const TestSummary* find(const std::string& key) const;
  void add(const std::string& key, TestSummary summary);
  void save();
  /// After a round: saves unless the last time is too short ago (a second; more if saving takes long).
  void save_if_due();
  std::size_t size() const { return summaries.size(); }

 private:
  void write() const;

  std::filesystem::path file;
  dem::CheckpointPace pace{dem::seconds_between_checkpoints(1)};
  std::map<std::string, TestSummary> summaries;
};

/// How the tests of a case are run.
struct TestProtocol {
  virtual_tests::UniaxialOptions tension, compression;
};

struct Round {
  bool tension = false, compression = false;
  bool laboratory = false;  ///< all other tests
};

/// Summaries by specimen; empty for a test that was not asked for.
struct RoundResult {
  std::vector<TestSummary> tension, compression;
  std::vector<std::vector<TestSummary>> laboratory;  ///< by test
};

/// Another laboratory test and its specimens, as many as the bench has.
struct LaboratoryBench {
  const LaboratoryTest* test;
  const std::vector<specimens::Specimen>* specimens;
};

class TestBench {
 public:
  /// Keeps references: specimens and journal must outlive the bench.
  TestBench(const std::vector<specimens::Specimen>& specimens, const TestProtocol& protocol,
            TestJournal& journal, int threads, std::vector<LaboratoryBench> laboratory = {});

  /// Runs the tests of `round` with `card` on all specimens. Throws what a test throws, the first specimen's
  /// first; results that were complete are in the journal by then.
  RoundResult run(const dem::MaterialCard& card, Round round);

  /// Tests that were run or replayed, and steps of those run.
  long virtual_tests() const { return test_count; }
  const std::vector<specimens::Specimen>& specimens() const { return all; }
  const TestProtocol& test_protocol() const { return protocol; }

 private:
  const std::vector<specimens::Specimen>& all;
  std::vector<LaboratoryBench> laboratory;
  std::vector<std::string> specimen_hashes;
  std::vector<std::vector<std::string>> laboratory_hashes;  ///< by test
  TestProtocol protocol;
  TestJournal& journal;
  int threads;
  long test_count = 0;
};

}  // namespace calibrate
