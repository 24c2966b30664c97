#include "report/scene_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.h"
#include "report/scene_pack.h"

namespace report {
namespace {

// 20000 -> "20,000"
std::string counted(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
  return digits;
}

std::string several(std::size_t number, const char* one, const char* many) {
  return counted(number) + " " + (number == 1 ? one : many);
}

}  // namespace

std::string scene_words(const Scene& scene) {
  std::string words = several(scene.elements(), "element", "elements");
  if (!scene.mesh_faces.empty())
    words += fmt::format(" and a mesh of {}", several(scene.mesh_nodes.size() / 3, "node", "nodes"));
  if (scene.frames.empty()) return words + ".";
  const Scene::Frame& last = scene.frames.back();
  if (scene.frames.size() > 1)
    words += fmt::format(" in {} frames, from {} to {}", scene.frames.size(), scene.frames.front().label,
                         last.label);
  words += ".";
  std::string end;
  for (std::size_t f = 0; f < std::min(scene.fields.size(), last.values.size()); ++f) {
    double largest = -INFINITY;
    for (const float value : last.values[f])
      if (std::isfinite(value)) largest = std::max(largest, static_cast<double>(value));
    if (!std::isfinite(largest)) continue;
    const std::string& unit = scene.fields[f].unit;
    end += fmt::format("{}{} up to {}{}", end.empty() ? "" : ", ", scene.fields[f].name,
                       number_text(largest, 3), unit.empty() ? "" : " " + unit);
  }
  end +=
      fmt::format("{}{} broken", end.empty() ? "" : ", ", several(scene.broken_links.size(), "link", "links"));
  return words + " At the end: " + end + ".";
}

std::string scene_html(const Scene& scene) {
  const PackedScene packed = pack(scene);
  std::string html = fmt::format(
      "<figure class=\"space\"><div class=\"head\"><h3>{}</h3></div>\n<p class=\"summary\">{}</p>\n"
      "<noscript><p class=\"summary\">The view in space needs scripts.</p></noscript>\n",
      escape(scene.title), escape(scene_words(scene)));
  if (!scene.caption.empty()) html += fmt::format("<figcaption>{}</figcaption>\n", escape(scene.caption));
  html +=
      fmt::format("<script type=\"application/json\">{}</script>\n<script type=\"application/octet-stream\">",
                  packed.header);
  html += base64(packed.data);
  return html + "</script></figure>\n";
}

}  // namespace report
