// A laboratory test on one specimen: what is held and driven, what is read, when it is over, what is measured.
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libdem/state/element_load.h"
#include "libdem/state/particles.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/curve_table.h"
#include "specimens/virtual_tests/outcome.h"

namespace virtual_tests {

/// Options that every quasi-static laboratory test has.
struct QuasiStaticOptions {
  /// Of the test's own stress [Pa]; 0: guessed from the card. Sets the speed and the sampling, not the physics.
  double expected_strength = 0;
  double velocity = 0;  ///< of what is driven [m/s]; 0: from `rate`
  /// The elastic peak is reached after `length / (wave speed * rate)`, length as the rig names it [-]; 0: the
  /// test's own.
  double rate = 0;
  double damping = 0.3;             ///< local damping
  double time_step_fraction = 0.7;  ///< of the critical time step
  double stop_at = 0;      ///< ends when the stress has fallen to this part of the peak; 0: the test's own
  double max_control = 0;  ///< ends where what is driven has come so far, in the control's unit; 0: its own
  int threads = 1;

  /// Throws InputError that names the option and its bound.
  void validate() const;
};

/// What a driver must know of a test before it starts, and what does not change.
struct RigFacts {
  std::string name;                ///< of the test
  CurveColumn control;             ///< what is driven, the curve's first column: {"closing", "m"}
  double stress_per_force = 0;     ///< the test's stress over its force [1/m2]
  std::vector<CurveColumn> extra;  ///< what `sample` fills; after control, force and stress
  double expected_strength = 0;    ///< of the stress [Pa]
  double least_peak = 0;           ///< a stress below this is no peak yet [Pa]
  double length = 0;               ///< that sound must run through to and fro for balance [m]
  // The test's own choices where the options leave them open.
  double rate = 0.01;     ///< see QuasiStaticOptions
  double stop_at = 0.6;   ///< part of the peak stress
  double likely_end = 2;  ///< in displacements of the elastic peak: a guess, for progress
  double furthest = 20;   ///< in displacements of the elastic peak: the test ends there at the latest
  bool starts_at_rest =
      false;  ///< true: no element moves at first; else all move as the elastic solution wants
};

/// What one step shows.
struct Reading {
  double force = 0;     ///< the main force [N], positive in the direction of loading
  double opposing = 0;  ///< the force that balances it when nothing accelerates [N]
  double control = 0;   ///< how far what is driven has come; RigFacts::control names its unit
};

/// The step to come.
struct Moment {
  long step = 0;         ///< steps done
  double time_step = 0;  ///< [s]
  double velocity = 0;   ///< wanted of what is driven, the control's unit per second
  double rise_time = 0;  ///< in which the elastic peak is reached at that velocity [s]
  double time() const { return time_step * static_cast<double>(step); }
};

/// The curve so far, for the question whether the test is over.
struct SoFar {
  const CurveTable& curve;
  double control, stress;            ///< of the last point
  double peak_stress, peak_control;  ///< of the highest
  double stop_at, furthest;          ///< as settled; `furthest` in the control's unit
};

/// The assembly's elements are numbered as those of `specimen()`. A rig is made for one specimen and may refuse
/// it (InputError). What changes as the test goes on belongs into the numbers, or a checkpoint loses it.
class Rig {
 public:
  virtual ~Rig() = default;
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  virtual const RigFacts& facts() const = 0;
  /// The specimen as it is tested.
  virtual const specimens::Specimen& specimen() const = 0;
  /// Whether `specimen()` is another than the one that was given.
  virtual bool changed_specimen() const { return false; }
  /// What was settled, for result.json: axis, widths, ...
  virtual NamedValues setting() const { return {}; }

  /// Prescribes the degrees of freedom that are held, and those that are driven, with the velocities at which
  /// the control advances by 1 (of its unit) a second. Called at rest; the driver scales the velocities.
  virtual void hold(dem::Particles& particles) const = 0;

  /// Whether `steer` is to be called before each step.
  virtual bool steers() const { return false; }
  /// Changes prescribed velocities, or what is held, before a step. `particles.force` is that of the step
  /// before where a degree of freedom was prescribed. Returns whether other degrees of freedom are held now. A
  /// newly held one should begin with the velocity that it had.
  virtual bool steer(dem::Particles& /*particles*/, const Moment& /*moment*/) { return false; }

  /// Loads on elements in the step to come, sorted by element; none by default.
  virtual std::span<const dem::ElementLoad> loads(const dem::Particles& /*particles*/,
                                                  const Moment& /*moment*/) {
    return {};
  }

  /// After a step: `particles.force` is valid where a degree of freedom is prescribed.
  virtual Reading read(const dem::Particles& particles) const = 0;
  /// Fills the extra columns, in the middle of a window of steps.
  virtual void sample(const dem::Particles& /*particles*/, std::span<double> /*extra*/) const {}

  /// Asked after each window. By default: fallen far enough below a peak that was one, or come far enough.
  virtual bool is_over(const SoFar& so_far) const;
  /// Whether the curve has a peak behind it; by default, fallen far enough.
  virtual bool has_fallen(const SoFar& so_far) const;

  /// The quantities of the test, the main one first.
  virtual std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const = 0;

  /// Its changing numbers by name: one list, for writing a checkpoint and for reading it.
  virtual std::vector<std::pair<std::string, double*>> numbers() { return {}; }

 protected:
  Rig() = default;
};

/// Resultant force of these elements along `direction` [N], where it is prescribed.
double force_along(const dem::Particles& particles, std::span<const std::int32_t> elements,
                   const dem::Vec3& direction);
/// Their mean displacement along `direction` [m].
double displacement_along(const dem::Particles& particles, std::span<const std::int32_t> elements,
                          const dem::Vec3& direction);
/// The highest value of a column; 0 if it is empty.
double peak_in(const CurveTable& curve, std::string_view column);
/// The row at which a column is highest; 0 if there is none.
std::size_t row_of_peak(const CurveTable& curve, std::string_view column);

}  // namespace virtual_tests
