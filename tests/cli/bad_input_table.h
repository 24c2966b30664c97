// The table of wrong inputs: bad_input/*.toml, each row a wrong input and the line that must refuse it.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cli {

/// A row. Its files lie in a folder of their own, in which its command runs.
///
///     files = ["case.toml"]                      # taken as they are from bad_input/base/
///     folders = ["out"]                          # made
///     made = { "s.h5" = "NaN radius" }           # made by damaged_files.h, under the name of its damage
///     text = { "curve.csv" = "..." }             # written as it stands here
///     bytes = { "case.toml" = "89 48 44 46" }    # the same for what is no text, in hexadecimal
///     edit = { "case.toml" = ["30 GPa", "30"] }  # each first text, which must be there, becomes the next
///     prepend = { "case.toml" = "..." }          # before what is there
///     append = { "case.toml" = "..." }           # after it
///     command = 'calibrate case.toml -o out'     # words in "..." may hold spaces
///     line = 'spall: case.toml:2: ...'           # all of standard error; <any> stands for any text
///
/// `files`, `made` and `command` may stand at the top of the table's file, for every row that has none.
struct WrongInput {
  using Named = std::vector<std::pair<std::string, std::string>>;
  std::string name;  ///< "file.toml: name"
  std::vector<std::string> files, folders, command;
  Named made, text, bytes, prepend, append;
  std::vector<std::pair<std::string, std::vector<std::string>>> edit;
  std::string line;
};

/// Every row of every .toml in `folder`, in order. Throws dem::InputError if a table is not as described, or a
/// name stands twice in one.
std::vector<WrongInput> read_wrong_inputs(const std::filesystem::path& folder);

/// Puts the row's files into `folder`, which is empty. Throws std::runtime_error if an edit finds nothing.
void place(const WrongInput& row, const std::filesystem::path& base, const std::filesystem::path& folder);

/// Whether `text` is `pattern`, where each <any> of the pattern stands for any text.
bool matches(std::string_view text, std::string_view pattern);

}  // namespace cli
