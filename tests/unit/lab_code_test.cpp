// Targets from codes, against the codes' own tables and against themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "calibrate/lab/code_formulas.h"
#include "calibrate/lab/csv.h"
#include "calibrate/lab/measure.h"
#include "libdem/core/error.h"

namespace {

using testing::HasSubstr;

const std::filesystem::path code_table =
    std::filesystem::path(SPALL_SOURCE_DIR) / "data/curves/code-curves/code_curves_table.csv";

TEST(LabCode, MatchesTheTable) {
  const lab::CsvTable table = lab::read_csv(code_table);
  const auto cell = [&](std::size_t row, const char* column) {
    return lab::number_at(table, row, lab::find_column(table, column));
  };
  ASSERT_EQ(table.rows(), 7u);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double fck = lab::parse_strength_class(table.cells[row][0], "t");
    EXPECT_DOUBLE_EQ(fck / 1e6, cell(row, "fck"));
    const auto ec2 = lab::code_concrete(lab::Code::eurocode2_2004, fck);
    EXPECT_DOUBLE_EQ(ec2.fcm.value / 1e6, cell(row, "fcm"));
    EXPECT_NEAR(ec2.fctm.value / 1e6, cell(row, "EC2_fctm_formula"), 5.1e-4);
    EXPECT_NEAR(ec2.fctm.value / 1e6, cell(row, "EC2_fctm_table"), 0.06);
    EXPECT_NEAR(ec2.E_secant.value / 1e6, cell(row, "EC2_Ecm_formula"), 0.51);
    EXPECT_NEAR(ec2.E_secant.value / 1e9, cell(row, "EC2_Ecm_table"), 0.51);
    EXPECT_NEAR(ec2.strain_at_peak.value * 1e3, cell(row, "EC2_epsc1_formula"), 5.1e-4);
    EXPECT_NEAR(ec2.strain_limit.value * 1e3, cell(row, "EC2_epscu1_table"), 1e-9);
    EXPECT_NEAR(ec2.k.value, cell(row, "EC2_k_formula"), 6e-5);
    EXPECT_TRUE(ec2.fracture_energy.source.empty());
    const auto mc = lab::code_concrete(lab::Code::model_code_2010, fck);
    EXPECT_NEAR(mc.E_initial.value / 1e6, cell(row, "MC2010_Eci_quartzite"), 0.51);
    EXPECT_NEAR(mc.strain_at_peak.value * 1e3, cell(row, "MC2010_epsc1_table"), 1e-9);
    EXPECT_NEAR(mc.strain_limit.value * 1e3, cell(row, "MC2010_epsclim_table"), 1e-9);
    EXPECT_NEAR(mc.k.value, cell(row, "MC2010_k_table"), 1e-9);
    EXPECT_NEAR(mc.fracture_energy.value, cell(row, "MC2010_GF"), 0.051);
    EXPECT_NEAR(mc.fracture_energy.value / mc.fctm.value * 1e3, cell(row, "MC2010_w1"), 5.1e-5);
    EXPECT_NEAR(mc.softening.opening.back() * 1e3, cell(row, "MC2010_wc"), 2e-4);
  }
}

TEST(LabCode, CurvesHoldTheirOwnNumbers) {
  for (const lab::Code code : {lab::Code::eurocode2_2004, lab::Code::model_code_2010})
    for (const double fck : {12e6, 33e6, 40e6, 65e6, 90e6}) {
      const auto c = lab::code_concrete(code, fck);
      EXPECT_NEAR(lab::strength(c.compression), c.fcm.value, 1e-9 * c.fcm.value);
      EXPECT_NEAR(lab::strain_at_peak(c.compression), c.strain_at_peak.value, 1e-9);
      EXPECT_LE(c.compression.strain.back(), c.strain_limit.value * (1 + 1e-9));
      EXPECT_NEAR(lab::strength(c.tension), c.fctm.value, 1e-9 * c.fctm.value);
      EXPECT_NEAR(lab::secant_modulus(c.tension), c.E_initial.value, 1e-6 * c.E_initial.value);
      EXPECT_GE(c.E_initial.value, c.E_secant.value);
      if (code != lab::Code::model_code_2010) continue;
      EXPECT_NEAR(lab::fracture_energy(c.softening), c.fracture_energy.value, 1e-6 * c.fracture_energy.value);
    }
  const auto c = lab::code_concrete(lab::Code::model_code_2010, 40e6);
  EXPECT_EQ(c.fctm.source, "fib Model Code 2010, 5.1-3a, fck = 40 MPa");
  EXPECT_THAT(c.E_initial.source, HasSubstr("quartzite"));
  const auto soft = lab::code_concrete(lab::Code::model_code_2010, 40e6, lab::Aggregate::sandstone);
  EXPECT_NEAR(soft.E_initial.value, 0.7 * c.E_initial.value, 1);
}

TEST(LabCode, RefusesWhatTheCodesDoNotCover) {
  using lab::Aggregate;
  using lab::Code;
  EXPECT_THROW(lab::code_concrete(Code::eurocode2_2004, 8e6), dem::InputError);
  EXPECT_THROW(lab::code_concrete(Code::eurocode2_2004, 95e6), dem::InputError);
  EXPECT_NO_THROW(lab::code_concrete(Code::model_code_2010, 120e6));
  EXPECT_THROW(lab::code_concrete(Code::model_code_2010, 121e6), dem::InputError);
  EXPECT_THROW(lab::code_concrete(Code::model_code_2010, 40), dem::InputError);  // MPa where Pa is due
  EXPECT_THROW(lab::code_concrete(Code::model_code_2010, std::nan("")), dem::InputError);
  EXPECT_THROW(lab::code_concrete(Code::model_code_2010, 100e6, Aggregate::sandstone), dem::InputError);
  EXPECT_DOUBLE_EQ(lab::parse_strength_class("C40/50", "t"), 40e6);
  EXPECT_DOUBLE_EQ(lab::parse_strength_class("C12", "t"), 12e6);
  EXPECT_DOUBLE_EQ(lab::parse_strength_class("38.5 MPa", "t"), 38.5e6);
  for (const char* text : {"C50/40", "C40/80", "C", "C40/", "Cx/y", "40", "", "C-40/50", "B500"})
    EXPECT_THROW(lab::parse_strength_class(text, "t"), dem::InputError) << text;
}

TEST(LabNames, AreReadAndWritten) {
  EXPECT_EQ(lab::parse_sign_convention("negative_is_compression", "t"),
            lab::SignConvention::negative_is_compression);
  EXPECT_EQ(lab::to_text(lab::Loading::tension), "tension");
  EXPECT_EQ(lab::parse_code("model_code_2010", "t"), lab::Code::model_code_2010);
  EXPECT_EQ(lab::parse_aggregate("basalt", "t"), lab::Aggregate::basalt);
  EXPECT_THROW(lab::parse_loading("bending", "t"), dem::InputError);
}

}  // namespace
