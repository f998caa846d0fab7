/// Pictures of maps in world coordinates, drawn by cairo.
#pragma once

#include <cairo.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/geometry/box.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/io/atomic_file.hpp"

namespace examples {

/// Red, green, blue and opacity, each 0..1.
struct Color {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

inline constexpr Color transparent{0.0, 0.0, 0.0, 0.0};

/// What stands before a label of the legend.
enum class Swatch { area, line, dot };

struct LegendEntry {
  std::string label;
  Color color;
  Swatch swatch = Swatch::line;
};

/// A picture of a part of the world (metres, x right, y up) above a strip for the scale bar and the legend.
/// What is drawn later covers what was drawn before. Lengths in _px are pixels of the picture.
class Drawing {
 public:
  using Point = Eigen::Vector2d;

  /// The map of `world_m` with its longer side `side_px` long, in a picture at least `width_min_px` wide, so that the legend has
  /// room. Throws std::invalid_argument for an empty world.
  explicit Drawing(const incognita::Box<Point>& world_m, int side_px = 1600, double width_min_px = 1400.0) : world_m_(world_m) {
    if (world_m.empty()) incognita::throw_invalid("Drawing", "the world", incognita::box_text(world_m), "a box with an area");
    px_per_m_ = side_px / world_m.extent().maxCoeff();
    const Point map_px = (world_m.extent() * px_per_m_).array().ceil();
    width_px_ = std::max(map_px.x() + 2.0 * margin_px, width_min_px);
    height_px_ = map_px.y() + margin_px + strip_px;
    left_px_ = std::floor(0.5 * (width_px_ - map_px.x()));
    surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width_px_),
                                              static_cast<int>(height_px_)));
    cairo_.reset(cairo_create(surface_.get()));
    set(Color{1.0, 1.0, 1.0});
    cairo_paint(cairo_.get());
    cairo_rectangle(cairo_.get(), left_px_, margin_px, map_px.x(), map_px.y());
    cairo_clip(cairo_.get());
    cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_select_font_face(cairo_.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }

  /// The cells of a grid, each in color_of(value), placed by T_world_grid: the grid's lattice lies in its own
  /// frame.
  template <class Value, class ColorOf>
  void raster(const incognita::Grid<Value, 2>& grid, const incognita::Pose2& T_world_grid,
              ColorOf&& color_of) {
    if (grid.box().empty()) return;
    const auto extent = grid.box().extent();
    const Surface cells(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, extent.x(), extent.y()));
    if (cairo_surface_status(cells.get()) != CAIRO_STATUS_SUCCESS) fail(cairo_surface_status(cells.get()));
    unsigned char* bytes = cairo_image_surface_get_data(cells.get());
    const int row_bytes = cairo_image_surface_get_stride(cells.get());
    incognita::Offset offset = 0;
    for (int row = 0; row < extent.y(); ++row) {
      auto* pixels = reinterpret_cast<std::uint32_t*>(bytes + std::ptrdiff_t{row} * row_bytes);
      for (int column = 0; column < extent.x(); ++column)
        pixels[column] = premultiplied(color_of(grid[offset++]));
    }
    cairo_surface_mark_dirty(cells.get());

    // From cells to the grid's frame, to the world, to the picture (whose y points down).
    const Point lower_m =
        grid.lattice().origin_m() + grid.box().lower.template cast<double>() * grid.resolution_m();
    const Point place_px = to_px(T_world_grid * lower_m);
    cairo_save(cairo_.get());
    cairo_translate(cairo_.get(), place_px.x(), place_px.y());
    cairo_scale(cairo_.get(), px_per_m_, -px_per_m_);
    cairo_rotate(cairo_.get(), T_world_grid.yaw_rad);
    cairo_scale(cairo_.get(), grid.resolution_m(), grid.resolution_m());
    cairo_set_source_surface(cairo_.get(), cells.get(), 0.0, 0.0);
    const bool magnified = grid.resolution_m() * px_per_m_ >= 1.0;
    cairo_pattern_set_filter(cairo_get_source(cairo_.get()),
                             magnified ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_paint(cairo_.get());
    cairo_restore(cairo_.get());
  }

  /// A line through points of the world.
  void polyline(const std::vector<Point>& points_m, const Color& color, double width_px = 2.0) {
    for (const Point& point_m : points_m) line_to(to_px(point_m));
    stroke(color, width_px);
  }

  /// A filled disc; `radius_m` in the world.
  void disc(const Point& center_m, double radius_m, const Color& color) {
    circle(to_px(center_m), radius_m * px_per_m_);
    set(color);
    cairo_fill(cairo_.get());
  }

