// study.toml -> Study. docs/studies.md is the reader's side of the study_*.cpp files: keep them together.
#include "study/study_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "libdem/material/card_table.h"
#include "study/study_parts.h"

namespace study {
namespace {

void read_cards(const dem::TomlTable& root, Study& study) {
  if (root.has("card") && root.has("cards"))
    root.fail("cards", "stands beside card",
              "give one of them: card = \"a.toml\" or cards = [\"a.toml\", ...]");
  const char* key = root.has("cards") ? "cards" : "card";
  if (!root.has(key))
    root.fail("card", "the key is missing", "name the material card, as in card = \"../cards/r30a7.toml\"");
  const std::filesystem::path base = study.file.parent_path();
  for (const std::string& text : one_or_more_texts(root, key)) {
    StudyCard card;
    card.file = base / text;
    card.name = card.file.stem().string();
    std::error_code error;
    if (text.empty() || !std::filesystem::is_regular_file(card.file, error))
      root.fail(key, fmt::format("there is no file \"{}\"", text),
                "name cards that exist, relative to the study file");
    const dem::TomlTable table = dem::TomlTable::read(card.file);
    card.card = dem::card_of(table);
    for (const StudyCard& other : study.cards)
      if (other.name == card.name)
        root.fail(key, fmt::format("two cards are called \"{}\"", card.name),
                  "rows are told apart by the card's file name: rename one");
    study.inputs.push_back({"card", card.file, table.sha256()});
    study.cards.push_back(std::move(card));
  }
}

}  // namespace

std::string label_of(const SpecimenRecipe& recipe) {
  return recipe.file.empty() ? fmt::format("{}, seed {}", recipe.group, recipe.packing.seed)
                             : fmt::format("{}, {}", recipe.group, recipe.file.filename().string());
}

std::vector<std::string> one_or_more_texts(const dem::TomlTable& table, const char* key) {
  if (table.kind(key) == dem::TomlTable::Kind::text) return {table.text(key)};
  std::vector<std::string> texts = table.texts(key);
  if (texts.empty()) table.fail(key, "the list is empty", fmt::format("write it as in {} = [\"...\"]", key));
  return texts;
}

Study read_study(const std::filesystem::path& file) {
  const dem::TomlTable table = dem::TomlTable::read(file);
  Study study = study_of(table);
  study.inputs.insert(study.inputs.begin(), {"study", file, table.sha256()});
  return study;
}

Study study_of(const dem::TomlTable& root) {
  const std::filesystem::path file = root.file();
  root.allow_only({"name", "notes", "card", "cards", "specimen", "vary", "design", "points", "sensitivity",
                   "tests", "test"});
  Study study;
  study.file = file;
  study.name = root.text("name", file.stem().string());
  if (study.name.empty()) root.fail("name", "is empty", "give the study a name, or leave the key out");
  if (root.has("notes")) study.notes = root.texts("notes");
  read_cards(root, study);
  read_design(root, study);
  read_specimen_groups(root, study);
  read_tests(root, study);
  root.finish();
  return study;
}

}  // namespace study
