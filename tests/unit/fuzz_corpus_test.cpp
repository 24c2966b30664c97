// The corpus of the fuzzers, read by the ordinary build: what was found once stays found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tests/fuzz/feeds.h"

namespace {

namespace fs = std::filesystem;

const std::map<std::string, void (*)(std::string_view)> readers{{"calibrate_case", fuzz::calibrate_case},
                                                                {"study_file", fuzz::study_file},
                                                                {"impact_scene", fuzz::impact_scene},
                                                                {"card", fuzz::card},
                                                                {"curve", fuzz::curve},
                                                                {"stl", fuzz::stl},
                                                                {"gmsh", fuzz::gmsh},
                                                                {"gmsh_content", fuzz::gmsh_content},
                                                                {"specimen", fuzz::specimen},
                                                                {"checkpoint", fuzz::checkpoint},
                                                                {"journal", fuzz::journal}};

}  // namespace

TEST(FuzzCorpus, EveryFileIsReadOrRefusedByItsReader) {
  const fs::path corpus = fs::path(SPALL_SOURCE_DIR) / "tests/fuzz/corpus";
  for (const auto& [name, feed] : readers) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(corpus / name)) {
      SCOPED_TRACE(entry.path().string());
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      EXPECT_NO_THROW(feed(bytes));
      // Cut short and with a byte turned over: the same goes for what is nearly right.
      EXPECT_NO_THROW(feed(std::string_view(bytes).substr(0, bytes.size() / 2)));
      std::string other = bytes;
      for (std::size_t at = 0; at < other.size(); at += 1 + other.size() / 8)
        other[at] = static_cast<char>(~other[at]);
      EXPECT_NO_THROW(feed(other));
      ++files;
    }
    EXPECT_GE(files, 1U) << name;
  }
}
