#include "report/html.h"

#include <fmt/format.h>

#include <cmath>

namespace report {

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default: {
        const auto code = static_cast<unsigned char>(c);
        out += (code < 0x20 && c != '\n' && c != '\t') || code == 0x7f ? ' ' : c;
      }
    }
  }
  return out;
}

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  std::string text = fmt::format("{:.{}g}", value, digits);
  const double magnitude = std::abs(value);
  if (magnitude >= 1e6 || magnitude < 1e-4) {
    const auto mark = text.find('e');
    if (mark == std::string::npos) return text;
    return text.substr(0, mark) + "·10" + superscript(std::stoi(text.substr(mark + 1)));
  }
  return text.find('e') == std::string::npos ? text : fmt::format("{:.0f}", value);
}

std::string signed_percent(double fraction) {
  if (!std::isfinite(fraction)) return "–";
  const double percent = 100 * fraction;
  const int decimals = std::abs(percent) < 10 ? 2 : 1;
  return fmt::format("{}{:.{}f} %", percent < 0 ? "−" : "+", std::abs(percent), decimals);
}

std::string superscript(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
  return out;
}

std::string script_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace report