  /// The outline of the ellipse that lies `sigmas` standard deviations around a mean.
  void ellipse(const Point& mean_m, const Eigen::Matrix2d& covariance_m2, double sigmas, const Color& color,
               double width_px = 1.5) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_m2);
    const Eigen::Matrix2d root =
        axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
      const double angle_rad = 2.0 * 3.14159265358979 * i / steps;
      line_to(to_px(mean_m + sigmas * root * Point(std::cos(angle_rad), std::sin(angle_rad))));
    }
    cairo_close_path(cairo_.get());
    stroke(color, width_px);
  }

  /// A dot with a white rim, as large whatever the scale.
  void marker(const Point& center_m, const Color& color, double radius_px = 7.0) {
    dot(to_px(center_m), color, radius_px);
  }

  /// A label whose lower left corner lies `offset_px` (x right, y up) from a point of the world, on a white
  /// ground.
  void text(const Point& at_m, const std::string& label, const Color& color, double size_px = 18.0,
            const Point& offset_px = {10.0, 8.0}) {
    text_px(to_px(at_m) + Point(offset_px.x(), -offset_px.y()), label, color, size_px, true);
  }

  /// The strip under the map: a bar of a round length, then what the colours mean. Comes last.
  void legend(const std::vector<LegendEntry>& entries) {
    constexpr Color ink{0.15, 0.15, 0.15};
    cairo_reset_clip(cairo_.get());
    const double length_m = round_length_m(0.15 * width_px_ / px_per_m_);
    const double y = height_px_ - 0.5 * strip_px;
    double x = margin_px;
    for (const Point& corner : {Point(x, y - 6.0), Point(x, y), Point(x + length_m * px_per_m_, y),
                                Point(x + length_m * px_per_m_, y - 6.0)}) {
      line_to(corner);
    }
    stroke(ink, 2.0);
    x += length_m * px_per_m_ + 8.0;
    std::string label = std::to_string(length_m);
    label.erase(label.find_last_not_of('0') + 1);
    if (label.back() == '.') label.pop_back();
    x += text_px({x, y + 5.0}, label + " m", ink, legend_font_px, false) + 36.0;
    for (const LegendEntry& entry : entries) {
      if (entry.swatch == Swatch::dot) {
        dot({x + 12.0, y}, entry.color, 6.0);
      } else if (entry.swatch == Swatch::line) {
        line_to({x, y});
        line_to({x + 24.0, y});
        stroke(entry.color, 3.0);
      } else {
        cairo_rectangle(cairo_.get(), x, y - 8.0, 24.0, 16.0);
        set(entry.color);
        cairo_fill_preserve(cairo_.get());
        stroke(ink, 0.5);
      }
      x += 32.0;
      x += text_px({x, y + 5.0}, entry.label, ink, legend_font_px, false) + 28.0;
    }
  }

  /// Writes the picture as PNG, which replaces an older file only when complete. Throws incognita::InputError
  /// when it cannot be written and std::runtime_error when cairo has failed.
  void write_png(const std::filesystem::path& file) const {
    if (cairo_status(cairo_.get()) != CAIRO_STATUS_SUCCESS) fail(cairo_status(cairo_.get()));
    std::string content;
    const auto append = [](void* to, const unsigned char* data, unsigned int size) {
      static_cast<std::string*>(to)->append(data, data + size);
      return CAIRO_STATUS_SUCCESS;
    };
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface_.get(), append, &content);
    if (status != CAIRO_STATUS_SUCCESS) fail(status);
    incognita::write_file_atomically(file, content);
  }

 private:
  struct Release {
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };
  using Surface = std::unique_ptr<cairo_surface_t, Release>;

  [[noreturn]] static void fail(cairo_status_t status) {
    throw std::runtime_error(std::string("Drawing: ") + cairo_status_to_string(status));
  }

  [[nodiscard]] static std::uint32_t premultiplied(const Color& color) {
    const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255.0 * value)); };
    return byte(color.alpha) << 24U | byte(color.red * color.alpha) << 16U |
           byte(color.green * color.alpha) << 8U | byte(color.blue * color.alpha);
  }

  /// The largest of 1, 2 and 5 times a power of ten that is at most `length_m`.
  [[nodiscard]] static double round_length_m(double length_m) {
    const double power = std::pow(10.0, std::floor(std::log10(length_m)));
    return (length_m >= 5.0 * power ? 5.0 : length_m >= 2.0 * power ? 2.0 : 1.0) * power;
  }

  [[nodiscard]] Point to_px(const Point& point_m) const {
    return {left_px_ + (point_m.x() - world_m_.lower.x()) * px_per_m_,
            margin_px + (world_m_.upper.y() - point_m.y()) * px_per_m_};
  }

  void set(const Color& color) {
    cairo_set_source_rgba(cairo_.get(), color.red, color.green, color.blue, color.alpha);
  }

  void line_to(const Point& px) { cairo_line_to(cairo_.get(), px.x(), px.y()); }

  void stroke(const Color& color, double width_px) {
    set(color);
    cairo_set_line_width(cairo_.get(), width_px);
    cairo_stroke(cairo_.get());
  }

  void circle(const Point& center_px, double radius_px) {
    cairo_new_sub_path(cairo_.get());
    cairo_arc(cairo_.get(), center_px.x(), center_px.y(), radius_px, 0.0, 2.0 * 3.14159265358979);
  }

  void dot(const Point& center_px, const Color& color, double radius_px) {
    circle(center_px, radius_px);
    set(color);
    cairo_fill_preserve(cairo_.get());
    stroke(Color{1.0, 1.0, 1.0}, 0.25 * radius_px);
  }

  /// Draws a label and returns its width in pixels.
  double text_px(const Point& at_px, const std::string& label, const Color& color, double size_px,
                 bool ground) {
    cairo_set_font_size(cairo_.get(), size_px);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_.get(), label.c_str(), &extents);
    if (ground) {
      cairo_rectangle(cairo_.get(), at_px.x() - 4.0, at_px.y() + extents.y_bearing - 4.0, extents.width + 8.0,
                      extents.height + 8.0);
      set(Color{1.0, 1.0, 1.0, 0.8});
      cairo_fill(cairo_.get());
    }
    cairo_move_to(cairo_.get(), at_px.x(), at_px.y());
    set(color);
    cairo_show_text(cairo_.get(), label.c_str());
    cairo_new_path(cairo_.get());
    return extents.x_advance;
  }

  static constexpr double margin_px = 24.0;
  static constexpr double strip_px = 48.0;
  static constexpr double legend_font_px = 16.0;

  incognita::Box<Point> world_m_;
  double px_per_m_ = 1.0;
  double width_px_ = 0.0;
  double height_px_ = 0.0;
  double left_px_ = 0.0;  // of the map, which stands in the middle
  Surface surface_;
  std::unique_ptr<cairo_t, Release> cairo_;
};

}  // namespace examples
