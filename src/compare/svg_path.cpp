#include "compare/svg_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "compare/svg_values.h"

namespace inkgrid {
namespace {

constexpr double kSame = 1e-9;  // user units: points as near as this are one

PathSegment line(Vec2 a, Vec2 b) {
  return {{a, b}, 1};
}

// An arc of an ellipse about `centre`, as angles in the frame where the ellipse is the unit circle.
struct Arc {
  Vec2 centre;
  Vec2 radii;
  Vec2 axis;  // unit vector along radii.x
  double from = 0;
  double to = 0;

  Vec2 point(Vec2 on_circle) const { return centre + axis * Vec2{radii.x * on_circle.x, radii.y * on_circle.y}; }
};

void append_arc(SubPath& path, const Arc& arc, Vec2 start, Vec2 end) {
  const double sweep = arc.to - arc.from;
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / (std::numbers::pi / 2) - 1e-6)));
  const double handle = 4.0 / 3 * std::tan(sweep / count / 4);
  for (int i = 0; i < count; ++i) {
    const double a = arc.from + sweep * i / count, b = arc.from + sweep * (i + 1) / count;
    const Vec2 u{std::cos(a), std::sin(a)}, v{std::cos(b), std::sin(b)};
    const Vec2 first = i == 0 ? start : arc.point(u), last = i + 1 == count ? end : arc.point(v);
    path.push_back({{first, arc.point(u + handle * quarter_turn(u)), arc.point(v - handle * quarter_turn(v)), last}, 3});
  }
}

// SVG 1.1, F.6.5 and F.6.6: from the end points to the centre; radii that are too small grow.
void append_arc(SubPath& path, Vec2 start, Vec2 radii, double degrees, bool large, bool sweep, Vec2 end) {
  if (norm(end - start) < kSame) return;
  radii = {std::abs(radii.x), std::abs(radii.y)};
  if (radii.x < 1e-12 || radii.y < 1e-12) return path.push_back(line(start, end));
  const double angle = degrees * std::numbers::pi / 180;
  const Vec2 axis{std::cos(angle), std::sin(angle)};
  const Vec2 half = conj(axis) * ((start - end) / 2);
  Vec2 unit_half{half.x / radii.x, half.y / radii.y};
  if (const double excess = norm(unit_half); excess > 1) {
    radii = radii * excess;
    unit_half = unit_half / excess;
  }
  const double squared = norm2(unit_half);
  const double offset = (large == sweep ? -1 : 1) * std::sqrt(std::max(0.0, 1 / squared - 1));
  const Vec2 unit_centre = -offset * quarter_turn(unit_half);
  const Vec2 from = unit_half - unit_centre, to = -unit_half - unit_centre;
  Arc arc{{}, radii, axis, std::atan2(from.y, from.x), std::atan2(to.y, to.x)};
  arc.centre = arc.point(unit_centre) + (start + end) / 2;
  if (sweep && arc.to < arc.from) arc.to += 2 * std::numbers::pi;
  if (!sweep && arc.to > arc.from) arc.to -= 2 * std::numbers::pi;
  append_arc(path, arc, start, end);
}

// Reads path data; each function returns false where the data is wrong.
class PathReader {
 public:
  explicit PathReader(std::string_view text) : text_(text) {}

  PathData read() {
    for (skip_space(); !text_.empty() && data_.complete; skip_space()) {
      const char letter = text_.front();
      text_.remove_prefix(1);
      relative_ = letter >= 'a';
      data_.complete = run(relative_ ? static_cast<char>(letter - 'a' + 'A') : letter);
    }
    finish_sub_path();
    return std::move(data_);
  }

 private:
  bool run(char command) {
    if (command == 'Z') return close();
    do {
      if (!step(command)) return false;
      if (command == 'M') command = 'L';  // further pairs are lines
    } while (begins_argument());
    return true;
  }

  bool step(char command) {
    switch (command) {
      case 'M':
        return move();
      case 'L':
        return straight(take_point());
      case 'H':
        return straight(with_x(value()));
      case 'V':
        return straight(with_y(value()));
      case 'C':
        return curve(take_point(), 3);
      case 'S':
        return curve(reflected(3), 3);
      case 'Q':
        return curve(take_point(), 2);
      case 'T':
        return curve(reflected(2), 2);
      case 'A':
        return arc();
      default:
        return false;
    }
  }

  bool move() {
    const auto point = take_point();
    if (!point) return false;
    finish_sub_path();
    start_ = here_ = *point;
    handle_degree_ = 0;
    return true;
  }

  bool close() {
    if (norm(here_ - start_) > kSame) path_.push_back(line(here_, start_));
    finish_sub_path();
    here_ = start_;
    handle_degree_ = 0;
    return true;
  }

  bool straight(std::optional<Vec2> end) {
    if (!end) return false;
    path_.push_back(line(here_, *end));
    here_ = *end;
    handle_degree_ = 0;
    return true;
  }

