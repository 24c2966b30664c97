// How often a run keeps its state.
#pragma once
#include <chrono>
#include <functional>

namespace dem {

/// Wall time from one checkpoint to the next [s]: `usual`, unless the environment's SPALL_CHECKPOINT_SECONDS
/// says otherwise (a number from 0). Throws InputError if it is something else.
double seconds_between_checkpoints(double usual);

/// When to write the next checkpoint, so that writing takes less than a hundredth of a run's time however large
/// the state and however slow the disk.
class CheckpointPace {
 public:
  /// The next one comes `interval` [s] after the last, and no sooner than 200 times as long as the last took to
  /// write; if SPALL_CHECKPOINT_SECONDS is set, `interval` alone counts.
  explicit CheckpointPace(double interval);

  bool is_due() const;
  /// Calls `write` and takes its time.
  void keep(const std::function<void()>& write);

 private:
  using Clock = std::chrono::steady_clock;
  double interval, factor, seconds_to_wait;
  Clock::time_point kept = Clock::now();
};

}  // namespace dem
