// Laboratory curves and code formulas: the measured series of BAM, synthetic curves with known answers, bad
// input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "calibrate/lab/code_formulas.h"
#include "calibrate/lab/csv.h"
#include "calibrate/lab/curve.h"
#include "calibrate/lab/measure.h"
#include "calibrate/lab/series.h"
#include "libdem/core/error.h"
#include "libdem/core/random.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Synthetic concrete: Sargin's curve, 40 MPa at 2 permil.
constexpr double fc = 40e6, peak_strain = 2e-3, k_number = 1.8;
double concrete(double strain) { return fc * lab::sargin(strain / peak_strain, k_number); }

lab::LabCurve sampled(const std::function<double(double)>& stress, double end, int rows) {
  lab::LabCurve curve;
  curve.file = "synthetic";
  for (int k = 0; k < rows; ++k) {
    curve.strain.push_back(end * k / (rows - 1));
    curve.stress.push_back(stress(curve.strain.back()));
    curve.row.push_back(k + 2);
  }
  return curve;
}

lab::LabCurve prepared(lab::LabCurve curve, const lab::CurveOptions& options = {}) {
  curve = lab::loading_branch(curve, options.check);
  lab::check_curve(curve, options.check);
  curve = lab::correct_toe(lab::make_increasing(curve), options.toe);
  return lab::resample(lab::smooth(curve, options.smooth), options.resample);
}

void append(lab::LabCurve& curve, double strain, double stress) {
  curve.strain.push_back(strain);
  curve.stress.push_back(stress);
  curve.row.push_back(static_cast<int>(curve.row.size()) + 2);
}

class LabFile : public testing::Test {
 protected:
  LabFile() : folder(std::filesystem::temp_directory_path() / ("spall-lab-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~LabFile() override { std::filesystem::remove_all(folder); }

  /// Writes strain * strain_scale and stress / 1 MPa * stress_scale under the header.
  std::filesystem::path write(const lab::LabCurve& curve, const std::string& header, double strain_scale = 1,
                              double stress_scale = 1) const {
    std::ofstream out(folder / "a.csv");
    out.precision(12);
    out << header << "\n";
    for (std::size_t k = 0; k < curve.size(); ++k)
      out << curve.strain[k] * strain_scale << "," << curve.stress[k] / 1e6 * stress_scale << "\n";
    return folder / "a.csv";
  }
  std::string refusal(const std::filesystem::path& file, const lab::CurveSpec& spec = {}) const {
    try {
      lab::prepare_curve(file, spec);
    } catch (const dem::InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("a.csv"), Not(HasSubstr("\n"))));
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder;
};

TEST(LabSteps, ACleanCurveComesBackUnchanged) {
  const lab::LabCurve curve = prepared(sampled(concrete, 2 * peak_strain, 401));
  EXPECT_EQ(curve.toe_shift, 0);
  EXPECT_NEAR(lab::strength(curve), fc, 1e-6 * fc);
  EXPECT_NEAR(lab::strain_at_peak(curve), peak_strain, 1e-9);
  for (std::size_t k = 0; k < curve.size(); ++k)
    EXPECT_NEAR(curve.stress[k], concrete(curve.strain[k]), 2e-4 * fc);
}

TEST(LabSteps, ToeCorrectionRecoversAKnownShift) {
  // A straight line to a third of the strength and a bedding of 0.4 permil in front of it.
  const double shift = 4e-4, E = 36e9;
  const auto body = [&](double strain) {
    return strain <= fc / 3 / E
               ? E * strain
               : fc / 3 + (fc - fc / 3) * (1 - std::pow(1 - std::min(1.0, (strain - fc / 3 / E) / 1.5e-3), 2));
  };
  const auto bedded = [&](double strain) {  // the parabola meets the line, and its slope, at the strain of 2 a
    const double a = 0.5 * shift * 0.4, x = strain - shift;
    return x > a ? body(x) : x > -a ? E * (x + a) * (x + a) / (4 * a) : 0.002 * fc * strain / shift;
  };
  const lab::LabCurve curve = prepared(sampled(bedded, 2.2e-3, 800), [] {
    lab::CurveOptions options;
    options.check.may_end_at_peak = true;
    return options;
  }());
  EXPECT_NEAR(curve.toe_shift, shift, 0.01 * shift);
  EXPECT_NEAR(lab::secant_modulus(curve), E, 0.01 * E);
  EXPECT_EQ(curve.stress.front(), 0);
}

TEST(LabSteps, SmoothingDoesNotMoveThePeak) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    dem::Random random(seed);
    lab::LabCurve curve = sampled(concrete, 1.6 * peak_strain, 900);
    for (double& stress : curve.stress) stress += 0.003 * fc * random.normal();
    const lab::LabCurve clean = prepared(curve);
    EXPECT_NEAR(lab::strength(clean), fc, 0.005 * fc) << seed;
    EXPECT_NEAR(lab::strain_at_peak(clean), peak_strain, 0.005 * peak_strain) << seed;
    double rms = 0;
    for (std::size_t k = 0; k < clean.size(); ++k)
      rms += std::pow(clean.stress[k] - concrete(clean.strain[k]), 2) / static_cast<double>(clean.size());
    EXPECT_LT(std::sqrt(rms), 0.0015 * fc) << seed;  // half of the noise, and less
  }
}