  bool curve(std::optional<Vec2> control, int degree) {
    const auto second = degree == 3 ? take_point() : control;
    const auto end = take_point();
    if (!control || !second || !end) return false;
    path_.push_back(degree == 3 ? PathSegment{{here_, *control, *second, *end}, 3} : PathSegment{{here_, *control, *end}, 2});
    here_ = *end;
    handle_ = *second;
    handle_degree_ = degree;
    return true;
  }

  bool arc() {
    const auto rx = value(), ry = value(), degrees = value();
    const auto large = take_flag(), sweep = take_flag();
    const auto end = take_point();
    if (!rx || !ry || !degrees || !large || !sweep || !end) return false;
    append_arc(path_, here_, {*rx, *ry}, *degrees, *large, *sweep, *end);
    here_ = *end;
    handle_degree_ = 0;
    return true;
  }

  // The mirror image of the last control point, where that belongs to a curve of the same kind.
  Vec2 reflected(int degree) const { return handle_degree_ == degree ? 2 * here_ - handle_ : here_; }

  void skip_space() {
    while (!text_.empty() && std::string_view(" \t\r\n\f,").find(text_.front()) != std::string_view::npos) text_.remove_prefix(1);
  }

  bool begins_argument() {
    skip_space();
    return !text_.empty() && std::string_view("+-.0123456789").find(text_.front()) != std::string_view::npos;
  }

  std::optional<double> value() {
    skip_space();
    return take_number(text_);
  }

  // Flags may stand without a space: "a1 1 0 01.5.5".
  std::optional<bool> take_flag() {
    skip_space();
    if (text_.empty() || (text_.front() != '0' && text_.front() != '1')) return std::nullopt;
    const bool flag = text_.front() == '1';
    text_.remove_prefix(1);
    return flag;
  }

  std::optional<Vec2> take_point() {
    const auto x = value(), y = value();
    if (!x || !y) return std::nullopt;
    return Vec2{*x, *y} + (relative_ ? here_ : Vec2{});
  }

  std::optional<Vec2> with_x(std::optional<double> x) const {
    if (!x) return std::nullopt;
    return Vec2{*x + (relative_ ? here_.x : 0), here_.y};
  }

  std::optional<Vec2> with_y(std::optional<double> y) const {
    if (!y) return std::nullopt;
    return Vec2{here_.x, *y + (relative_ ? here_.y : 0)};
  }

  void finish_sub_path() {
    if (!path_.empty()) data_.sub_paths.push_back(std::move(path_));
    path_.clear();
  }

  std::string_view text_;
  bool relative_ = false;
  PathData data_;
  SubPath path_;
  Vec2 start_, here_;
  Vec2 handle_;            // last control point of the curve before
  int handle_degree_ = 0;  // of that curve; 0: it was none
};

}  // namespace

PathData parse_path(std::string_view text) {
  return PathReader(text).read();
}

std::vector<SubPath> line_path(Vec2 a, Vec2 b) {
  return {{line(a, b)}};
}

std::vector<SubPath> polyline_path(const std::vector<double>& coordinates, bool closed) {
  SubPath path;
  Vec2 first, last;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
    const Vec2 point{coordinates[i], coordinates[i + 1]};
    if (i == 0)
      first = point;
    else
      path.push_back(line(last, point));
    last = point;
  }
  if (path.empty()) return {};
  if (closed && norm(first - last) > kSame) path.push_back(line(last, first));
  return {path};
}

std::vector<SubPath> ellipse_path(Vec2 centre, Vec2 radii) {
  if (!(radii.x > 0 && radii.y > 0)) return {};
  SubPath path;
  const Vec2 start = centre + Vec2{radii.x, 0};
  append_arc(path, {centre, radii, {1, 0}, 0, 2 * std::numbers::pi}, start, start);
  return {path};
}

std::vector<SubPath> rectangle_path(Vec2 corner, Vec2 size, Vec2 radii) {
  if (!(size.x > 0 && size.y > 0)) return {};
  const double rx = std::clamp(radii.x, 0.0, size.x / 2), ry = std::clamp(radii.y, 0.0, size.y / 2);
  const Vec2 end = corner + size;
  if (!(rx > 0 && ry > 0)) return polyline_path({corner.x, corner.y, end.x, corner.y, end.x, end.y, corner.x, end.y}, true);
  SubPath path;
  Vec2 here{corner.x + rx, corner.y};
  const auto straight_to = [&](Vec2 point) {
    if (norm(point - here) > kSame) path.push_back(line(here, point));
    here = point;
  };
  const auto round_to = [&](Vec2 point) {
    append_arc(path, here, {rx, ry}, 0, false, true, point);
    here = point;
  };
  straight_to({end.x - rx, corner.y});
  round_to({end.x, corner.y + ry});
  straight_to({end.x, end.y - ry});
  round_to({end.x - rx, end.y});
  straight_to({corner.x + rx, end.y});
  round_to({corner.x, end.y - ry});
  straight_to({corner.x, corner.y + ry});
  round_to({corner.x + rx, corner.y});
  return {path};
}

}  // namespace inkgrid
