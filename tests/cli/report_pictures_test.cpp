// spall report --png and --svg: which files there are, that they are pictures, and each way in which they are
// refused.
#include <limits>
#include <nlohmann/json.hpp>

#include "libdem/io/hdf5.h"
#include "tests/cli/command.h"

using testing::AllOf;
using testing::HasSubstr;

namespace {

class ReportPictures : public cli::Command {
 protected:
  /// A run's folder as a test leaves it, without having run: numbers and curves.
  void write_run() const {
    std::filesystem::create_directories(folder / "run");
    write("run/result.json", R"({"test": "tension", "peak_stress": 2e6, "peak_strain": 1e-4})");
    write("run/curves.csv", "strain[-],stress[Pa]\n0,0\n1e-4,2e6\n2e-4,1e6\n");
  }
  /// A short test in time, with its frames.
  void run_tension() const {
    write("card.toml", cli::good_card);
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements",
                                                "1200", "--seed", "1", "-o", "s1.h5"},
                                               {"test", "tension", "--specimen", "s1.h5", "--card", "card.toml",
                                                "-o", "run", "--threads", "1"}}) {
      const auto outcome = spall(arguments);
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
  }
};

bool is_png(const std::string& bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

}  // namespace

TEST_F(ReportPictures, ChartsAndTheSceneOfATestAreFilesNumberedInTheReportsOrder) {
  run_tension();
  const std::string before = read("run/report.html");
  const auto outcome = spall({"report", "run", "--png", "--svg", "--dpi", "60", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  int scenes = 0, charts = 0;
  const auto json = nlohmann::json::parse(outcome.out);
  for (const auto& name : json["pictures"]) {
    const std::filesystem::path file = name.get<std::string>();
    EXPECT_EQ(file.parent_path(), "run/pictures");
    const std::string bytes = read(file.string());
    if (file.extension() == ".svg") {
      ++charts;
      EXPECT_THAT(bytes,
                  AllOf(testing::StartsWith("<?xml"), HasSubstr("width=\"160mm\""), HasSubstr("class=\"line")));
    } else {
      EXPECT_TRUE(is_png(bytes)) << file;
      const auto svg = std::filesystem::path(file).replace_extension(".svg");
      scenes += std::filesystem::exists(folder / svg) ? 0 : 1;
    }
  }
  EXPECT_GE(charts, 1);
  EXPECT_EQ(scenes, 1);
  EXPECT_EQ(read("run/report.html"), before);

  const auto scene_bytes = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"report", "run",        "--png", "--dpi",
                                       "60",     "--pictures", "other", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto told = spall(arguments);
    EXPECT_EQ(told.code, 0) << told.err;
    std::string bytes;
    const auto drawn = nlohmann::json::parse(told.out);
    for (const auto& name : drawn["pictures"]) {
      const std::string file = name.get<std::string>();
      const auto chart = "run/pictures/" + std::filesystem::path(file).stem().string() + ".svg";
      if (!std::filesystem::exists(folder / chart)) bytes = read(file);
    }
    EXPECT_TRUE(is_png(bytes));
    return bytes;
  };
  const std::string whole = scene_bytes({});
  EXPECT_EQ(whole, scene_bytes({"--view", "iso", "--frame", "last", "--field", "damage"}))
      << "the same bytes again";
  EXPECT_NE(whole, scene_bytes({"--cut", "y=0.1 m"}));
  EXPECT_NE(whole, scene_bytes({"--frame", "1"}));
  EXPECT_NE(whole, scene_bytes({"--field", "displacement"}));
  EXPECT_NE(whole, scene_bytes({"--view", "z"}));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--frame", "999"}),
              AllOf(HasSubstr("--frame"), HasSubstr("or last")));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--field", "damagge"}),
              HasSubstr("did you mean \"damage\"?"));
}

TEST_F(ReportPictures, FramesThatAreDamagedAreRefusedByName) {
  namespace fs = std::filesystem;
  run_tension();
  const fs::path frames = folder / "run/frames";
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(frames))
    if (const std::string name = entry.path().filename().string(); name.starts_with("elements_"))
      names.push_back(name);
  std::sort(names.begin(), names.end());
  const auto refused = [&](const std::string& wrong) {
    for (const char* form : {"--png", "--quiet"})
      EXPECT_THAT(refusal(2, {"report", "run", form}), HasSubstr(wrong)) << form;
  };
  const auto put = [&](const std::string& name, const std::vector<double>& points, std::size_t columns,
                       const std::vector<std::int64_t>& corners) {
    dem::Hdf5File out = dem::Hdf5File::create(frames / name);
    out.write("VTKHDF/Points", points, columns);
    out.write("VTKHDF/Connectivity", corners);
    out.close();
  };

  // An impactor of one point, of whose triangles one names another.
  for (const std::string& name : names) put("impactor" + name.substr(8), {0, 0, 0}, 3, {0, 0, 999999999});
  std::string series = read("run/frames/elements.hdf.series");
  for (std::size_t at = 0; (at = series.find("elements", at)) != std::string::npos;)
    series.replace(at, 8, "impactor");
  write("run/frames/impactor.hdf.series", series);
  refused("impactor_0000.hdf: it names point 999999999, of 1");
  for (const std::string& name : names) put("impactor" + name.substr(8), {0, 0, 0}, 3, {0, 0, -1});
  refused("impactor_0000.hdf: it names point -1, of 1");

  put(names.front(), {0, std::numeric_limits<double>::quiet_NaN(), 0}, 3, {});
  refused(names.front() + ": a number of VTKHDF/Points is not finite");
  put(names.front(), {0, 0, 0}, 0, {});
  refused(names.front() + ": dataset VTKHDF/Points: has shape (3)");
}

TEST_F(ReportPictures, MistakesAreToldInOneLineAndNothingIsWritten) {
  EXPECT_THAT(refusal(2, {"report", "none", "--png"}), HasSubstr("none: there is no such folder"));
  write_run();
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--view", "isso"}), HasSubstr("did you mean \"iso\"?"));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--frame", "0"}), HasSubstr("a number from 1, or last"));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--cut", "w=1 m"}), HasSubstr("--cut \"y=0.1 m\""));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--cut", "y=1 kg"}), HasSubstr("--cut"));
  EXPECT_THAT(refusal(2, {"report", "run", "--png", "--width", "2 mm"}), HasSubstr("40 mm to 1200 mm"));
  EXPECT_THAT(refusal(2, {"report", "run", "--svg", "--width", "100"}), HasSubstr("unit is missing"));
  EXPECT_THAT(refusal(2, {"report", "run", "--view", "x"}), HasSubstr("--png"));
  EXPECT_THAT(refusal(1, {"report", "run", "--png", "--pictures", "run/result.json"}),
              HasSubstr("run/result.json"));
  EXPECT_THAT(refusal(1, {"report", "run", "--png", "--pictures", "/proc/pictures"}),
              HasSubstr("/proc/pictures"));
  std::filesystem::remove(folder / "run" / "curves.csv");
  std::filesystem::remove_all(folder / "run" / "frames");
  EXPECT_THAT(refusal(2, {"report", "run", "--png"}), HasSubstr("there is no chart to draw"));
}
