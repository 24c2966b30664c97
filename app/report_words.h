// The keys of result.json in people's words and units, for its page.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "report/page.h"

namespace app {

using Json = nlohmann::ordered_json;

/// How a key of result.json is shown: in words, with a unit that people use and the factor into it.
struct Label {
  std::string words, unit;
  double factor = 1;
};
/// A key that is not known is shown as it is, its underscores as spaces.
Label label_of(const std::string& key);

/// The value with its unit: "3.12 MPa", "yes", "free".
std::string value_words(const std::string& key, const Json& value);
/// A number that is already in `unit`: "3.12 MPa"; digits are the significant ones.
std::string with_unit(double value, const std::string& unit, int digits = 4);
/// With a capital letter at its beginning.
std::string capital(const std::string& words);
/// "permil" -> "‰", "J/m2" -> "J/m²", "-" -> "".
std::string people_unit(const std::string& unit);

/// NaN if the key is not there or holds no number.
double number(const Json& object, const std::string& key);
/// "" if the key is not there or holds no text.
std::string text(const Json& object, const std::string& key);
/// The key's list, or an empty one.
const Json& list_of(const Json& object, const std::string& key);

/// Those of `keys` that `object` has, in that order.
report::KeyValues rows_of(const Json& object, std::initializer_list<const char*> keys);

}  // namespace app
