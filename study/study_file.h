// A study: which specimens, which cards, which parameters vary, which tests. What study.toml says, checked.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "libdem/config/toml_reader.h"
#include "libdem/core/input_file.h"
#include "libdem/core/units.h"
#include "libdem/material/material_card.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/catalogue.h"

namespace study {

using virtual_tests::name_of;
using virtual_tests::TestKind;

/// One virtual test that every specimen goes through, or those of some groups.
struct VirtualTest {
  std::string name;  ///< unique in the study; the kind's own name unless the file gives another
  TestKind kind = TestKind::elastic;
  virtual_tests::TestOptions options;  ///< of that kind
  std::vector<std::string> groups{};   ///< of specimens that go through it; empty: all of them
};

/// One specimen: how to pack it, or the file that holds it.
struct SpecimenRecipe {
  std::string group;                  ///< the name of its [[specimen]]
  specimens::PackingOptions packing;  ///< of a file: shape, size, elements and seed as found there
  std::filesystem::path file;         ///< empty: packed
  std::string sha256;                 ///< of the specimen in `file`
};
/// "samples 1-10, seed 3".
std::string label_of(const SpecimenRecipe& recipe);

/// One number of the card that the study varies: listed values (factorial) or a range (Sobol).
struct Parameter {
  std::string key;  ///< as in card.toml, or `stiffness_ratio_key`
  dem::Quantity kind = dem::Quantity::ratio;
  std::vector<double> values;  ///< factorial: SI, in the order given
  double from = 0, to = 0;     ///< Sobol: SI
  bool logarithmic = false;    ///< even in the logarithm
};
/// Ks/Kn of the links at unchanged Kn: sets E and nu of the card by Eq. 1.
inline constexpr const char* stiffness_ratio_key = "Ks_over_Kn";

enum class DesignKind { factorial, sobol };

struct StudyCard {
  std::string name;            ///< the file's name without its ending
  std::filesystem::path file;  ///< as found
  dem::MaterialCard card;
};

struct Study {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> notes;
  std::vector<StudyCard> cards;           ///< at least one
  std::vector<SpecimenRecipe> specimens;  ///< at least one, none twice
  std::vector<Parameter> parameters;      ///< may be empty
  DesignKind design = DesignKind::factorial;
  std::size_t points = 0;              ///< Sobol: N
  bool sensitivity = false;            ///< Sobol: Saltelli's design A, B, AB_i of N (d + 2) points instead of N
  std::vector<VirtualTest> tests;      ///< at least one
  std::vector<dem::InputFile> inputs;  ///< every file that was read, for the provenance
};

/// Reads study.toml (docs/studies.md lists the keys), its cards, and the specimens that it takes from files.
/// Throws InputError.
Study read_study(const std::filesystem::path& file);
/// The same of a table from elsewhere; paths in it are relative to the folder of the file that it names.
Study study_of(const dem::TomlTable& root);

}  // namespace study
