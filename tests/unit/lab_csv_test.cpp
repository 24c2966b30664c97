// The CSV reader: what it understands, and what it refuses with which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "calibrate/lab/csv.h"
#include "calibrate/lab/curve.h"
#include "libdem/core/error.h"

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class LabCsv : public testing::Test {
 protected:
  LabCsv() : folder(std::filesystem::temp_directory_path() / ("spall-lab-csv-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder);
  }
  ~LabCsv() override { std::filesystem::remove_all(folder); }

  std::filesystem::path file(const std::string& content) const {
    std::ofstream(folder / "a.csv", std::ios::binary) << content;
    return folder / "a.csv";
  }
  lab::CsvTable read(const std::string& content) const { return lab::read_csv(file(content)); }
  std::vector<double> column(const std::string& content, const std::string& name) const {
    const lab::CsvTable table = read(content);
    return lab::numbers(table, lab::find_column(table, name));
  }
  /// The message of the InputError that reading the columns strain and stress throws.
  std::string refusal(const std::string& content) const {
    try {
      lab::CurveSpec spec;
      lab::read_curve(file(content), spec);
    } catch (const dem::InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("a.csv"), Not(HasSubstr("\n"))));
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path folder;
};

TEST_F(LabCsv, ReadsEverySeparatorAndLineEnding) {
  for (const char* content :
       {"strain[-],stress[MPa]\n0.001,20.5\n0.002,30\n", "strain[-];stress[MPa]\r\n0.001;20.5\r\n0.002;30\r\n",
        "strain[-]\tstress[MPa]\n0.001\t20.5\n0.002\t30",
        "\xEF\xBB\xBFstrain[-],stress[MPa]\r0.001,20.5\r0.002,30\r",
        "strain[-];stress[MPa]\n0,001;20,5\n0,002;30\n", "sep=;\nstrain[-];stress[MPa]\n0,001;20,5\n0,002;30\n",
        "# a test\n\nstrain[-] , stress[MPa]\n# more\n 1e-3 , +20.5\n\n2.0E-03,30,\n",
        "\"strain[-]\",\"stress[MPa]\"\n\"0,001\",\"20,5\"\n\"0,002\",\"30\"\n"}) {
    EXPECT_THAT(column(content, "strain"), ElementsAre(0.001, 0.002)) << content;
    EXPECT_THAT(column(content, "stress"), ElementsAre(20.5, 30)) << content;
  }
}

TEST_F(LabCsv, TakesUnitsFromManyHeaderStyles) {
  for (const char* header :
       {"strain[permil],stress[MPa]", "strain [permil],stress [MPa]", "strain (permil),stress (MPa)",
        "strain / permil,stress / MPa", "strain,stress\npermil,MPa", "strain,stress\n[permil],[MPa]"}) {
    const lab::CsvTable table = read(std::string(header) + "\n1,2\n");
    EXPECT_EQ(table.columns[lab::find_column(table, "strain")].unit, "permil") << header;
    EXPECT_EQ(table.columns[lab::find_column(table, "stress")].unit, "MPa") << header;
    EXPECT_EQ(table.rows(), 1u);
  }
}

TEST_F(LabCsv, FindsAColumnByItsNameOrItsWholeHeader) {
  const lab::CsvTable table = read("phase[0pre1mono2stop],strain[-],strain[mm]\n1,0.1,0.2\n");
  EXPECT_EQ(lab::find_column(table, "phase"), 0u);
  EXPECT_EQ(lab::find_column(table, "phase[0pre1mono2stop]"), 0u);
  EXPECT_EQ(lab::find_column(table, "strain[mm]"), 2u);
  EXPECT_THROW(lab::find_column(table, "strain"), dem::InputError);  // which of the two?
}

TEST_F(LabCsv, ReadsLatin1AndLeavesOtherColumnsAlone) {
  const lab::CsvTable table = read("time,strain[\xB5m/m],note\n12:30:01,5,\"cracks, many \"\"here\"\"\"\n");
  EXPECT_EQ(table.columns[1].unit, "\u00b5m/m");
  EXPECT_EQ(table.cells[0][2], "cracks, many \"here\"");
  EXPECT_THAT(lab::numbers(table, 1), ElementsAre(5));
}

TEST_F(LabCsv, RefusesAMissingColumnAndSuggestsTheNearest) {
  const std::string message = refusal("strian[-],stress[MPa],force[kN]\n1,2,3\n");
  EXPECT_THAT(message,
              AllOf(HasSubstr("\"strain\""), HasSubstr("did you mean \"strian\""), HasSubstr("force")));
  EXPECT_THAT(refusal("strain stress\n1 2\n"), HasSubstr("commas, semicolons or tabs"));
}

TEST_F(LabCsv, RefusesUnitsThatAreNoStressOrStrain) {
  EXPECT_THAT(refusal("strain[-],stress[kN]\n1,2\n"), AllOf(HasSubstr("stress[kN]"), HasSubstr("area")));
  EXPECT_THAT(refusal("strain[-],stress[Mpa]\n1,2\n"), HasSubstr("did you mean \"MPa\""));
  EXPECT_THAT(refusal("strain[-],stress[furlong]\n1,2\n"), HasSubstr("no unit of stress"));
  EXPECT_THAT(refusal("strain[-],stress\n1,2\n"), HasSubstr("no unit"));
  EXPECT_THAT(refusal("strain[mm],stress[MPa]\n1,2\n"), HasSubstr("gauge length"));
  EXPECT_THAT(refusal("strain[degree],stress[MPa]\n1,2\n"), HasSubstr("no unit of strain"));
  EXPECT_THAT(refusal("strain[s],stress[MPa]\n1,2\n"), HasSubstr("no unit of strain"));
}

TEST_F(LabCsv, RefusesCellsThatAreNoNumbers) {
  for (const char* cell : {"nan", "NaN", "inf", "-inf", "text", "12 MPa", "1,234.5", "0x10", "1e999", "--1"}) {
    const std::string message =
        refusal("strain[-];stress[MPa]\n# comment\n0.001;1.5\n0.002;" + std::string(cell) + "\n0.003;3.5\n");
    EXPECT_THAT(message, AllOf(HasSubstr("row 4"), HasSubstr("\"stress\""), HasSubstr(cell))) << cell;
  }
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n0.001,\n"), AllOf(HasSubstr("row 2"), HasSubstr("empty")));
  EXPECT_THAT(refusal("strain[-];stress[MPa]\n0,001;1,5\n0,002;2.5\n"),
              AllOf(HasSubstr("row 3"), HasSubstr("thousands")));
}

TEST_F(LabCsv, RefusesRaggedRows) {
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n0.001,1\n0.002\n0.003,3\n"),
              AllOf(HasSubstr("row 3"), HasSubstr("1 cell")));
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n0.001,1,7\n0.002,2\n"),
              AllOf(HasSubstr("row 2"), HasSubstr("3 cells")));
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n0,001,1,5\n0,002,2,5\n"),
              HasSubstr("semicolons"));  // decimal commas
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n0.001,\"1\n"), AllOf(HasSubstr("row 2"), HasSubstr("quote")));
}

TEST_F(LabCsv, RefusesFilesWithoutATable) {
  for (const char* empty : {"", "\n\n", "# nothing\n", "\xEF\xBB\xBF"})
    EXPECT_THAT(refusal(empty), HasSubstr("is empty"));
  EXPECT_THAT(refusal("strain[-],stress[MPa]\n"), HasSubstr("no rows"));
  EXPECT_THAT(refusal("0.001,1\n0.002,2\n"), HasSubstr("header"));
  EXPECT_THAT(refusal(std::string("\xFF\xFEs\0t\0", 6)), HasSubstr("UTF-8"));
  EXPECT_THROW(lab::read_csv(folder / "none.csv"), dem::InputError);
  EXPECT_THROW(lab::read_csv(folder), dem::InputError);
}

}  // namespace
