// The options of all virtual tests, each test's its own structure.
#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "specimens/virtual_tests/bending.h"
#include "specimens/virtual_tests/biaxial.h"
#include "specimens/virtual_tests/cyclic.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/shear.h"
#include "specimens/virtual_tests/spalling.h"
#include "specimens/virtual_tests/splitting.h"
#include "specimens/virtual_tests/triaxial.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace virtual_tests {

enum class TestKind {
  elastic,
  tension,
  compression,
  splitting,
  bending,
  shear,
  triaxial,
  biaxial,
  cyclic,
  spalling
};

/// Tension and compression share theirs.
using TestOptions = std::variant<ElasticOptions, UniaxialOptions, SplittingOptions, BendingOptions,
                                 ShearOptions, TriaxialOptions, BiaxialOptions, CyclicOptions, SpallingOptions>;

/// Which test these options are of.
TestKind kind_of(const TestOptions& options);

}  // namespace virtual_tests
