// Makes a Rig's test ready for the catalogue.
#pragma once
#include <memory>
#include <optional>

#include "libdem/core/sha256.h"
#include "specimens/virtual_tests/catalogue.h"
#include "specimens/virtual_tests/rig_run.h"
#include "specimens/virtual_tests/test_description.h"

namespace virtual_tests {

/// `make(specimen, card, options)` gives the rig of a test whose options hold QuasiStaticOptions as `run`.
template <class Options>
TestDescription rig_test(std::unique_ptr<Rig> (*make)(const specimens::Specimen&, const dem::MaterialCard&,
                                                      const Options&)) {
  TestDescription test;
  test.defaults = Options{};
  test.check = [make](const specimens::Specimen& specimen, const dem::MaterialCard& card,
                      const TestOptions& options) {
    const Options& asked = std::get<Options>(options);
    asked.run.validate();
    make(specimen, card, asked);
  };
  test.run = [make](const specimens::Specimen& specimen, const dem::MaterialCard& card,
                    const TestOptions& options, const dem::ProgressCallback& progress,
                    const CheckpointPolicy& checkpoint) {
    const Options& asked = std::get<Options>(options);
    asked.run.validate();
    const std::unique_ptr<Rig> rig = make(specimen, card, asked);
    return run_rig(*rig, card, asked.run, dem::sha256_of(text_of(options)), progress, checkpoint);
  };
  return test;
}

}  // namespace virtual_tests
