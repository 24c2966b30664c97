// spall specimen: make, extract, inspect, and files that are no specimens.
#include <nlohmann/json.hpp>

#include "libdem/io/hdf5.h"
#include "tests/cli/command.h"

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

class Specimen : public cli::Command {
 protected:
  static std::vector<std::string> make(const std::string& size, const std::string& elements,
                                       const std::string& output) {
    return {"specimen", "make", "--size", size, "--elements", elements, "--seed", "1", "-o", output};
  }
};

TEST_F(Specimen, MakeAndInspectAgree) {
  auto command = make("0.3x0.2x0.2 m", "1000", "s1.h5");
  command.push_back("--json");
  const auto made = spall(command);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  const auto inspected = spall({"specimen", "inspect", "s1.h5", "--json"});
  ASSERT_EQ(inspected.code, 0) << inspected.err;
  EXPECT_EQ(made.out, inspected.out);
  const auto json = nlohmann::json::parse(inspected.out);
  for (const char* key :
       {"elements", "links", "mean_interior_coordination", "interaction_radius_factor", "solid_fraction",
        "radius_min", "radius_max", "fabric_eigenvalues", "size", "isotropic", "sha256"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["elements"], 1000);
  EXPECT_NEAR(json["mean_interior_coordination"].get<double>(), 12, 0.05);
}

TEST_F(Specimen, TheSameSeedGivesTheSameBytesWithAnyNumberOfThreads) {
  auto one = make("0.3x0.2x0.2 m", "1000", "a.h5"), two = make("0.3x0.2x0.2 m", "1000", "b.h5");
  one.insert(one.end(), {"--threads", "1"});
  two.insert(two.end(), {"--threads", "2", "--quiet"});
  ASSERT_EQ(spall(one).code, 0);
  const auto quiet = spall(two);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(read("a.h5"), read("b.h5"));
}

TEST_F(Specimen, WrongSizesAreRefused) {
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25 kg", "2700", "out/s.h5")),
              AllOf(HasSubstr("--size"), HasSubstr("length")));
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25", "2700", "out/s.h5")),
              AllOf(HasSubstr("--size"), HasSubstr("unit is missing")));
  EXPECT_THAT(refusal(2, make("0.5x0.25 m", "2700", "out/s.h5")),
              AllOf(HasSubstr("--size"), HasSubstr("instead of 3")));
  EXPECT_THAT(refusal(2, make("0.5x-0.25x0.25 m", "2700", "out/s.h5")), HasSubstr("greater than 0"));
  EXPECT_THAT(refusal(2, make("0.5xnanx0.25 m", "2700", "out/s.h5")), HasSubstr("finite number"));
  EXPECT_THAT(refusal(2, make("wide", "2700", "out/s.h5")), HasSubstr("--size"));
  EXPECT_THAT(refusal(2, {"specimen", "make", "--elements", "2700", "-o", "s.h5"}),
              HasSubstr("--size is required"));
}

TEST_F(Specimen, TooFewElementsAreRefused) {
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25 m", "50", "out/s.h5")), HasSubstr("elements"));
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25 m", "0", "out/s.h5")), HasSubstr("--elements"));
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25 m", "-3", "out/s.h5")), HasSubstr("--elements"));
  EXPECT_THAT(refusal(2, make("0.5x0.25x0.25 m", "many", "out/s.h5")), HasSubstr("--elements"));
}

TEST_F(Specimen, AFolderThatCannotBeWrittenIsExitCode1BeforePacking) {
  write("file.txt", "x");
  // A packing of this size would take minutes.
  EXPECT_THAT(refusal(1, make("1x1x1 m", "5000000", "file.txt/x/s.h5")), HasSubstr("file.txt/x"));
  EXPECT_THAT(refusal(1, make("1x1x1 m", "5000000", "/proc/x/s.h5")), HasSubstr("/proc/x"));
  EXPECT_THAT(refusal(1, make("1x1x1 m", "5000000", ".")), HasSubstr("folder"));
}

TEST_F(Specimen, FilesThatAreNoSpecimensAreRefused) {
  ASSERT_EQ(spall(make("0.3x0.2x0.2 m", "1000", "good.h5")).code, 0);
  const std::string bytes = read("good.h5");
  write("text.h5", "this is text\n");
  write("empty.h5", "");
  write("half.h5", bytes.substr(0, bytes.size() / 2));
  std::string damaged = bytes;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  write("damaged.h5", damaged);
  dem::create_spall_file(folder / "other.h5", "spall-checkpoint", 1, [](dem::Hdf5File&) {});
  { dem::Hdf5File::create(folder / "foreign.h5").close(); }
  for (const char* file :
       {"text.h5", "empty.h5", "half.h5", "damaged.h5", "other.h5", "foreign.h5", "none.h5"}) {
    EXPECT_THAT(refusal(2, {"specimen", "inspect", file}), HasSubstr(file));
    EXPECT_THAT(refusal(2, {"specimen", "inspect", file, "--json"}), HasSubstr(file));
    EXPECT_THAT(refusal(2, {"specimen", "extract", file, "--centre", "0.15,0.1,0.1 m", "--size",
                            "0.1x0.1x0.1 m", "-o", "out/part.h5"}),
                HasSubstr(file));
  }
}

TEST_F(Specimen, ExtractRefusesRegionsThatAreOutsideOrTooSmall) {
  ASSERT_EQ(spall(make("0.3x0.2x0.2 m", "1000", "s.h5")).code, 0);
  EXPECT_NE(refusal(2, {"specimen", "extract", "s.h5", "--centre", "1.25,1.0,0.14 m", "--size", "0.2x0.2x0.2 m",
                        "-o", "p.h5"}),
            "");
  EXPECT_NE(refusal(2, {"specimen", "extract", "s.h5", "--centre", "0.15,0.1,0.1 m", "--size",
                        "0.05x0.05x0.05 m", "-o", "p.h5"}),
            "");
  EXPECT_THAT(refusal(2, {"specimen", "extract", "s.h5", "--centre", "0.15,0.1 m", "--size", "0.2x0.2x0.2 m",
                          "-o", "p.h5"}),
              HasSubstr("--centre"));
  const auto cut = spall(
      {"specimen", "extract", "s.h5", "--centre", "0.15,0.1,0.1 m", "--size", "0.2x0.2x0.2 m", "-o", "p.h5"});
  EXPECT_EQ(cut.code, 0) << cut.err;
}
