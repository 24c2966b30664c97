// The scene of an impact: what the case file says, checked, in SI units. Plain data; scene_file.h reads it,
// impact_run.h runs it.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "impact/coupling/kinematic_map.h"
#include "impact/coupling/multipliers.h"
#include "impact/fe/box_mesh.h"
#include "impact/impactors/impactor.h"
#include "libdem/core/input_file.h"
#include "libdem/material/material_card.h"
#include "specimens/packing.h"

namespace impact {

/// What the structure is made of: discrete elements throughout, or discrete elements in a zone and finite
/// elements around it.
enum class Model { de, coupled };

/// A region of the structure in which degrees of freedom are locked: of every discrete element whose centre,
/// and of every finite-element node that lies in the box [low, high]. The same physical support in both models.
struct Support {
  std::string name;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();        ///< [m]
  std::array<bool, 3> locked = {false, false, false};  ///< displacements along x, y, z
};

/// A point whose displacement is recorded: of the discrete element nearest to it, or, where only finite
/// elements are, of the finite elements at the point.
struct Probe {
  std::string name;
  Vec3 point = Vec3::Zero();  ///< before the impact [m]
};

/// How the impactor comes. It starts where it just touches the structure, along its path.
struct Approach {
  Vec3 aim = Vec3::Zero();          ///< a point on the path of its centre of mass [m]
  Vec3 direction = -Vec3::UnitZ();  ///< of its velocity, a unit vector
  double speed = 0;                 ///< [m/s]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vec3 spin = Vec3::Zero();  ///< [rad/s]
};

/// The structure is a box [0, size]. Its discrete elements are packed, or come from a specimen file.
struct Structure {
  std::optional<std::filesystem::path> specimen;  ///< HDF5; else packed:
  specimens::PackingOptions packing;  ///< of the whole box, or, coupled and not cut from it, of the zone alone
};

/// Which modulus of the pack the finite elements get, see coupling::PackModuli: that by which the structure
/// works.
enum class PackModulus { bulk, membrane, flexural };

/// The finite elements of the coupled model and how they are tied.
struct Surroundings {
  std::optional<std::filesystem::path> mesh_file;          ///< Gmsh; else structured:
  double mesh_unit = 1;                                    ///< length of the mesh file's unit [m]
  fe::BoxMeshOptions box;                                  ///< the whole structure, with the zone cut out
  Vec3 zone_low = Vec3::Zero(), zone_high = Vec3::Zero();  ///< that discrete elements fill [m]
  double overlap = 0;                                      ///< thickness [m]
  /// The zone's elements are those that the whole structure has there, packed or read as for Model::de.
  bool cut_from_whole = false;
  /// E and nu of the finite elements; empty: measured on the pack, E as `modulus` says.
  std::optional<double> young_modulus, poisson_ratio;
  PackModulus modulus = PackModulus::flexural;
  coupling::Ties ties = coupling::Ties::displacements;
  coupling::MultiplierSolve solve = coupling::MultiplierSolve::consistent;
  double relaxation_time = 0;  ///< [s]
  int interval = 0;            ///< finite-element forces every so many steps; 0: as many as are stable
};

struct Scene {
  std::string title;
  Model model = Model::de;
  dem::MaterialCard card;
  Structure structure;
  Vec3 size = Vec3::Zero();                  ///< of the structure [m]
  std::optional<Surroundings> surroundings;  ///< coupled only
  std::vector<Support> supports;
  std::optional<Impactor> impactor;  ///< none: the structure alone, for instance under an initial pulse
  Approach approach;
  std::vector<Probe> probes;
  double duration = 0;              ///< [s]
  double time_step_fraction = 0.5;  ///< of the critical time step
  double damping = 0;               ///< local (Cundall) damping of the discrete elements
  int frames = 20;                  ///< pictures for ParaView, evenly over the duration; 0: none
  double sample_interval = 0;       ///< of histories [s]; 0: a two-thousandth of the duration
  /// f_c of the concrete [Pa], for the penetration formulas beside the result alone; 0: not known. The model
  /// takes its strength from the card.
  double compressive_strength = 0;
  std::uint64_t seed = 1;
  std::vector<dem::InputFile>
      inputs;  ///< every file that was read, the case itself first; none has another's `what`
};

}  // namespace impact