TEST(LabSteps, SmoothingKeepsASuddenFallSudden) {
  const auto brittle = [](double strain) {
    return strain <= 1e-4 ? 30e9 * strain : strain <= 1.05e-4 ? 3e6 - 2e6 * (strain - 1e-4) / 5e-6 : 1e6;
  };
  const lab::LabCurve curve = prepared(sampled(brittle, 2e-4, 401));
  EXPECT_NEAR(lab::strength(curve), 3e6, 0.005 * 3e6);
  EXPECT_NEAR(lab::strain_at_peak(curve), 1e-4, 0.005 * 1e-4);
  EXPECT_NEAR(*lab::strain_after_peak(curve, 0.5), 1.0375e-4, 0.01e-4);
}

TEST(LabSteps, LongRecordsAreThinnedNotRefused) {
  dem::Random random(3);
  lab::LabCurve curve = sampled(concrete, 1.5 * peak_strain, 60000);
  for (double& stress : curve.stress) stress += 0.005 * fc * random.normal();
  for (double& strain : curve.strain) strain += 0.0005 * peak_strain * random.normal();
  const lab::LabCurve clean = prepared(curve);
  EXPECT_NEAR(lab::strength(clean), fc, 0.005 * fc);
  EXPECT_NEAR(lab::secant_modulus(clean), lab::secant_modulus(sampled(concrete, 1.5 * peak_strain, 2000)),
              0.3e9);
}

TEST(LabSteps, AnUnloadingLoopBeforeThePeakIsDropped) {
  // To 40% of the strength, back along the first tangent to 1% with a residual strain, and up again.
  const double residual = 1e-4;
  lab::LabCurve curve;
  curve.file = "loop";
  const double turn = 0.25 * peak_strain, E = 40e9;
  for (int k = 0; k <= 50; ++k) append(curve, turn * k / 50, concrete(turn * k / 50));
  for (int k = 1; k < 50; ++k) {
    const double stress = concrete(turn) + (0.01 * fc - concrete(turn)) * k / 50;
    append(curve, residual + stress / E, stress);
  }
  for (int k = 0; k <= 400; ++k)
    append(curve, residual + 1.5 * peak_strain * k / 400, concrete(1.5 * peak_strain * k / 400));
  const lab::LabCurve clean = prepared(curve);
  EXPECT_NEAR(clean.toe_shift, residual, 0.15 * residual);
  EXPECT_NEAR(lab::strain_at_peak(clean), peak_strain, 0.01 * peak_strain);
  EXPECT_THAT(clean.notes, testing::Contains(HasSubstr("before the last loading left out")));
}

