// Text and numbers on their way into a page.
#pragma once
#include <string>
#include <string_view>

namespace report {

/// Escapes &, <, >, " and ' for element content and for attributes; control characters that HTML forbids become
/// a space.
std::string escape(std::string_view text);

/// About `digits` significant digits, without an exponent where a reader would not want one; a dash if not
/// finite.
std::string number_text(double value, int digits = 4);

/// 0.0123 -> "+1.23 %", with a true minus sign; a dash if not finite.
std::string signed_percent(double fraction);

/// JSON that may stand inside a <script> element: within one only "</script" and "<!--" would be trouble, and
/// without any "<" neither can occur.
std::string script_json(std::string_view json);

/// An exponent as superscript digits: -3 -> "⁻³".
std::string superscript(int exponent);

}  // namespace report
