#include "libdem/config/toml_reader.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "libdem/config/nearest_name.h"
#include "libdem/core/error.h"
#include "libdem/core/input_file.h"
#include "libdem/core/sha256.h"

namespace dem {

struct TomlTable::Node {
  std::shared_ptr<const toml::table> document;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::string sha256;  // of the text
  std::string file;
  std::string path;                // "" or "loading." or "virtual_test[2]."
  std::vector<std::string> asked;  // in the order of asking
  std::vector<std::shared_ptr<Node>> children;
};

namespace {

/// A message is one line, whatever the file contains.
std::string printable(std::string_view text) {
  std::string result(text.substr(0, 80));
  for (char& letter : result)
    if (static_cast<unsigned char>(letter) < 32 || letter == 127) letter = ' ';
  return text.size() > 80 ? result + "..." : result;
}

std::string written(const toml::node& value) {
  if (const auto* text = value.as_string()) return fmt::format("\"{}\"", printable(text->get()));
  if (value.is_table()) return "a table";
  if (value.is_array()) return "a list";
  std::ostringstream out;
  value.visit([&](const auto& held) { out << held; });
  return printable(out.str());
}

std::string unit_of_example(Quantity kind) {
  const std::string_view shown = example(kind);
  const auto space = shown.find(' ');
  return space == std::string_view::npos ? "" : std::string(shown.substr(space));
}

}  // namespace

/// What the getters share: looking up, remembering what was asked for, and complaining.
struct TomlTable::Access {
  const TomlTable& owner;
  std::string_view key;

  const toml::node* find() const {
    Node& whole = *owner.node;
    if (std::find(whole.asked.begin(), whole.asked.end(), key) == whole.asked.end())
      whole.asked.emplace_back(key);
    return whole.table->get(key);
  }
  const toml::node& need(const std::string& remedy) const {
    const toml::node* found = find();
    if (found == nullptr) missing(remedy);
    return *found;
  }
  [[noreturn]] void missing(std::string remedy) const {
    // Perhaps it is there under a mistyped name.
    std::vector<std::string> strangers;
    for (const auto& [name, value] : *owner.node->table)
      if (std::find(owner.node->asked.begin(), owner.node->asked.end(), name.str()) == owner.node->asked.end())
        strangers.emplace_back(name.str());
    if (const std::string near = nearest_name(key, strangers); !near.empty())
      remedy += fmt::format(" (there is a key \"{}\": is it meant?)", printable(near));
    owner.fail(key, "the key is missing", remedy);
  }

  double as_quantity(const toml::node& value, Quantity kind) const {
    if (const auto* text = value.as_string()) return parse_quantity(text->get(), kind, owner.where(key));
    if (!value.is_number())
      owner.fail(key, fmt::format("{} is not a quantity", written(value)),
                 fmt::format("write it as in {} = \"{}\"", key, example(kind)));
    if (kind == Quantity::ratio) return as_number(value);
    owner.fail(
        key, fmt::format("{} is a bare number, its unit is missing", written(value)),
        fmt::format("write the unit too, as in {} = \"{}{}\"", key, written(value), unit_of_example(kind)));
  }
  double as_number(const toml::node& value) const {
    const std::optional<double> number = value.is_number() ? value.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number))
      owner.fail(key, fmt::format("{} is not a finite number", written(value)),
                 fmt::format("write it without unit and without quotes, as in {} = 0.2", key));
    return *number;
  }
  std::int64_t as_integer(const toml::node& value) const {
    if (!value.is_integer())
      owner.fail(key, fmt::format("{} is not an integer", written(value)),
                 fmt::format("write it as in {} = 3", key));
    return value.as_integer()->get();
  }
  std::string as_text(const toml::node& value) const {
    if (!value.is_string())
      owner.fail(key, fmt::format("{} is not text", written(value)),
                 fmt::format("write it as in {} = \"...\"", key));
    return value.as_string()->get();
  }
  template <class Convert>
  auto list(const std::string& remedy, Convert convert) const {
    const toml::node& value = need(remedy);
    if (!value.is_array()) owner.fail(key, fmt::format("{} is not a list", written(value)), remedy);
    std::vector<decltype(convert(value))> result;
    for (const toml::node& item : *value.as_array()) result.push_back(convert(item));
    return result;
  }
  TomlTable below(const toml::table& table, const std::string& path) const {
    // Asked twice, a table remembers both times what was asked of it.
    for (const auto& known : owner.node->children)
      if (known->table == &table) return TomlTable(known);
    auto child = std::make_shared<Node>();
    child->document = owner.node->document;
    child->sha256 = owner.node->sha256;
    child->table = &table;
    child->file = owner.node->file;
    child->path = path;
    owner.node->children.push_back(child);
    return TomlTable(child);
  }
};

