// What the documents say about case files holds: every ```toml block of theirs, and every case that is typed in
// the tutorial, can be read, and every key that a table of a case allows stands in docs/cases.md.
#include "calibrate/calibration_case.h"
#include "libdem/core/error.h"
#include "specimens/packing.h"
#include "specimens/specimen_file.h"
#include "tests/cli/command.h"

namespace {

const std::filesystem::path source = SPALL_SOURCE_DIR;

std::vector<std::string> blocks_between(const std::string& text, const std::string& begin,
                                        const std::string& end) {
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    const std::size_t stop = text.find(end, at);
    blocks.push_back(text.substr(at, stop - at) + "\n");
    at = stop;
  }
  return blocks;
}

class DocsExamples : public cli::Command {
 protected:
  /// The files that the examples name: curves of a concrete of 30 GPa and 30 MPa, a slab, and the project's
  /// data.
  void SetUp() override {
    cli::Command::SetUp();
    std::filesystem::create_directories(folder / "curves");
    for (const char* name : {"curves/a.csv", "curves/b.csv"}) {
      std::string text = "strain[-],stress[MPa]\n";
      for (int k = 1; k <= 60; ++k) {
        const double eta = 1.3 * k / 60;
        text += std::to_string(2e-3 * eta) + "," + std::to_string(30 * eta * (2 - eta)) + "\n";
      }
      write(name, text);
    }
    std::filesystem::create_directory_symlink(source / "data", folder / "data");
  }

  std::string refusal_of(const std::string& text) const {
    write("case.toml", text);
    try {
      calibrate::read_case(folder / "case.toml");
    } catch (const dem::InputError& error) {
      return error.what();
    }
    return "";
  }
};

}  // namespace

TEST_F(DocsExamples, EveryTomlBlockIsACase) {
  specimens::PackingOptions slab;  // as docs/cases.md makes it
  slab.size = {1.0, 0.5, 0.28};
  slab.elements = 12000;
  slab.seed = 7;
  specimens::write_specimen(folder / "slab.h5", specimens::make_specimen(slab));
  int blocks = 0;
  for (const char* document : {"README.md", "docs/cases.md", "docs/tutorial.md"}) {
    const std::string text = cli::content_of(source / document);
    auto cases = blocks_between(text, "```toml\n", "\n```");
    for (const std::string& typed : blocks_between(text, "<<'CASE'\n", "\nCASE")) cases.push_back(typed);
    for (const std::string& block : cases) {
      // Cases of impacts are read by unit/scene_file_test.
      if (block.find("[impactor]") != std::string::npos) continue;
      EXPECT_EQ(refusal_of(block), "") << document << ":\n" << block;
      ++blocks;
    }
  }
  EXPECT_GE(blocks, 5);
}

TEST_F(DocsExamples, EveryKeyIsDocumented) {
  const std::string page = cli::content_of(source / "docs/cases.md");
  const std::string targets = "[targets]\nE = \"30 GPa\"\nft = \"3 MPa\"\n";
  for (const std::string table : {"", "[targets]", "[targets.tolerance]", "[tension]", "[compression]",
                                  "[code]", "[fixed]", "[start]", "[specimen]"}) {
    const std::string told = refusal_of((table == "[targets]" ? "" : targets) +
                                        (table.empty() ? "" : table + "\n") + "qqqqqqqqqqqqqqqqqq = 1\n");
    const std::string mark = "allowed: ";
    // At the top, the key has to stand before any table.
    const std::string line = table.empty() ? refusal_of("qqqqqqqqqqqqqqqqqq = 1\n" + targets) : told;
    const auto at = line.find(mark);
    ASSERT_NE(at, std::string::npos) << table << ": " << line;
    std::istringstream keys(line.substr(at + mark.size()));
    for (std::string key; std::getline(keys >> std::ws, key, ',');)
      EXPECT_NE(page.find("`" + key + "`"), std::string::npos) << table << " " << key << " is not documented";
  }
}
