#include "app/report_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <variant>

#include "libdem/config/nearest_name.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/core/units.h"
#include "report/picture_chart.h"
#include "report/picture_png.h"

namespace app {
namespace {

/// "Axial stress, MPa" -> "axial-stress-mpa".
std::string file_words(const std::string& title) {
  std::string words;
  for (const char c : title) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (letter)
      words += c;
    else if (c >= 'A' && c <= 'Z')
      words += static_cast<char>(c - 'A' + 'a');
    else if (!words.empty() && words.back() != '-')
      words += '-';
    if (words.size() >= 48) break;
  }
  while (!words.empty() && words.back() == '-') words.pop_back();
  return words.empty() ? std::string("picture") : words;
}

double millimetres(const PictureRequest& request) {
  const double width = 1000 * dem::parse_quantity(request.width, dem::Quantity::length, "--width");
  if (!(width >= 40 && width <= 1200))
    throw dem::InputError("--width", fmt::format("{} is no width of a picture", request.width),
                          "40 mm to 1200 mm");
  constexpr double most_pixels = 6000, millimetres_an_inch = 25.4;
  if (request.png && width / millimetres_an_inch * request.dots_per_inch > most_pixels)
    throw dem::InputError(
        "--width",
        fmt::format("{} at {} dots an inch are too many pixels", request.width, request.dots_per_inch),
        "6,000 side by side at most: lower --dpi or --width");
  return width;
}

report::View view_named(const std::string& name) {
  const auto& names = report::view_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw dem::InputError("--view", "\"" + name + "\" is no view", dem::suggestion(name, names));
  return static_cast<report::View>(found - names.begin());
}

/// Index of a frame, or none for the last. `frames` is 0 where it is not known yet.
std::optional<std::size_t> frame_number(const std::string& words, std::size_t frames) {
  if (words == "last") return std::nullopt;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), number);
  if (error != std::errc() || end != words.data() + words.size() || number < 1 ||
      (frames > 0 && number > frames))
    throw dem::InputError(
        "--frame", fmt::format("\"{}\" is no frame", words),
        frames > 0 ? fmt::format("1 to {}, or last", frames) : std::string("a number from 1, or last"));
  return number - 1;
}

std::optional<report::SceneCut> cut_of(const std::string& words) {
  if (words.empty()) return std::nullopt;
  if (words.size() < 3 || words[0] < 'x' || words[0] > 'z' || words[1] != '=')
    throw dem::InputError("--cut", fmt::format("\"{}\" is no plane", words),
                          "as in --cut \"y=0.1 m\", with x, y or z");
  return report::SceneCut{words[0] - 'x', dem::parse_quantity(words.substr(2), dem::Quantity::length, "--cut")};
}

std::size_t field_of(const report::Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < scene.fields.size(); ++k) {
    if (scene.fields[k].name == name) return k;
    names.push_back(scene.fields[k].name);
  }
  if (name.empty()) return 0;
  throw dem::InputError("--field", fmt::format("\"{}\" is no field of \"{}\"", name, scene.title),
                        dem::suggestion(name, names));
}

report::ScenePictureOptions options_for(const report::Scene& scene, const PictureRequest& request) {
  return {millimetres(request),           request.dots_per_inch,
          view_named(request.view),       frame_number(request.frame, scene.frames.size()),
          field_of(scene, request.field), cut_of(request.cut)};
}

}  // namespace

void PictureRequest::check() const {
  millimetres(*this);
  view_named(view);
  frame_number(frame, 0);
  cut_of(cut);
}

std::vector<std::filesystem::path> draw_pictures(const report::Page& page, const PictureRequest& request,
                                                 const std::filesystem::path& folder) {
  std::vector<const report::Block*> blocks;
  for (const report::Section& section : page.sections)
    for (const report::Block& block : section.blocks) {
      if (const auto* scene = std::get_if<report::Scene>(&block)) {
        if (!request.png) continue;
        options_for(*scene, request);
      } else if (!std::holds_alternative<report::Chart>(block)) {
        continue;
      }
      blocks.push_back(&block);
    }
  if (blocks.empty())
    throw dem::InputError(page.title, "there is no chart to draw, and no frames",
                          "give the folder of a test, a fit, an impact or a study");

  dem::require_writable_folder(folder);
  std::vector<std::filesystem::path> files;
  std::size_t number = 0;
  const auto write = [&](const std::string& title, const char* ending, const std::string& content) {
    files.push_back(folder / fmt::format("{:02}-{}{}", number, file_words(title), ending));
    dem::write_file_atomically(files.back(), content);
  };
  for (const report::Block* block : blocks) {
    ++number;
    if (const auto* scene = std::get_if<report::Scene>(block)) {
      const report::ScenePicture picture = report::scene_picture(*scene, options_for(*scene, request));
      write(scene->title, ".png", report::png_of(picture.image, picture.words));
      continue;
    }
    const auto& chart = std::get<report::Chart>(*block);
    const std::string svg = report::chart_picture(chart, millimetres(request));
    if (request.svg) write(chart.title, ".svg", svg);
    if (request.png) write(chart.title, ".png", report::png_of(svg, request.dots_per_inch));
  }
  return files;
}

}  // namespace app