namespace {

/// Each dot of a.b.c is a table in a table, which the parser's recursion does not survive by the ten thousand.
void refuse_deep_keys(std::string_view text, const std::string& name) {
  constexpr std::size_t deepest = 100;
  std::size_t dots = 0, line = 1;
  char quote = 0;  // of the text under way, whose dots are its own
  for (const char letter : text) {
    if (letter == '\n') ++line;
    if (quote != 0) {
      if (letter == quote || letter == '\n') quote = 0;
      continue;
    }
    if (letter == '"' || letter == '\'') quote = letter;
    const bool of_a_key = std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                          std::string_view("_-\"' \t.").find(letter) != std::string_view::npos;
    if (letter == '.') ++dots;
    if (!of_a_key) dots = 0;
    if (dots > deepest)
      throw InputError(fmt::format("{}:{}", name, line), "a key of more than 100 parts",
                       "a line is either [table] or key = value, and text stands in quotes");
  }
}

}  // namespace

TomlTable::TomlTable(std::shared_ptr<Node> shared) : node(std::move(shared)) {}

TomlTable TomlTable::read(const std::filesystem::path& file) {
  constexpr std::size_t most = 16 << 20;
  return parse(content_of_input(file, most, "give the path of a TOML file"), file.string());
}

TomlTable TomlTable::parse(std::string_view text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError(name, "the file is empty",
                     "write the keys that are needed, one a line, as in E = \"30 GPa\"");
  refuse_deep_keys(text, name);
  try {
    auto root = std::make_shared<Node>();
    root->document = std::make_shared<const toml::table>(toml::parse(text));
    root->sha256 = sha256_of(std::string(text));
    root->table = root->document.get();
    root->file = name;
    return TomlTable(root);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", name, error.source().begin.line),
                     fmt::format("this is not TOML: {} (column {})", printable(error.description()),
                                 error.source().begin.column),
                     "a line is either [table] or key = value, and text stands in quotes");
  }
}

void TomlTable::allow_only(const std::vector<std::string>& allowed) const {
  for (const auto& [name, value] : *node->table)
    if (std::find(allowed.begin(), allowed.end(), name.str()) == allowed.end())
      fail(name.str(), "unknown key", suggestion(name.str(), allowed));
}

void TomlTable::finish() const {
  allow_only(node->asked);
  for (const auto& child : node->children) TomlTable(child).finish();
}

bool TomlTable::has(std::string_view key) const { return Access{*this, key}.find() != nullptr; }

TomlTable::Kind TomlTable::kind(std::string_view key) const {
  const toml::node* value = Access{*this, key}.find();
  if (value == nullptr) return Kind::absent;
  return value->is_string()    ? Kind::text
         : value->is_number()  ? Kind::number
         : value->is_boolean() ? Kind::boolean
         : value->is_array()   ? Kind::list
         : value->is_table()   ? Kind::table
                               : Kind::other;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::pair<toml::source_position, std::string>> found;
  for (const auto& [name, value] : *node->table) {
    found.emplace_back(name.source().begin, std::string(name.str()));
    Access{*this, name.str()}.find();
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [position, name] : found) names.push_back(std::move(name));
  return names;
}

double TomlTable::quantity(std::string_view key, Quantity kind) const {
  const Access access{*this, key};
  return access.as_quantity(access.need(fmt::format("write it as in {} = \"{}\"", key, example(kind))), kind);
}
std::optional<double> TomlTable::optional_quantity(std::string_view key, Quantity kind) const {
  return has(key) ? std::optional(quantity(key, kind)) : std::nullopt;
}
double TomlTable::quantity(std::string_view key, Quantity kind, double fallback) const {
  return optional_quantity(key, kind).value_or(fallback);
}

double TomlTable::number(std::string_view key) const {
  const Access access{*this, key};
  return access.as_number(access.need(fmt::format("write it as in {} = 0.2", key)));
}
std::optional<double> TomlTable::optional_number(std::string_view key) const {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}
double TomlTable::number(std::string_view key, double fallback) const {
  return optional_number(key).value_or(fallback);
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  const Access access{*this, key};
  const std::int64_t value = access.as_integer(access.need(fmt::format("write it as in {} = 3", key)));
  if (value < low || value > high)
    fail(key, fmt::format("{} is out of range", value),
         low == lowest     ? fmt::format("it must be at most {}", high)
         : high == highest ? fmt::format("it must be at least {}", low)
                           : fmt::format("it must be from {} to {}", low, high));
  return value;
}
std::optional<std::int64_t> TomlTable::optional_integer(std::string_view key, std::int64_t low,
                                                        std::int64_t high) const {
  return has(key) ? std::optional(integer(key, low, high)) : std::nullopt;
}

