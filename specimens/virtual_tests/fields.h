// The fields of a virtual test, at its end and on the way, for ParaView.
#pragma once
#include <filesystem>

#include "specimens/specimen.h"
#include "specimens/virtual_tests/curve_table.h"
#include "specimens/virtual_tests/final_fields.h"

namespace virtual_tests {

/// Writes the elements as points where they were at the start [m], with `radius` [m], `damage` [-],
/// `displacement` [m] and `coordination` (links that are not broken). VTKHDF. Throws RunError.
void write_element_fields(const std::filesystem::path& file, const specimens::Specimen& specimen,
                          const FinalFields& fields);

/// Writes the links as lines between the same points, with `state` (0 intact, 1 softening, 2 broken) and
/// `strain` (elongation over D_init) of each, and the points' `displacement` [m]. VTKHDF. Throws RunError.
void write_link_fields(const std::filesystem::path& file, const specimens::Specimen& specimen,
                       const FinalFields& fields);

/// Writes the test's pictures as frames (dem::FrameSeries): `elements` as points where they are, with `radius`
/// [m], `damage` [-] and `displacement` [m], `links` as lines for the broken ones only, `state` 2. What a
/// reader calls each moment is put together from the curve's first column. In place of frames of a former run.
/// Throws RunError.
void write_frames(const std::filesystem::path& folder, const specimens::Specimen& specimen, const Film& film,
                  const CurveTable& curve);

}  // namespace virtual_tests
