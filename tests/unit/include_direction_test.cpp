// Includes run one way: a room uses the rooms below it, never one above. This test reads every include of the
// tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

// From the ground up. A file belongs to the room with the longest name that begins its path.
constexpr std::array kRooms = {
    "libdem/core",      "libdem/config",   "libdem/io",
    "libdem/material",  "libdem/state",    "libdem/law",
    "libdem/search",    "libdem/statics",  "libdem/force",
    "libdem/motion",    "libdem/drive",    "libdem/probe",
    "libdem/run",       "specimens",       "specimens/virtual_tests",
    "exchange",         "calibrate/lab",   "calibrate",
    "impact/fe",        "impact/coupling", "impact/impactors",
    "impact/outcome",   "impact",          "report",
    "study/statistics", "study",           "app",
    "python",
};

// The room's place in kRooms, or -1 for a path that is in none.
int room_of(std::string_view path) {
  int best = -1;
  std::size_t longest = 0;
  for (std::size_t k = 0; k < kRooms.size(); ++k) {
    const std::string_view room = kRooms[k];
    if (room.size() > longest && path.size() > room.size() && path.starts_with(room) &&
        path[room.size()] == '/') {
      best = static_cast<int>(k);
      longest = room.size();
    }
  }
  return best;
}

// What is wrong with `includer` including `included` (paths from the root); "" if nothing is.
std::string complaint(std::string_view includer, std::string_view included) {
  const int from = room_of(includer), to = room_of(included);
  if (from < 0 || to < 0 || from == to) return "";
  const std::string_view room = kRooms[from], other = kRooms[to];
  const auto within = [](std::string_view name, std::string_view house) {
    return name == house || (name.starts_with(house) && name[house.size()] == '/');
  };
  if ((within(room, "calibrate") && within(other, "impact")) ||
      (within(room, "impact") && within(other, "calibrate")))
    return "calibrate and impact meet in the material card, they never include each other";
  if (room == "report" && other != "libdem/core")
    return "report shows what it is handed: it may use only libdem/core";
  if (to > from) return std::string(other) + " is above " + std::string(room);
  return "";
}

// Every complaint about the include lines of one file.
void read_includes(const fs::path& file, const std::string& name, std::vector<std::string>& complaints) {
  static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">])");
  std::ifstream in(file);
  int line_number = 0;
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    if (!std::regex_search(line, match, pattern)) continue;
    if (const std::string wrong = complaint(name, match[1].str()); !wrong.empty())
      complaints.push_back(name + ":" + std::to_string(line_number) + " includes " + match[1].str() + ": " +
                           wrong);
  }
}

}  // namespace

TEST(IncludeDirection, RunsOneWayThroughoutTheTree) {
  const fs::path root = SPALL_SOURCE_DIR;
  std::vector<std::string> complaints;
  int files = 0;
  for (const char* top :
       {"libdem", "specimens", "exchange", "calibrate", "impact", "report", "study", "app", "python"}) {
    if (!fs::exists(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string name = entry.path().lexically_relative(root).generic_string();
      EXPECT_GE(room_of(name), 0) << name << " is in no room: name its room in this test";
      read_includes(entry.path(), name, complaints);
      ++files;
    }
  }
  EXPECT_GT(files, 10);
  EXPECT_THAT(complaints, testing::IsEmpty());
}

TEST(IncludeDirection, RefusesWhatItShould) {
  EXPECT_NE(complaint("libdem/state/particles.h", "libdem/force/forces.h"), "");
  EXPECT_NE(complaint("libdem/statics/solve.h", "libdem/motion/step.h"), "");
  EXPECT_NE(complaint("libdem/run/run.cpp", "specimens/specimen.h"), "");
  EXPECT_NE(complaint("specimens/packing.cpp", "specimens/virtual_tests/elastic.h"), "");
  EXPECT_NE(complaint("calibrate/lab/lab_curve.h", "calibrate/pipeline.h"), "");
  EXPECT_NE(complaint("calibrate/pipeline.cpp", "report/page.h"), "");
  EXPECT_NE(complaint("calibrate/pipeline.cpp", "impact/scene.h"), "");
  EXPECT_NE(complaint("impact/scene.cpp", "calibrate/pipeline.h"), "");
  EXPECT_NE(complaint("report/page.cpp", "libdem/material/material_card.h"), "");
  EXPECT_NE(complaint("study/runner.cpp", "app/main.h"), "");
  EXPECT_NE(complaint("study/statistics/summary.h", "study/rows.h"), "");
  EXPECT_NE(complaint("study/runner.cpp", "python/job.h"), "");
  EXPECT_NE(complaint("app/main.cpp", "python/job.h"), "");
}

TEST(IncludeDirection, AllowsWhatItShould) {
  EXPECT_EQ(complaint("libdem/force/forces.h", "libdem/state/particles.h"), "");
  EXPECT_EQ(complaint("libdem/force/forces.cpp", "libdem/force/forces.h"), "");
  EXPECT_EQ(complaint("specimens/virtual_tests/elastic.cpp", "specimens/specimen.h"), "");
  EXPECT_EQ(complaint("calibrate/pipeline.cpp", "calibrate/lab/lab_curve.h"), "");
  EXPECT_EQ(complaint("report/page.cpp", "libdem/core/atomic_file.h"), "");
  EXPECT_EQ(complaint("app/verb_report.cpp", "report/page.h"), "");
  EXPECT_EQ(complaint("libdem/core/units.cpp", "fmt/format.h"), "");
  EXPECT_EQ(complaint("python/study.cpp", "study/runner.h"), "");
}
