// The results of a study as one plain table: a row for each specimen, setting and test.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "study/folder.h"
#include "study/plan.h"
#include "study/task_result.h"

namespace study {

/// What went in and what came out of one task. Lengths in m, everything else SI.
struct Row {
  std::size_t task = 0;  ///< its number in the plan
  std::string key;       ///< of its result
  std::string specimen;  ///< the name of its [[specimen]]
  std::uint64_t seed = 0;
  std::string shape;  ///< "box" or "cylinder"
  dem::Vec3 size = dem::Vec3::Zero();
  std::size_t elements = 0;
  double element_size = 0;  ///< (volume / elements)^(1/3)
  std::string card;
  std::size_t point = 0;           ///< of the design, from 1
  std::string block;               ///< of a sensitivity design: "A", "B", "AB1", ...; else empty
  std::size_t base = 0;            ///< of a sensitivity design: the row of A and B, from 0
  std::vector<double> parameters;  ///< one for each of RowTable::parameters
  std::string test;                ///< the test's name in the study
  TestKind kind = TestKind::elastic;
  std::vector<std::pair<std::string, Value>> values;  ///< the test's keys: E, nu, peak_stress, ...

  /// NaN if the row has no such number.
  double number(const std::string& name) const;
};

struct RowTable {
  std::vector<std::string> parameters;                      ///< keys of what varies, as in [vary]
  std::vector<Row> rows;                                    ///< finished tasks in the plan's order
  std::size_t tasks = 0;                                    ///< of the whole plan
  std::vector<std::pair<std::size_t, std::string>> failed;  ///< number and message of the tasks that failed
};

/// Reads the results that are in the folder. Throws InputError if one is damaged.
RowTable read_rows(const Plan& plan, const StudyFolder& folder);

/// A quantity of a study: what `name` says of the rows of one test. "E" and "nu" are the elastic test's, "ft"
/// and "fc" the peak stresses of tension and compression; all others are called "test.key", as in
/// "tension.peak_strain", and so are these where a test has a name of its own.
struct Quantity {
  std::string name, test, key;
};
/// The quantities of the study's tests, in the tests' order.
std::vector<Quantity> quantities_of(const Study& study);

/// A test's rows that have a finite value of the quantity, and these values: same length, in the rows' order.
struct Sample {
  std::vector<const Row*> rows;
  std::vector<double> values;
};
Sample sample_of(const std::vector<const Row*>& rows, const Quantity& quantity);
Sample sample_of(const RowTable& table, const Quantity& quantity);

/// The rows of each setting: index card * points + point, as Plan::cards.
std::vector<std::vector<const Row*>> rows_by_setting(const Plan& plan, const RowTable& table);

}  // namespace study
