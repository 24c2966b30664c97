// Specimens on disk: HDF5 files of format "spall-specimen".
#pragma once
#include <filesystem>

#include "specimens/specimen.h"

namespace dem {
class Hdf5File;
}

namespace specimens {

inline constexpr int specimen_format_version = 1;

/// Writes the file whole or not at all. Throws RunError.
///
/// Attributes of the root: shape, size [m], seed, interaction_radius_factor, origin, sha256. Datasets:
/// elements/centre (N x 3) and elements/radius (N) [m]; links/elements (L x 2, indices, a < b, sorted) and
/// links/initial_distance (L) [m].
void write_specimen(const std::filesystem::path& file, const Specimen& specimen);

/// Throws InputError if the file is of another kind, damaged (its content does not have the SHA-256 that it
/// names), or holds what no specimen can: values that are not finite, elements outside the shape, links that
/// are unsorted, doubled or point nowhere.
Specimen read_specimen(const std::filesystem::path& file);
/// The same of a file that is open.
Specimen read_specimen(const dem::Hdf5File& file);

}  // namespace specimens