TEST(LabSteps, AFallOfTheStressAloneIsNoLoop) {
  const auto with_dip = [](double strain) {
    return concrete(strain) * (strain > 1.0e-3 && strain < 1.05e-3 ? 0.85 : 1.0);
  };
  const lab::LabCurve branch = lab::loading_branch(sampled(with_dip, 1.5 * peak_strain, 400));
  EXPECT_LT(branch.strain.front(), 0.02 * peak_strain);
}

TEST_F(LabFile, EveryUnitAndSignGivesTheSameCurve) {
  const lab::LabCurve raw = sampled(concrete, 1.5 * peak_strain, 200);
  struct Style {
    const char* header;
    double strain_scale, stress_scale;
  };
  for (const Style& style :
       {Style{"strain[-],stress[MPa]", 1, 1}, Style{"strain,stress[MPa]", 1, 1},
        Style{"strain[permil],stress[Pa]", 1e3, 1e6}, Style{"strain[\u2030],stress[N/mm2]", 1e3, 1},
        Style{"strain (%),stress (GPa)", 1e2, 1e-3}, Style{"strain[um/m],stress[kN/cm2]", 1e6, 0.1},
        Style{"strain[\u00b5m/m],stress[N/mm\u00b2]", 1e6, 1},
        Style{"strain[microstrain],stress[kPa]", 1e6, 1e3}, Style{"strain[mm/m],stress[bar]", 1e3, 10},
        Style{"strain[mm/100mm],stress[MPa]", 100, 1}, Style{"strain / permil,stress / MPa", 1e3, 1},
        Style{"strain,stress\npermil,MPa", 1e3, 1}})
    for (const double sign : {1.0, -1.0}) {
      lab::CurveSpec spec;
      if (sign < 0) spec.sign = lab::SignConvention::negative_is_compression;
      const auto file = write(raw, style.header, sign * style.strain_scale, sign * style.stress_scale);
      const lab::LabCurve curve = lab::prepare_curve(file, spec);
      EXPECT_NEAR(lab::strength(curve), fc, 1e-4 * fc) << style.header;
      EXPECT_NEAR(lab::strain_at_peak(curve), peak_strain, 0.006 * peak_strain) << style.header;
    }
}

TEST_F(LabFile, UnitsMayComeFromTheCaseAndADisplacementFromItsGaugeLength) {
  const lab::LabCurve raw = sampled(concrete, 1.5 * peak_strain, 301);
  lab::CurveSpec spec;
  spec.strain_unit = "permil";
  spec.stress_unit = "MPa";
  EXPECT_NEAR(lab::strain_at_peak(lab::prepare_curve(write(raw, "strain,stress", 1e3), spec)), peak_strain,
              1e-5);
  EXPECT_THAT(refusal(write(raw, "strain[%],stress[MPa]", 1e2), spec), HasSubstr("[%]"));
  lab::CurveSpec gauge;
  gauge.gauge_length = 0.1;
  const lab::LabCurve from_displacement = lab::prepare_curve(write(raw, "strain[mm],stress[MPa]", 100), gauge);
  EXPECT_NEAR(lab::strain_at_peak(from_displacement), peak_strain, 1e-5);
  EXPECT_THAT(from_displacement.notes, Not(testing::Contains(HasSubstr("gauge_length"))));
  EXPECT_THAT(lab::prepare_curve(write(raw, "strain[permil],stress[MPa]", 1e3), gauge).notes,
              testing::Contains("gauge_length was not used: column \"strain\" holds a strain, no length"));
}

TEST_F(LabFile, WrongUnitsAndSignsAreRefusedWithAHint) {
  const lab::LabCurve raw = sampled(concrete, 1.5 * peak_strain, 200);
  EXPECT_THAT(refusal(write(raw, "strain[-],stress[Pa]")),
              AllOf(HasSubstr("strength"), HasSubstr("MPa instead of Pa")));
  EXPECT_THAT(refusal(write(raw, "strain[-],stress[GPa]")), HasSubstr("MPa instead of GPa"));
  EXPECT_THAT(refusal(write(raw, "strain[-],stress[MPa]", 1e3)), HasSubstr("permil instead of -"));
  EXPECT_THAT(refusal(write(raw, "strain[permil],stress[MPa]")), HasSubstr("- instead of permil"));
  EXPECT_THAT(refusal(write(raw, "strain[-],stress[MPa]", -1, -1)), HasSubstr("negative_is_compression"));
  EXPECT_THAT(refusal(write(raw, "strain[-],stress[MPa]", -1, 1)), HasSubstr("another sign"));
  lab::CurveSpec spec;
  spec.strain_sign = lab::SignConvention::tension_positive;
  EXPECT_EQ(refusal(write(raw, "strain[-],stress[MPa]", -1, 1), spec), "accepted");
}

