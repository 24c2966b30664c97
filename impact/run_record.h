// What an impact notes down while it runs: histories, the energy ledger, momentum. Everything that changes from
// step to step besides what moves.
#pragma once
#include <cstdint>

#include "impact/impact_run.h"
#include "impact/model.h"
#include "impact/outcome/force_record.h"
#include "libdem/run/checkpoint.h"

namespace impact {

struct RunRecord {
  std::int64_t steps = 0;
  std::vector<Sample> history;
  ImpactEnergy energy;
  double worst_imbalance = 0;             ///< [J], largest absolute
  Vec3 first_momentum = Vec3::Zero();     ///< of everything that moves [kg m/s]
  Vec3 support_impulse = Vec3::Zero();    ///< what the supports gave since the start [N s]
  double worst_momentum = 0;              ///< largest departure [kg m/s]
  ForceRecord force;                      ///< on the impactor
  Vec3 impulse_at_sample = Vec3::Zero();  ///< on the impactor, up to the last sample [N s]
  std::size_t broken_links = 0;           ///< at the last count
  double farthest_damage = 0;  ///< largest overlap coordinate at a broken link; 0: none in the overlap [-]
  Vec3 damage_place = Vec3::Zero();  ///< of that link [m]
  double loop_seconds = 0, overlap_seconds = 0, wall_seconds = 0;

  explicit RunRecord(double sample_interval) : force(sample_interval) {}
};

/// Momentum of elements, nodes and impactor [kg m/s].
Vec3 momentum_of(const ImpactModel& model, const Impactor* impactor, const ImpactorState& state);

/// Books what the supports gave in a step.
void book_supports(RunRecord& record, const ImpactModel& model);

/// What a step has just done.
struct StepTaken {
  dem::StepSums elements;
  ImpactorSums impactor;
  double ties_change = 0;  ///< kinetic energy that relaxed or lumped ties took [J], not above 0
};

/// Books the energy that a step dissipated.
void book_step(RunRecord& record, const StepTaken& taken);

/// Reads the energies that are functions of the state. `before` holds the elements' kinematics one step
/// earlier, `nodes_before` the nodes' velocities.
void read_energies(RunRecord& record, const ImpactModel& model, const StepTaken& taken,
                   const dem::Column<dem::Kinematics>& before, const std::vector<Vec3>& nodes_before);

/// The record as named columns for a checkpoint, and back. Throws InputError that names `where`.
dem::NamedNumbers numbers_of(const RunRecord& record, std::size_t probes);
void set_from(RunRecord& record, const dem::NamedNumbers& numbers, std::size_t probes,
              const std::string& where);

}  // namespace impact
