// What a uniaxial test's checkpoint keeps besides the assembly, and what it belongs to.
#pragma once
#include "specimens/virtual_tests/checkpoint_keeper.h"
#include "specimens/virtual_tests/uniaxial_record.h"

namespace virtual_tests {

/// Specimen, card and options; nothing if no file is kept, since hashing a specimen takes its time.
dem::Belonging belonging_of(const CheckpointPolicy& policy, const specimens::Specimen& specimen,
                            const dem::MaterialCard& card, const UniaxialOptions& options);

/// Every number of the record; `rebuilds`: of the contact list since the last stop.
dem::NamedNumbers numbers_of(const UniaxialRecord& record, int rebuilds);
/// Throws InputError that names `file` if a number is missing.
void set_from(UniaxialRecord& record, const dem::NamedNumbers& numbers, const std::filesystem::path& file);

}  // namespace virtual_tests
