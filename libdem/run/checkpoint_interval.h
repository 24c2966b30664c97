// How often a run keeps its state.
#pragma once

namespace dem {

/// Wall time from one checkpoint to the next [s]: `usual`, unless the environment's SPALL_CHECKPOINT_SECONDS
/// says otherwise (a number from 0.01). Throws InputError if it is something else.
double seconds_between_checkpoints(double usual);

}  // namespace dem
