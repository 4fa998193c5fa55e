#include "strandlab/report/section_picture.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/panel/point_fields.hpp"
#include "strandlab/report/colour_map.hpp"

namespace strandlab::report {
namespace {

constexpr double kTrimmedEnds = 0.02;  // share of the wood at each end that the colour range may leave out

double shown_value(const Strand<2>& strand, std::size_t point, Colouring colouring) {
  return colouring == Colouring::kGrainAngle ? grain_angle_deg<2>(strand.points.F[point])
                                             : density_kg_m3(strand, point);
}

// 1, 2 or 5 times a power of ten, at least `value`.
double round_step(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= value * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

// Round numbers over low..high, about `count` of them.
std::vector<double> ticks(double low, double high, int count) {
  const double step = round_step((high - low) / count);
  std::vector<double> at;
  for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) at.push_back(k * step);
  return at;
}

std::string tick_text(double value) {
  return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

int pixels_wide(const PictureOptions& options) {
  return options.paper ? static_cast<int>(std::lround(options.paper->width_mm / 25.4 * kPaperDpi)) : options.width_px;
}

// Places on the picture, pixels. All lengths of the layout go with the text height.
struct Layout {
  double text = 0;                  // height of the letters
  double x_scale = 0, y_scale = 0;  // pixels per mm
  double left = 0, right = 0;       // of the section
  double top = 0, bottom = 0;       // of the mat as formed
  double platen = 0;                // thickness drawn
  double base_mm = 0;               // y at `bottom`
  double bar_left = 0, bar_width = 0;
  int width = 0, height = 0;
  double x(double mm) const { return left + mm * x_scale; }
  double y(double mm) const { return bottom - (mm - base_mm) * y_scale; }
};

Layout layout_of(const Panel<2>& panel, const PictureOptions& options) {
  Layout l;
  l.width = pixels_wide(options);
  l.text = options.paper ? options.paper->font_pt / 72 * kPaperDpi : std::max(11.0, l.width / 85.0);
  l.left = 4.2 * l.text;
  l.right = l.width - 7.0 * l.text;
  l.bar_left = l.right + 1.4 * l.text;
  l.bar_width = 1.1 * l.text;
  l.platen = 0.8 * l.text;
  l.x_scale = (l.right - l.left) / panel.length_mm;
  l.y_scale = l.x_scale * options.vertical_exaggeration;
  l.base_mm = std::min(0.0, panel.bottom_mm);
  const double height_mm = std::max(panel.initial_thickness_mm, panel.top_mm) - l.base_mm;
  l.top = 2.6 * l.text + l.platen;
  l.bottom = l.top + height_mm * l.y_scale;
  l.height = static_cast<int>(std::ceil(l.bottom + l.platen + 3.8 * l.text));
  return l;
}

cairo_status_t append_bytes(void* to, const unsigned char* data, unsigned size) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

// Where to draw, in pixels, whatever comes of it: a PNG, or lines on paper.
class Canvas {
 public:
  Canvas(int width, int height, const std::optional<Paper>& paper)
      : format_(paper ? paper->format : PaperFormat::kPng),
        surface_(surface(width, height), cairo_surface_destroy),
        cairo_(cairo_create(surface_.get()), cairo_destroy) {
    if (is_vector()) cairo_scale(cairo_.get(), 72 / kPaperDpi, 72 / kPaperDpi);
    cairo_select_font_face(cairo_.get(), paper ? paper->font.c_str() : "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    set({1, 1, 1});
    cairo_paint(cairo_.get());
  }
  bool is_vector() const { return format_ != PaperFormat::kPng; }
  cairo_t* get() { return cairo_.get(); }

  void set(const Colour& c) { cairo_set_source_rgb(cairo_.get(), c.red, c.green, c.blue); }

  void rectangle(double x0, double y0, double x1, double y1) {
    cairo_rectangle(cairo_.get(), x0, y0, x1 - x0, y1 - y0);
    cairo_fill(cairo_.get());
  }

  void line(double x0, double y0, double x1, double y1, double width) {
    cairo_set_line_width(cairo_.get(), width);
    cairo_move_to(cairo_.get(), x0, y0);
    cairo_line_to(cairo_.get(), x1, y1);
    cairo_stroke(cairo_.get());
  }

  // Text placed by a point of its box: across 0 left, 0.5 middle, 1 right; down 0 baseline, 0.5 middle of a capital.
  void text(const std::string& words, double x, double y, double size, double across, double down) {
    cairo_set_font_size(cairo_.get(), size);
    cairo_text_extents_t box;
    cairo_text_extents(cairo_.get(), words.c_str(), &box);
    cairo_move_to(cairo_.get(), x - across * box.x_advance, y + down * 0.72 * size);
    cairo_show_text(cairo_.get(), words.c_str());
  }

  void upright_text(const std::string& words, double x, double y, double size) {
    cairo_save(cairo_.get());
    cairo_translate(cairo_.get(), x, y);
    cairo_rotate(cairo_.get(), -std::numbers::pi / 2);
    text(words, 0, 0, size, 0.5, 0.5);
    cairo_restore(cairo_.get());
  }

  // The picture's file. Nothing can be drawn afterwards.
  std::string finish() {
    if (cairo_status(cairo_.get()) != CAIRO_STATUS_SUCCESS) {
      throw RunError(fmt::format("cannot draw: {}", cairo_status_to_string(cairo_status(cairo_.get()))));
    }
    auto status = CAIRO_STATUS_SUCCESS;
    if (is_vector()) {
      cairo_surface_finish(surface_.get());
      status = cairo_surface_status(surface_.get());
    } else {
      status = cairo_surface_write_to_png_stream(surface_.get(), append_bytes, &bytes_);
    }
    if (status != CAIRO_STATUS_SUCCESS) {
      throw RunError(fmt::format("cannot make a picture: {}", cairo_status_to_string(status)));
    }
    return std::move(bytes_);
  }

 private:
  cairo_surface_t* surface(int width, int height) {
    const double wide = width * 72 / kPaperDpi, high = height * 72 / kPaperDpi;  // points
    if (format_ == PaperFormat::kPng) return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    if (format_ == PaperFormat::kSvg) {
      auto* svg = cairo_svg_surface_create_for_stream(append_bytes, &bytes_, wide, high);
      cairo_svg_surface_set_document_unit(svg, CAIRO_SVG_UNIT_PT);
      return svg;
    }
    auto* pdf = cairo_pdf_surface_create_for_stream(append_bytes, &bytes_, wide, high);
    cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "");  // the same run, the same bytes
    return pdf;
  }

  std::string bytes_;
  PaperFormat format_;
  std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
  std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

Colour colour_of(double value, Colouring colouring, const ColourRange& range) {
  const double t = (value - range.low) / (range.high - range.low);
  return colouring == Colouring::kGrainAngle ? diverging(t) : sequential(t);
}

template <class Order>
void path_through(cairo_t* cairo, const Layout& l, const std::vector<Vec<2>>& corners, const Order& order) {
  for (const std::size_t c : order) cairo_line_to(cairo, l.x(corners[c][0]), l.y(corners[c][1]));
  cairo_close_path(cairo);
}

// Cells without antialiasing, on paper with a hairline of their own colour, so that no seams show between them.
void draw_cells(Canvas& picture, const Layout& l, const Strand<2>& strand, Colouring colouring,
                const ColourRange& range) {
  const auto c = corners(strand);
  cairo_set_antialias(picture.get(), CAIRO_ANTIALIAS_NONE);
  for (std::size_t p = 0; p < strand.size(); ++p) {
    picture.set(colour_of(shown_value(strand, p, colouring), colouring, range));
    path_through(picture.get(), l, c, strand.lattice.cell(p));
    if (picture.is_vector()) {
      cairo_set_line_width(picture.get(), 0.5);
      cairo_fill_preserve(picture.get());
      cairo_stroke(picture.get());
    } else {
      cairo_fill(picture.get());
    }
  }
  cairo_set_antialias(picture.get(), CAIRO_ANTIALIAS_DEFAULT);
}

void draw_outline(Canvas& picture, const Layout& l, const Strand<2>& strand) {
  path_through(picture.get(), l, corners(strand), outline(strand.lattice));
  picture.set({0.1, 0.1, 0.1});
  cairo_set_line_width(picture.get(), std::max(0.6, l.width / 2200.0));
  cairo_stroke(picture.get());
}

// Platens, and between them the colour of voids: one that no wood has.
void draw_press(Canvas& picture, const Layout& l, const Panel<2>& panel, Colouring colouring) {
  if (colouring == Colouring::kGrainAngle) picture.set({0.62, 0.63, 0.64});
  picture.rectangle(l.left, l.y(panel.top_mm), l.right, l.y(panel.bottom_mm));
  picture.set({0.28, 0.30, 0.33});
  picture.rectangle(l.left, l.y(panel.top_mm) - l.platen, l.right, l.y(panel.top_mm));
  picture.rectangle(l.left, l.y(panel.bottom_mm), l.right, l.y(panel.bottom_mm) + l.platen);
}

void draw_axes(Canvas& picture, const Layout& l, const Panel<2>& panel) {
  const double thin = std::max(1.0, l.text / 14), tick = 0.4 * l.text, size = 0.95 * l.text;
  const double foot = l.bottom + l.platen;
  picture.set({0.15, 0.15, 0.15});
  for (const double x : ticks(0, panel.length_mm, 10)) {
    picture.line(l.x(x), foot, l.x(x), foot + tick, thin);
    picture.text(tick_text(x), l.x(x), foot + tick + 0.85 * l.text, size, 0.5, 0.5);
  }
  const double room = (l.bottom - l.top) / (1.8 * l.text);  // numbers that fit one above the other
  const double high = l.base_mm + (l.bottom - l.top) / l.y_scale;
  for (const double y : ticks(l.base_mm, high, std::clamp(static_cast<int>(room), 1, 8))) {
    picture.line(l.left - tick, l.y(y), l.left, l.y(y), thin);
    picture.text(tick_text(y), l.left - 1.5 * tick, l.y(y), size, 1, 0.5);
  }
  picture.text("x, mm", (l.left + l.right) / 2, foot + 2.75 * l.text, size, 0.5, 0.5);
  picture.upright_text("y, mm", 0.95 * l.text, (l.top + l.bottom) / 2, size);
}

void draw_colour_bar(Canvas& picture, const Layout& l, Colouring colouring, const ColourRange& range) {
  const double height = std::max(l.bottom - l.top, 5 * l.text);  // a thin panel still gets a readable bar
  const double middle = (l.top + l.bottom) / 2, top = middle - height / 2, bottom = middle + height / 2;
  const double right = l.bar_left + l.bar_width, thin = std::max(1.0, l.text / 14);
  cairo_set_antialias(picture.get(), CAIRO_ANTIALIAS_NONE);
  const int lines = static_cast<int>(std::ceil(height));
  for (int i = 0; i < lines; ++i) {
    const double y = top + i, share = 1 - i / height;
    picture.set(colour_of(range.low + (range.high - range.low) * share, colouring, range));
    picture.rectangle(l.bar_left, y, right, std::min(y + (picture.is_vector() ? 1.5 : 1), bottom));
  }
  cairo_set_antialias(picture.get(), CAIRO_ANTIALIAS_DEFAULT);
  picture.set({0.15, 0.15, 0.15});
  const int count = std::clamp(static_cast<int>(height / (2.2 * l.text)), 2, 8);
  for (const double value : ticks(range.low, range.high, count)) {
    const double y = bottom - height * (value - range.low) / (range.high - range.low);
    picture.line(right, y, right + 0.35 * l.text, y, thin);
    picture.text(tick_text(value), right + 0.6 * l.text, y, 0.95 * l.text, 0, 0.5);
  }
  const char* name = colouring == Colouring::kGrainAngle ? "grain angle, °" : "density, kg/m³";
  picture.text(name, l.width - 0.5 * l.text, 1.2 * l.text, 0.95 * l.text, 1, 0.5);
}

void check(const PictureOptions& options) {
  if (const int width = pixels_wide(options); width < 400 || width > 20000) {
    throw InputError(fmt::format("picture width is {} pixels, allowed 400..20000", width));
  }
  if (!(options.vertical_exaggeration >= 0.1 && options.vertical_exaggeration <= 20)) {
    throw InputError(fmt::format("vertical exaggeration is {}, allowed 0.1..20", options.vertical_exaggeration));
  }
  if (options.range && !(options.range->high > options.range->low)) {
    throw InputError(fmt::format("colour range {}..{} is empty", options.range->low, options.range->high));
  }
}

}  // namespace

ColourRange common_range(const std::vector<const Panel<2>*>& panels, Colouring colouring) {
  std::vector<double> values;
  for (const auto* panel : panels) {
    for (const auto& strand : panel->strands) {
      for (std::size_t p = 0; p < strand.size(); ++p) values.push_back(shown_value(strand, p, colouring));
    }
  }
  std::sort(values.begin(), values.end());
  const auto at = [&values](double share) {
    return values.empty() ? 0.0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double low = at(kTrimmedEnds), high = at(1 - kTrimmedEnds);
  if (colouring == Colouring::kGrainAngle) {
    constexpr double kSteepest = 30;  // degrees; folds at strand ends would wash out the rest
    const double limit = std::min(kSteepest, std::ceil(std::max({-low, high, 1.0}) - 1e-9));
    return {-limit, limit};
  }
  constexpr double kStep = 50;  // kg/m^3
  const double floor = std::floor(low / kStep + 1e-9) * kStep;
  return {floor, std::max(floor + kStep, std::ceil(high / kStep - 1e-9) * kStep)};
}

void draw_section(const Panel<2>& panel, const PictureOptions& options, const std::filesystem::path& file) {
  check(options);
  const ColourRange range = options.range.value_or(common_range({&panel}, options.colouring));
  const Layout l = layout_of(panel, options);
  Canvas picture(l.width, l.height, options.paper);
  draw_press(picture, l, panel, options.colouring);
  for (const auto& strand : panel.strands) draw_cells(picture, l, strand, options.colouring, range);
  for (const auto& strand : panel.strands) draw_outline(picture, l, strand);
  draw_axes(picture, l, panel);
  draw_colour_bar(picture, l, options.colouring, range);
  picture.set({0.1, 0.1, 0.1});
  const std::string title =
      options.title.empty() ? fmt::format("{:.1f} % compaction", 100 * std::abs(panel.compaction())) : options.title;
  picture.text(title, l.left, 1.2 * l.text, 1.15 * l.text, 0, 0.5);
  files::write_atomically(file, picture.finish());
}

}  // namespace strandlab::report
