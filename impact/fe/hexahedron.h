// The eight-node hexahedron: trilinear shape functions on [-1, 1]^3, 2 x 2 x 2 Gauss points, stiffness and
// lumped mass of one element.
#pragma once
#include <array>
#include <optional>

#include "impact/fe/material.h"
#include "impact/fe/mesh.h"

namespace fe {

using ShapeValues = Eigen::Matrix<double, 8, 1>;     ///< N_J at a point [-]
using ShapeGradients = Eigen::Matrix<double, 8, 3>;  ///< dN_J/d(coordinate), a row a node
/// 24 degrees of freedom: (x, y, z) of the first node, then of the second, ...
using ElementMatrix = Eigen::Matrix<double, 24, 24>;
/// A weight at each Gauss point [-], in the order of gauss_points().
using GaussWeights = std::array<double, 8>;
inline constexpr GaussWeights unweighted = {1, 1, 1, 1, 1, 1, 1, 1};

/// How an element bends. Trilinear displacements alone are too stiff in bending (by 1/n^2 with n elements
/// through the thickness); incompatible modes add the parabolas that bending needs (Wilson, Taylor), eliminated
/// inside the element, in the form of Ibrahimbegovic and Wilson (1991) that passes the patch test.
enum class Formulation { trilinear, incompatible_modes };

/// Local coordinates of the 2 x 2 x 2 Gauss points, each of weight 1; the first coordinate runs fastest.
const std::array<Vec3, 8>& gauss_points();

ShapeValues shape_values(const Vec3& local);
/// By the local coordinates.
ShapeGradients local_gradients(const Vec3& local);
/// Row i: derivative of the position by local coordinate i [m].
Mat3 jacobian(const Corners& corners, const Vec3& local);
/// By the position [1/m].
ShapeGradients gradients(const Corners& corners, const Vec3& local);
/// The position of local coordinates [m].
Vec3 position(const Corners& corners, const Vec3& local);
/// The local coordinates of a position, to 1e-12, by Newton's method; nothing if it does not converge, which
/// happens only well outside the element.
std::optional<Vec3> local_coordinates(const Corners& corners, const Vec3& position);

/// Strain (xx, yy, zz, xy, yz, zx; the last three doubled) = B displacement [1/m].
Eigen::Matrix<double, 6, 24> strain_matrix(const ShapeGradients& gradients);

/// Integral of weight B^T C B [N/m]. Symmetric; six rigid motions cost nothing.
ElementMatrix element_stiffness(const Corners& corners, const Material& material, Formulation formulation,
                                const GaussWeights& weights = unweighted);

/// What each node carries of the element's weighted mass [kg]: integral of weight rho N_J, the row sums of the
/// consistent mass. Positive for every valid element.
ShapeValues lumped_mass(const Corners& corners, double density, const GaussWeights& weights = unweighted);

/// [m3]
double volume(const Corners& corners);

}  // namespace fe