std::string TomlTable::text(std::string_view key) const {
  const Access access{*this, key};
  return access.as_text(access.need(fmt::format("write it as in {} = \"...\"", key)));
}
std::optional<std::string> TomlTable::optional_text(std::string_view key) const {
  return has(key) ? std::optional(text(key)) : std::nullopt;
}
std::string TomlTable::text(std::string_view key, std::string_view fallback) const {
  return optional_text(key).value_or(std::string(fallback));
}

bool TomlTable::boolean(std::string_view key) const {
  const Access access{*this, key};
  const std::string remedy = fmt::format("write {0} = true or {0} = false", key);
  const toml::node& value = access.need(remedy);
  if (!value.is_boolean()) fail(key, fmt::format("{} is neither true nor false", written(value)), remedy);
  return value.as_boolean()->get();
}
bool TomlTable::boolean(std::string_view key, bool fallback) const {
  return has(key) ? boolean(key) : fallback;
}

std::string TomlTable::choice(std::string_view key, const std::vector<std::string>& names) const {
  const Access access{*this, key};
  const std::string remedy = fmt::format("allowed: {}", fmt::join(names, ", "));
  std::string chosen = access.as_text(access.need(remedy));
  if (std::find(names.begin(), names.end(), chosen) == names.end())
    fail(key, fmt::format("\"{}\" is no choice here", printable(chosen)), suggestion(chosen, names));
  return chosen;
}
std::string TomlTable::choice(std::string_view key, const std::vector<std::string>& names,
                              std::string_view fallback) const {
  return has(key) ? choice(key, names) : std::string(fallback);
}

std::filesystem::path TomlTable::file_path(std::string_view key) const {
  const std::string given = text(key);
  if (given.empty()) fail(key, "the path is empty", "give a path relative to the folder of this file");
  return std::filesystem::path(node->file).parent_path() / given;
}

TomlTable TomlTable::table(std::string_view key) const {
  const Access access{*this, key};
  const std::string remedy =
      fmt::format("write it as [{}{}] with its keys on the lines below", node->path, key);
  const toml::node& value = access.need(remedy);
  if (!value.is_table()) fail(key, fmt::format("{} is not a table", written(value)), remedy);
  return access.below(*value.as_table(), fmt::format("{}{}.", node->path, key));
}
std::optional<TomlTable> TomlTable::optional_table(std::string_view key) const {
  return has(key) ? std::optional(table(key)) : std::nullopt;
}
std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const Access access{*this, key};
  const toml::node* value = access.find();
  if (value == nullptr) return {};
  const std::string remedy =
      fmt::format("write each one as [[{}{}]] with its keys on the lines below", node->path, key);
  if (!value->is_array()) fail(key, fmt::format("{} is not a list of tables", written(*value)), remedy);
  std::vector<TomlTable> result;
  for (const toml::node& item : *value->as_array()) {
    if (!item.is_table()) fail(key, fmt::format("{} is not a table", written(item)), remedy);
    // Counted from 1, as a reader of the file does.
    result.push_back(
        access.below(*item.as_table(), fmt::format("{}{}[{}].", node->path, key, result.size() + 1)));
  }
  return result;
}

std::vector<double> TomlTable::numbers(std::string_view key) const {
  const Access access{*this, key};
  return access.list(fmt::format("write it as in {} = [0.1, 0.5]", key),
                     [&](const toml::node& item) { return access.as_number(item); });
}
std::vector<std::int64_t> TomlTable::integers(std::string_view key) const {
  const Access access{*this, key};
  return access.list(fmt::format("write it as in {} = [1, 2, 3]", key),
                     [&](const toml::node& item) { return access.as_integer(item); });
}
std::vector<std::string> TomlTable::texts(std::string_view key) const {
  const Access access{*this, key};
  return access.list(fmt::format("write it as in {} = [\"...\", \"...\"]", key),
                     [&](const toml::node& item) { return access.as_text(item); });
}
std::vector<double> TomlTable::quantities(std::string_view key, Quantity kind) const {
  const Access access{*this, key};
  const std::string remedy = fmt::format("write it as in {} = [\"{}\"]", key, example(kind));
  const toml::node& value = access.need(remedy);
  if (const auto* together = value.as_string()) return parse_quantities(together->get(), kind, where(key));
  return access.list(remedy, [&](const toml::node& item) { return access.as_quantity(item, kind); });
}

std::string TomlTable::where(std::string_view key) const {
  const std::string full = node->path + printable(key);
  const toml::node* value = node->table->get(key);
  if (value == nullptr || value->source().begin.line == 0) return fmt::format("{}: {}", node->file, full);
  return fmt::format("{}:{}: {}", node->file, value->source().begin.line, full);
}
void TomlTable::fail(std::string_view key, const std::string& what_is_wrong, const std::string& remedy) const {
  throw InputError(where(key), what_is_wrong, remedy);
}
const std::string& TomlTable::file() const { return node->file; }
const std::string& TomlTable::sha256() const { return node->sha256; }

}  // namespace dem
