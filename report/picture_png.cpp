#include "report/picture_png.h"

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

#include "libdem/core/error.h"

namespace report {
namespace {

struct Free {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Handle = std::unique_ptr<RsvgHandle, Free>;
using Surface = std::unique_ptr<cairo_surface_t, Free>;
using Context = std::unique_ptr<cairo_t, Free>;

[[noreturn]] void refuse(GError* error) {
  const std::string why = error != nullptr ? error->message : "no reason given";
  g_clear_error(&error);
  throw dem::RunError("a picture cannot be drawn: " + why);
}

Handle read(const std::string& svg) {
  GError* error = nullptr;
  Handle handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error));
  if (!handle) refuse(error);
  return handle;
}

/// A white picture. Throws RunError where there is no memory for it.
Surface paper(int width, int height) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw dem::RunError(fmt::format("a picture of {} x {} pixels cannot be made: {}", width, height,
                                    cairo_status_to_string(cairo_surface_status(surface.get()))));
  const Context context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  return surface;
}

void draw(const Surface& surface, const Handle& handle) {
  const Context context(cairo_create(surface.get()));
  const RsvgRectangle all{0, 0, static_cast<double>(cairo_image_surface_get_width(surface.get())),
                          static_cast<double>(cairo_image_surface_get_height(surface.get()))};
  GError* error = nullptr;
  if (rsvg_handle_render_document(handle.get(), context.get(), &all, &error) == 0) refuse(error);
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

std::string encoded(const Surface& surface) {
  cairo_surface_flush(surface.get());
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw dem::RunError(std::string("a picture cannot be encoded: ") + cairo_status_to_string(status));
  return bytes;
}

}  // namespace

std::string png_of(const Image& below, const std::string& svg) {
  const Handle handle = read(svg);
  const Surface surface = paper(below.width, below.height);
  cairo_surface_flush(surface.get());
  unsigned char* data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < below.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    const std::uint8_t* from =
        below.rgb.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(below.width);
    for (int x = 0; x < below.width; ++x, from += 3)
      row[x] = static_cast<std::uint32_t>(from[0]) << 16 | static_cast<std::uint32_t>(from[1]) << 8 | from[2];
  }
  cairo_surface_mark_dirty(surface.get());
  draw(surface, handle);
  return encoded(surface);
}

std::string png_of(const std::string& svg, double dots_per_inch) {
  const Handle handle = read(svg);
  rsvg_handle_set_dpi(handle.get(), dots_per_inch);
  double width = 0, height = 0;
  if (rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height) == 0)
    throw dem::RunError("a picture cannot be drawn: it names no size");
  const Surface surface = paper(static_cast<int>(std::lround(width)), static_cast<int>(std::lround(height)));
  draw(surface, handle);
  return encoded(surface);
}

}  // namespace report
