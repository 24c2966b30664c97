// Vectors and matrices of the physics: aliases of Eigen's fixed-size types. SI units throughout.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dem {
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
}  // namespace dem
