// An impact from the scene to its result: the phases of a run in order.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "impact/outcome/fragments.h"
#include "impact/outcome/slab_damage.h"
#include "impact/scene.h"
#include "libdem/core/progress.h"
#include "libdem/run/step.h"
#include "specimens/specimen.h"

namespace impact {

/// Where energy is, all in joules. In balance: initial = kinetic + ... + damping, up to the scheme's error.
struct ImpactEnergy {
  double initial = 0;                               ///< kinetic energy at the start, of everything that moves
  double elements = 0, impactor = 0, nodes = 0;     ///< kinetic
  double elastic = 0;                               ///< in links and contacts between elements
  double finite_elastic = 0;                        ///< in the finite elements
  double contact = 0;                               ///< in the contacts with the impactor
  double softening = 0, sliding = 0, damping = 0;   ///< dissipated among the elements
  double contact_sliding = 0, contact_damping = 0;  ///< dissipated between impactor and elements
  double ties = 0;                                  ///< dissipated by the ties of the overlap

  double final_sum() const {
    return elements + impactor + nodes + elastic + finite_elastic + contact + softening + sliding + damping +
           contact_sliding + contact_damping + ties;
  }
  double imbalance() const { return initial - final_sum(); }
};

/// One row of the histories.
struct Sample {
  double time = 0;                 ///< [s]
  std::vector<Vec3> displacement;  ///< of each probe, in the scene's order [m]
  Vec3 force = Vec3::Zero();       ///< of the structure on the impactor, mean since the last sample [N]
  Vec3 impactor_position = Vec3::Zero(), impactor_velocity = Vec3::Zero();
  std::size_t broken_links = 0;  ///< when they were last counted
  ImpactEnergy energy;           ///< as it was last taken
};

/// The state as it is now, for pictures; valid during the call.
struct Frame {
  int number = 0;
  double time = 0;                          ///< [s]
  const dem::Assembly* assembly = nullptr;  ///< settled
  const fe::Mesh* mesh = nullptr;           ///< coupled only
  const fe::State* nodes = nullptr;         ///< coupled only
  Pose impactor;
};
using FrameCallback = std::function<void(const Frame&)>;

struct ImpactResult {
  std::size_t elements = 0, nodes = 0, links = 0, contacts = 0;
  long steps = 0;
  double time_step = 0, critical_time_step = 0, simulated_time = 0;  ///< [s]
  /// Of the finite elements, given or measured on the pack [Pa], [-]; 0 without.
  double finite_young_modulus = 0, finite_poisson_ratio = 0;
  int interval = 0;  ///< steps between forces of the finite elements; 0 without
  /// The first before anything moves.
  std::vector<Sample> history;
  std::map<std::string, double> max_displacement;  ///< largest norm by probe [m]
  double peak_force = 0;                           ///< largest mean over a sample interval [N]
  Vec3 impulse = Vec3::Zero();                     ///< on the impactor [N s]
  double residual_velocity = 0;  ///< of the impactor along its approach; negative: it came back [m/s]
  std::size_t broken_links = 0;  ///< when they were last counted
  double damage_volume = 0;  ///< of elements that lost more than half their links, over the solid fraction [m3]
  Fragments fragments;
  SlabLoss losses;
  ImpactorOutcome impactor;
  ImpactEnergy energy;
  double energy_balance_error = 0;  ///< largest imbalance of the run over the initial energy [-]
  double momentum_error =
      0;  ///< of elements, impactor and supports' impulse together, over the first momentum [-]
  double step_loop_seconds = 0, overlap_solve_seconds = 0, wall_seconds = 0;
  std::vector<std::string> warnings;  ///< in words
  std::string state_sha256;
};

/// When and where to keep the state.
struct ImpactCheckpoint {
  std::filesystem::path file;  ///< empty: none
  bool resume = false;         ///< go on from it if it exists
  double interval = 120;       ///< wall time between two [s]
};

/// Makes the structure (packs it or reads it), then runs. `frame` is called scene.frames + 1 times, the first
/// time before anything moves. Throws InputError (the scene does not fit together: a support on nothing, an
/// impactor inside the structure), RunError (it diverged, energy grew without cause), Interrupted (a signal;
/// the checkpoint is written).
ImpactResult run_impact(const Scene& scene, int threads, const dem::ProgressCallback& progress = {},
                        const FrameCallback& frame = {}, const ImpactCheckpoint& checkpoint = {});

}  // namespace impact
