#include "strandlab/report/layer_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "strandlab/core/markup.hpp"
#include "strandlab/report/colour_map.hpp"

namespace strandlab::report {
namespace {

constexpr double kPixels = 800;  // of the window's longer side
constexpr double kMargin = 60;   // around it, for axes and title

std::string hex(const Colour& c) {
  const auto byte = [](double value) { return static_cast<int>(std::lround(255 * value)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue));
}

// The strand and those of its images that may reach into the window.
std::string strand_markup(const mat::Rectangle& r, const mat::Window& window, double off_deg, double angle_deg) {
  const double t = 0.5 + 0.5 * off_deg / kWidestAngle_deg;
  const double reach = std::hypot(r.half_length, r.half_width);
  const auto first = [&](double centre, double side) {
    return window.periodic ? std::ceil((-reach - centre) / side) : 0;
  };
  const auto last = [&](double centre, double side) {
    return window.periodic ? std::floor((side + reach - centre) / side) : 0;
  };
  std::string markup;
  for (double j = first(r.cy, window.y); j <= last(r.cy, window.y); ++j) {
    for (double i = first(r.cx, window.x); i <= last(r.cx, window.x); ++i) {
      markup += fmt::format(
          "<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" fill=\"{}\" "
          "transform=\"translate({:.3f} {:.3f}) rotate({:.3f})\"/>\n",
          -r.half_length, -r.half_width, 2 * r.half_length, 2 * r.half_width, hex(diverging(t)), r.cx + i * window.x,
          r.cy + j * window.y, angle_deg);
    }
  }
  return markup;
}

}  // namespace

std::string layer_picture(const mat::PlateMat& mat, std::size_t layer, const std::vector<mat::RoleAngle>& roles) {
  const auto& role = mat.layers[layer].role;
  const double scale = kPixels / std::max(mat.length_mm, mat.width_mm);
  const double width = mat.length_mm * scale, height = mat.width_mm * scale;
  const double kind_angle = mat::angle_deg({}, role, roles);
  double area = 0;
  std::string strands;
  for (const auto& strand : mat.layers[layer].strands) {
    const double angle = mat::angle_deg(strand, role, roles);
    strands +=
        strand_markup(mat::outline(strand, angle), mat.window(), std::remainder(angle - kind_angle, 180.0), angle);
    area += strand.length_mm * strand.width_mm;
  }
  const auto label = [](double x, double y, const char* anchor, const std::string& words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
  };
  auto svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"16\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width + 2 * kMargin, height + 2 * kMargin);
  svg += fmt::format("<clipPath id=\"window\"><rect width=\"{}\" height=\"{}\"/></clipPath>\n", mat.length_mm,
                     mat.width_mm);
  svg += fmt::format(
      "<g transform=\"translate({:.3f} {:.3f}) scale({:.6f} -{:.6f})\">\n<g clip-path=\"url(#window)\" "
      "stroke=\"#222\" stroke-width=\"{:.4f}\">\n{}</g>\n<rect width=\"{}\" height=\"{}\" fill=\"none\" "
      "stroke=\"black\" stroke-width=\"{:.4f}\"/>\n</g>\n",
      kMargin, kMargin + height, scale, scale, 1 / scale, strands, mat.length_mm, mat.width_mm, 1.5 / scale);
  svg += label(
      kMargin, kMargin - 20, "start",
      fmt::format("layer {}, {}: {} strands, {:.0f} % of the window; colour: angle from {:g}°, blue -{}° to red {}°",
                  layer + 1, escaped_markup(role), mat.layers[layer].strands.size(),
                  100 * area / (mat.length_mm * mat.width_mm), kind_angle, kWidestAngle_deg, kWidestAngle_deg));
  svg += label(kMargin, kMargin + height + 22, "middle", "0");
  svg += label(kMargin + width, kMargin + height + 22, "middle", fmt::format("{:g}", mat.length_mm));
  svg += label(kMargin + width / 2, kMargin + height + 40, "middle", "x, mm");
  svg += label(kMargin - 8, kMargin + 6, "end", fmt::format("{:g}", mat.width_mm));
  svg += label(kMargin - 8, kMargin + height / 2, "end", "y, mm");
  return svg + "</svg>\n";
}

}  // namespace strandlab::report