TEST_F(LabFile, CurvesThatAreNoCurvesAreRefused) {
  const std::string header = "strain[-],stress[MPa]";
  EXPECT_THAT(refusal(write(sampled(concrete, 1.5 * peak_strain, 12), header)), HasSubstr("12 rows"));
  EXPECT_THAT(refusal(write(sampled(concrete, 0.5 * peak_strain, 100), header)),
              AllOf(HasSubstr("row 101"), HasSubstr("no peak")));

  lab::LabCurve backwards = sampled(concrete, 1.5 * peak_strain, 100);
  for (std::size_t k = 40; k < 100; ++k) backwards.strain[k] -= 0.05 * peak_strain;
  EXPECT_THAT(refusal(write(backwards, header)), AllOf(HasSubstr("row 42"), HasSubstr("backwards")));

  lab::LabCurve loop_after_peak = sampled(concrete, 1.5 * peak_strain, 100);
  for (std::size_t k = 80; k < 85; ++k) loop_after_peak.strain[k] -= 0.2 * peak_strain;
  EXPECT_THAT(refusal(write(loop_after_peak, header)), AllOf(HasSubstr("row 82"), HasSubstr("backwards")));

  lab::LabCurve reversed = sampled(concrete, 1.5 * peak_strain, 100);
  std::ranges::reverse(reversed.strain);
  std::ranges::reverse(reversed.stress);
  EXPECT_THAT(refusal(write(reversed, header)), HasSubstr("reverse order"));

  lab::LabCurve spike = sampled(concrete, 1.5 * peak_strain, 100);
  spike.stress[30] = 3 * fc;
  EXPECT_THAT(refusal(write(spike, header)), AllOf(HasSubstr("row 32"), HasSubstr("sticks out")));

  lab::LabCurve late = sampled(concrete, 1.5 * peak_strain, 300);
  for (double& stress : late.stress) stress = 10e6 + 0.75 * stress;
  EXPECT_THROW(lab::secant_modulus(late), dem::InputError);

  lab::CurveSpec spec;
  spec.only_rows = lab::RowFilter{"strain", 7};
  EXPECT_THAT(refusal(write(sampled(concrete, 1.5 * peak_strain, 100), header), spec), HasSubstr("strain = 7"));
}

TEST(LabSteps, OptionsOutOfTheirBoundsAreNamed) {
  lab::CurveOptions options;
  EXPECT_NO_THROW(lab::validate(options));
  options.toe.lower = 0.5;
  EXPECT_THROW(lab::validate(options), dem::InputError);
  options = {};
  options.smooth.window = std::nan("");
  EXPECT_THROW(lab::validate(options), dem::InputError);
}

TEST_F(LabFile, NoiseOfTheStrainIsSmoothedAway) {
  dem::Random random(5);
  lab::LabCurve noisy = sampled(concrete, 1.5 * peak_strain, 600);
  for (double& strain : noisy.strain) strain += 0.001 * peak_strain * random.normal();
  const lab::LabCurve curve = lab::prepare_curve(write(noisy, "strain[-],stress[MPa]"), {});
  EXPECT_NEAR(lab::strength(curve), fc, 0.002 * fc);
  EXPECT_NEAR(lab::strain_at_peak(curve), peak_strain, 0.01 * peak_strain);
}

