#include "tests/cli/bad_input_table.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "libdem/config/toml_reader.h"
#include "tests/cli/damaged_files.h"

namespace cli {
namespace {

namespace fs = std::filesystem;
using dem::TomlTable;

WrongInput::Named named(const TomlTable& table, const char* key) {
  WrongInput::Named list;
  if (const auto below = table.optional_table(key))
    for (const std::string& name : below->keys()) list.emplace_back(name, below->text(name));
  return list;
}

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  bool open = false, quoted = false;
  for (const char letter : command) {
    if (letter == '"') {
      quoted = !quoted;
      if (quoted && !open) words.emplace_back(), open = true;
    } else if (letter == ' ' && !quoted) {
      open = false;
    } else {
      if (!open) words.emplace_back(), open = true;
      words.back() += letter;
    }
  }
  return words;
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("no file " + file.string());
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}

std::string from_hexadecimal(const std::string& text) {
  std::string bytes;
  for (std::size_t at = 0; at + 1 < text.size(); at += 3)
    bytes += static_cast<char>(std::stoi(text.substr(at, 2), nullptr, 16));
  return bytes;
}

void read_shared(const TomlTable& table, WrongInput& row) {
  if (table.has("files")) row.files = table.texts("files");
  if (table.has("made")) row.made = named(table, "made");
  if (table.has("command")) row.command = words_of(table.text("command"));
}

void read_table(const fs::path& file, std::vector<WrongInput>& rows) {
  const TomlTable root = TomlTable::read(file);
  WrongInput shared;
  read_shared(root, shared);
  std::set<std::string> names;
  for (const TomlTable& table : root.tables("wrong")) {
    WrongInput row = shared;
    const std::string name = table.text("name");
    if (!names.insert(name).second) table.fail("name", "stands twice", "each row has its own");
    row.name = file.filename().string() + ": " + name;
    read_shared(table, row);
    if (table.has("folders")) row.folders = table.texts("folders");
    row.text = named(table, "text"), row.bytes = named(table, "bytes");
    row.prepend = named(table, "prepend"), row.append = named(table, "append");
    if (const auto edits = table.optional_table("edit"))
      for (const std::string& edited : edits->keys()) row.edit.emplace_back(edited, edits->texts(edited));
    row.line = table.text("line");
    rows.push_back(std::move(row));
  }
  root.finish();
}

}  // namespace

std::vector<WrongInput> read_wrong_inputs(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<WrongInput> rows;
  for (const fs::path& file : files) read_table(file, rows);
  return rows;
}

void place(const WrongInput& row, const fs::path& base, const fs::path& folder) {
  for (const std::string& name : row.folders) fs::create_directories(folder / name);
  for (const std::string& name : row.files) write(folder / name, content_of(base / name));
  for (const auto& [name, damage] : row.made) {
    fs::create_directories((folder / name).parent_path());
    make_damaged(damage, folder / name);
  }
  for (const auto& [name, text] : row.text) write(folder / name, text);
  for (const auto& [name, bytes] : row.bytes) write(folder / name, from_hexadecimal(bytes));
  for (const auto& [name, parts] : row.edit) {
    std::string text = content_of(folder / name);
    for (std::size_t k = 0; k + 1 < parts.size(); k += 2) {
      const std::size_t at = text.find(parts[k]);
      if (at == std::string::npos) throw std::runtime_error(name + " does not hold: " + parts[k]);
      text.replace(at, parts[k].size(), parts[k + 1]);
    }
    write(folder / name, text);
  }
  for (const auto& [name, text] : row.prepend) write(folder / name, text + content_of(folder / name));
  for (const auto& [name, text] : row.append) write(folder / name, content_of(folder / name) + text);
}

bool matches(std::string_view text, std::string_view pattern) {
  constexpr std::string_view any = "<any>";
  const std::size_t at = pattern.find(any);
  if (at == std::string_view::npos) return text == pattern;
  if (text.substr(0, at) != pattern.substr(0, at)) return false;
  text.remove_prefix(at), pattern.remove_prefix(at + any.size());
  for (std::size_t begin = 0; begin <= text.size(); ++begin)
    if (matches(text.substr(begin), pattern)) return true;
  return false;
}

}  // namespace cli
