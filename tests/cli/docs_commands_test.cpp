// What the documents tell a reader to type works: every ```sh block of a page is run, in order, in one folder,
// as a reader would who follows the page from its top.
//
// A comment on the line before a block changes that:
//   <!-- file: case.toml -->      the block is the content of that file, which is there from the start
//   <!-- not run here: why -->    the block is not run; for what installs, takes hours or needs a cluster
#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <sstream>

#include "tests/cli/command.h"

namespace {

const std::filesystem::path source = SPALL_SOURCE_DIR;

struct Block {
  std::string language, text, file, why_not_run;
  int line = 0;  ///< of the page, where it begins
};

/// What a comment of the form <!-- name: value --> says; empty if it is none.
std::string comment_value(const std::string& line, const std::string& name) {
  const std::string begin = "<!-- " + name + ": ", end = " -->";
  if (!line.starts_with(begin) || !line.ends_with(end)) return "";
  return line.substr(begin.size(), line.size() - begin.size() - end.size());
}

std::vector<Block> blocks_of(const std::filesystem::path& page) {
  std::ifstream in(page);
  std::vector<Block> blocks;
  std::string line, before;
  bool inside = false;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside)
        blocks.push_back(
            {line.substr(3), "", comment_value(before, "file"), comment_value(before, "not run here"), number});
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
    before = line;
  }
  EXPECT_FALSE(inside) << page << ": a block has no end";
  return blocks;
}

std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> all = {source / "README.md", source / "CONTRIBUTING.md"};
  for (const auto& entry : std::filesystem::directory_iterator(source / "docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

class DocsCommands : public cli::Command, public testing::WithParamInterface<std::filesystem::path> {
 protected:
  /// What the pages take for granted: the project's data, curves of one's own.
  void SetUp() override {
    cli::Command::SetUp();
    std::filesystem::create_directories(folder / "curves");
    for (const char* name : {"curves/a.csv", "curves/b.csv"}) {
      std::string text = "strain[-],stress[MPa]\n";
      for (int k = 1; k <= 60; ++k) {
        const double eta = 1.3 * k / 60;
        text += fmt::format("{},{}\n", 2e-3 * eta, 30 * eta * (2 - eta));
      }
      write(name, text);
    }
    std::filesystem::create_directory_symlink(source / "data", folder / "data");
  }
};

std::string name_of(const testing::TestParamInfo<std::filesystem::path>& page) {
  std::string name = page.param.stem().string();
  std::erase_if(name, [](unsigned char letter) { return std::isalnum(letter) == 0; });
  return name;
}

}  // namespace

TEST_P(DocsCommands, CanBeTypedOneAfterAnother) {
  const std::vector<Block> blocks = blocks_of(GetParam());
  for (const Block& block : blocks)
    if (!block.file.empty()) write(block.file, block.text);
  const std::string path = fmt::format("export PATH={}:$PATH OMP_NUM_THREADS=1\n",
                                       std::filesystem::path(SPALL_BINARY).parent_path().string());
  int run = 0;
  for (const Block& block : blocks) {
    if (block.language != "sh" || !block.why_not_run.empty()) continue;
    write(".block.sh", path + block.text);
    const cli::Outcome outcome = wait_for(start_program("bash", {"-eu", ".block.sh"}));
    EXPECT_EQ(outcome.code, 0) << GetParam() << ":" << block.line << "\n" << outcome.out << outcome.err;
    ++run;
  }
  std::cout << run << " blocks of commands run\n";
}

INSTANTIATE_TEST_SUITE_P(Pages, DocsCommands, testing::ValuesIn(pages()), name_of);

TEST(DocsBlocks, EachSaysWhatItIsAndNoCommandHidesElsewhere) {
  const std::set<std::string> languages = {"sh", "toml", "python", "json", "text", "cpp", "cmake", "csv"};
  for (const std::filesystem::path& page : pages()) {
    for (const Block& block : blocks_of(page)) {
      const std::string where = fmt::format("{}:{}", page.filename().string(), block.line);
      EXPECT_TRUE(languages.contains(block.language)) << where << ": \"" << block.language << "\"";
      if (block.language != "sh") {
        EXPECT_THAT(block.text, testing::Not(testing::StartsWith("spall "))) << where;
      }
    }
    // An indented block of commands would be one that nobody runs.
    std::istringstream lines(cli::content_of(page));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      for (const char* command : {"    spall ", "    ./dev ", "    cmake "})
        EXPECT_FALSE(line.starts_with(command)) << page.filename() << ":" << number;
    }
  }
}
