// Where the elements of a packing start: a jittered lattice, so that the density is even from the beginning.
#pragma once
#include <cstddef>
#include <vector>

#include "libdem/core/random.h"
#include "specimens/specimen.h"

namespace specimens {

/// `count` places inside the shape, spread evenly, each moved at random within its own lattice cell; in Hilbert
/// order. Uniform random points would do as well for disorder, but their density varies four times as much from
/// slice to slice.
std::vector<Vec3> start_sites(Shape shape, const Vec3& size, std::size_t count, dem::Random& random);

/// Hands the ascending `radii` out to sites in Hilbert order so that each stretch of eight sites gets one of
/// each eighth of the sizes: nowhere do large or small ones gather by chance.
std::vector<double> spread_evenly(const std::vector<double>& radii, dem::Random& random);

}  // namespace specimens