TEST(LabSeries, AveragingRecoversAKnownCurve) {
  // One shape, five peaks: the mean must be that shape at the mean peak, not a smeared one.
  std::vector<lab::LabCurve> curves;
  const std::array<double, 5> strain_scale{0.85, 0.95, 1.0, 1.05, 1.15},
      stress_scale{0.9, 1.1, 1.0, 0.95, 1.05};
  for (std::size_t s = 0; s < 5; ++s)
    curves.push_back(prepared(sampled([&](double x) { return stress_scale[s] * concrete(x / strain_scale[s]); },
                                      1.8 * peak_strain, 4000)));
  const lab::Series series = lab::average(curves);
  EXPECT_NEAR(series.strength.mean, fc, 1e-4 * fc);
  EXPECT_NEAR(series.strength.std, 0.0790569 * fc, 1e-4 * fc);
  EXPECT_NEAR(series.strain_at_peak.min, 0.85 * peak_strain, 0.003 * peak_strain);
  for (std::size_t k = 0; k < series.mean.size(); ++k) {
    EXPECT_NEAR(series.mean.stress[k], concrete(series.mean.strain[k]), 0.002 * fc);
    EXPECT_NEAR(series.std[k], 0.0790569 * concrete(series.mean.strain[k]), 0.001 * fc);
  }
  EXPECT_NEAR(series.mean.strain.back(), 1.8 / 1.15 * peak_strain, 0.02 * peak_strain);
}

TEST(LabSeries, OneSpecimenAndSpecimensWithoutASoftenedPart) {
  const lab::LabCurve whole = prepared(sampled(concrete, 1.6 * peak_strain, 300));
  const lab::Series one = lab::average({whole});
  EXPECT_EQ(one.strength.count, 1);
  EXPECT_EQ(one.strength.std, 0);
  EXPECT_EQ(one.mean.size(), whole.size());
  lab::CurveOptions brittle;
  brittle.check.may_end_at_peak = true;
  const lab::LabCurve half = prepared(sampled(concrete, peak_strain, 200), brittle);
  const lab::Series two = lab::average({whole, half});
  EXPECT_NEAR(two.mean.strain.back(), whole.strain.back(), 0.01 * peak_strain);
  EXPECT_EQ(two.count.front(), 2);
  EXPECT_EQ(two.count.back(), 1);
  EXPECT_THAT(two.notes, testing::ElementsAre(HasSubstr("ends at its peak")));
}

TEST(LabSeries, RefusesWhatIsNoSeries) {
  EXPECT_THROW(lab::average({}), dem::InputError);
  lab::LabCurve compression = prepared(sampled(concrete, 1.6 * peak_strain, 300));
  lab::LabCurve tension = compression;
  tension.loading = lab::Loading::tension;
  EXPECT_THROW(lab::average({compression, tension}), dem::InputError);
  lab::CurveSpec twice;
  twice.files = {std::filesystem::path(SPALL_SOURCE_DIR) /
                 "data/curves/bam-m7/bam_thiele_M7_Z15_uniaxial_compression.csv"};
  twice.strain_column = "strain_gauge_mean";
  twice.files.push_back(twice.files.front());
  EXPECT_THROW(lab::read_series(twice), dem::InputError);
}

TEST_F(LabFile, FractureEnergyFromATensionCurve) {
  const auto c = lab::code_concrete(lab::Code::model_code_2010, 40e6);
  lab::LabCurve curve;
  curve.strain = c.softening.opening;
  curve.stress = c.softening.stress;
  lab::CurveSpec spec;
  spec.sign = lab::SignConvention::tension_positive;
  const auto read = lab::read_opening_curve(write(curve, "strain[mm],stress[MPa]", 1e3), spec);
  EXPECT_NEAR(lab::fracture_energy(read), 146.5, 0.1);
  curve.strain.resize(300);  // cut at three fifths of the last opening: the rest is extended
  curve.stress.resize(300);
  const auto cut = lab::read_opening_curve(write(curve, "strain[mm],stress[MPa]", 1e3), spec);
  EXPECT_LT(lab::fracture_energy(cut), 140);
  EXPECT_NEAR(lab::fracture_energy(cut, true), 146.5, 0.2);
  EXPECT_THROW(lab::read_opening_curve(write(curve, "strain[-],stress[MPa]"), spec), dem::InputError);
}

}  // namespace
