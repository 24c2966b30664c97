// The measured cylinders of BAM give the numbers that the notes beside their files state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "calibrate/lab/curve.h"
#include "calibrate/lab/measure.h"
#include "calibrate/lab/series.h"
#include "libdem/core/error.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path bam = std::filesystem::path(SPALL_SOURCE_DIR) / "data/curves/bam-m7";

std::filesystem::path cylinder(const std::string& name) {
  return bam / ("bam_thiele_M7_" + name + "_uniaxial_compression.csv");
}

lab::CurveSpec bam_spec() {
  lab::CurveSpec spec;
  for (const char* name : {"Z15", "Z17", "Z19", "Z20", "Z21"}) spec.files.push_back(cylinder(name));
  spec.strain_column = "strain_gauge_mean";
  spec.post_peak_strain_column = "strain_platen";
  spec.only_rows = lab::RowFilter{"phase[0pre1mono2stop]", 1};
  return spec;
}

/// What the notes beside the files state: MPa, GPa (slope between 10 and 33% of fc), permil.
struct Noted {
  const char* name;
  double fc, E, strain_at_peak;
};
constexpr std::array<Noted, 5> noted{{{"Z15", 53.24, 35.4, 2.423},
                                      {"Z17", 51.56, 36.0, 2.200},
                                      {"Z19", 50.41, 37.7, 2.178},
                                      {"Z20", 52.72, 36.3, 2.359},
                                      {"Z21", 50.48, 34.7, 2.207}}};

TEST(LabBam, EachCylinderGivesWhatItsNotesSay) {
  for (const Noted& note : noted) {
    const lab::LabCurve curve = lab::prepare_curve(cylinder(note.name), bam_spec());
    EXPECT_NEAR(lab::strength(curve) / 1e6, note.fc, 0.01) << note.name;
    EXPECT_NEAR(lab::strain_at_peak(curve) * 1e3, note.strain_at_peak, 0.002) << note.name;
    EXPECT_NEAR(lab::fitted_modulus(curve) / 1e9, note.E, 0.1) << note.name;
    // The notes fit a line; EN 12390-13 joins two points of a curve that is slightly S-shaped, and lies 1%
    // lower.
    EXPECT_NEAR(lab::secant_modulus(curve) / lab::fitted_modulus(curve), 0.99, 0.006) << note.name;
    EXPECT_DOUBLE_EQ(curve.strain.front(), 0);
    EXPECT_EQ(curve.toe_shift, 0) << "gauges on the specimen show no bedding";
  }
}

TEST(LabBam, ThePlatenStrainTakesOverAtThePeakWithoutAJump) {
  const lab::LabCurve raw = lab::read_curve(cylinder("Z15"), bam_spec());
  const lab::LabCurve joined = lab::join_post_peak(raw);
  const std::size_t peak = lab::peak_index(raw);
  EXPECT_DOUBLE_EQ(joined.strain[peak], raw.strain[peak]);
  for (std::size_t k = peak + 1; k < raw.size(); ++k)
    EXPECT_NEAR(joined.strain[k] - joined.strain[k - 1], raw.post_peak_strain[k] - raw.post_peak_strain[k - 1],
                1e-15);
  EXPECT_TRUE(joined.post_peak_strain.empty());
}

TEST(LabBam, PreCycleAndStopAreFoundWithoutThePhaseColumn) {
  lab::CurveSpec without = bam_spec();
  without.only_rows.reset();
  for (const Noted& note : noted) {
    const lab::LabCurve a = lab::prepare_curve(cylinder(note.name), bam_spec());
    const lab::LabCurve b = lab::prepare_curve(cylinder(note.name), without);
    EXPECT_EQ(a.strain, b.strain) << note.name;
    EXPECT_EQ(a.stress, b.stress) << note.name;
  }
}

TEST(LabBam, TheSeriesHasTheMeanOfItsPeaks) {
  const lab::Series series = lab::read_series(bam_spec());
  EXPECT_EQ(series.strength.count, 5);
  EXPECT_NEAR(series.strength.mean / 1e6, 51.68, 0.01);
  EXPECT_NEAR(series.strength.std / 1e6, 1.28, 0.01);
  EXPECT_NEAR(series.E.mean / 1e9, 35.7, 0.1);
  EXPECT_NEAR(series.strain_at_peak.mean * 1e3, 2.273, 0.002);
  EXPECT_NEAR(lab::strength(series.mean), series.strength.mean, 1e-6 * series.strength.mean);
  EXPECT_NEAR(lab::strain_at_peak(series.mean), series.strain_at_peak.mean, 1e-6 * series.strain_at_peak.mean);
  EXPECT_NEAR(lab::secant_modulus(series.mean), series.E.mean, 0.005 * series.E.mean);
  ASSERT_TRUE(series.strain_at_50);
  EXPECT_EQ(series.strain_at_50->count, 5);
  EXPECT_NEAR(*lab::strain_after_peak(series.mean, 0.5), series.strain_at_50->mean,
              0.02 * series.strain_at_50->mean);
  for (std::size_t k = 0; k < series.mean.size(); ++k) {
    EXPECT_LE(series.low[k], series.mean.stress[k] * (1 + 1e-3) + 1e3);
    EXPECT_GE(series.high[k], series.mean.stress[k] * (1 - 1e-3) - 1e3);
  }
  EXPECT_TRUE(series.notes.empty());
}

TEST(LabBam, TheForceControlledTestEndsAtItsPeak) {
  lab::CurveSpec spec;
  spec.strain_column = "strain_gauge_mean";
  const lab::LabCurve curve = lab::prepare_curve(bam / "bam_thiele_M7_Z11_emodulus_and_prepeak.csv", spec);
  EXPECT_NEAR(lab::strength(curve) / 1e6, 55.77, 0.01);
  // The notes' 2.326 permil include the 0.034 permil that three cycles with holds left behind.
  EXPECT_NEAR((lab::strain_at_peak(curve) + curve.toe_shift) * 1e3, 2.326, 0.002);
  EXPECT_NEAR(lab::secant_modulus(curve) / 1e9, 37.5, 0.8);
  EXPECT_FALSE(lab::strain_after_peak(curve, 0.8));
}

TEST(LabBam, AModulusTestIsNoStrengthTest) {
  lab::CurveSpec spec;
  spec.strain_column = "strain_axial_gauge_mean";
  try {
    lab::prepare_curve(bam / "bam_thiele_M5_Z43_emodulus_axial_lateral.csv", spec);
    FAIL();
  } catch (const dem::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no peak"), HasSubstr("19.12 MPa"), HasSubstr("row ")));
  }
}

TEST(LabBam, BeddingBetweenThePlatensIsTakenOff) {
  // Against the platens the same cylinder is softer and longer to its peak, and its toe is shifted by 0.08
  // permil.
  lab::CurveSpec spec = bam_spec();
  spec.strain_column = "strain_platen";
  spec.post_peak_strain_column.clear();
  const lab::LabCurve curve = lab::prepare_curve(cylinder("Z15"), spec);
  EXPECT_NEAR(curve.toe_shift * 1e3, 0.081, 0.005);
  EXPECT_NEAR((lab::strain_at_peak(curve) + curve.toe_shift) * 1e3, 2.594, 0.002);  // as its notes say
  EXPECT_LT(lab::secant_modulus(curve) / 1e9, 30);                                  // the notes: 24 to 30 GPa
}

}  // namespace
