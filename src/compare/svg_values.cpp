#include "compare/svg_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace inkgrid {
namespace {

constexpr double kPixelsPerInch = 96;  // CSS

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool begins_number(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  if (text.empty()) return false;
  return is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1]));
}

double pixels_per_unit(std::string_view unit) {
  if (unit == "pt") return kPixelsPerInch / 72;
  if (unit == "pc") return kPixelsPerInch / 6;
  if (unit == "mm") return kPixelsPerInch / 25.4;
  if (unit == "cm") return kPixelsPerInch / 2.54;
  if (unit == "in") return kPixelsPerInch;
  if (unit == "q") return kPixelsPerInch / 101.6;
  return 1;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

Affine rotation(const std::vector<double>& values) {
  const double angle = values[0] * std::numbers::pi / 180;
  const Vec2 turn{std::cos(angle), std::sin(angle)};
  const Vec2 centre = values.size() >= 3 ? Vec2{values[1], values[2]} : Vec2{};
  return {turn, quarter_turn(turn), centre - turn * centre};
}

double slope(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

Affine one_transform(std::string_view name, const std::vector<double>& v) {
  if (name == "matrix" && v.size() == 6) return {{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}};
  if (v.empty()) return {};
  if (name == "translate") return {{1, 0}, {0, 1}, {v[0], v.size() > 1 ? v[1] : 0}};
  if (name == "scale") return {{v[0], 0}, {0, v.size() > 1 ? v[1] : v[0]}, {}};
  if (name == "rotate") return rotation(v);
  if (name == "skewX") return {{1, 0}, {slope(v[0]), 1}, {}};
  if (name == "skewY") return {{1, slope(v[0])}, {0, 1}, {}};
  return {};
}

bool contains(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

// Where the picture lies in the room that is left: 0 at the start, 1 at the end.
double alignment(std::string_view text, std::string_view least, std::string_view most) {
  return contains(text, least) ? 0 : contains(text, most) ? 1 : 0.5;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\f";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) + 1 - first);
}

std::optional<double> take_number(std::string_view& text) {
  if (!begins_number(text)) return std::nullopt;
  const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  const std::string_view digits(begin, static_cast<std::size_t>(end - begin));
  if (error == std::errc::result_out_of_range)
    value = contains(lower(digits), "e-") ? 0 : std::numeric_limits<double>::infinity();
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> values;
  while (!text.empty()) {
    if (const auto value = take_number(text))
      values.push_back(*value);
    else
      text.remove_prefix(1);
  }
  return values;
}

std::optional<double> length_in_pixels(std::string_view text, std::optional<double> whole) {
  text = trimmed(text);
  const auto value = take_number(text);
  if (!value) return std::nullopt;
  text = trimmed(text);
  if (text.starts_with('%')) return whole ? std::optional(*value * *whole / 100) : std::nullopt;
  const auto end = std::find_if_not(text.begin(), text.end(), is_letter);
  return *value * pixels_per_unit(lower({text.begin(), end}));
}

Affine parse_transform(std::string_view text) {
  Affine all;
  for (std::size_t open; (open = text.find('(')) != std::string_view::npos;) {
    const std::size_t close = std::min(text.find(')', open), text.size());
    const std::string_view before = trimmed(text.substr(0, open));
    const auto word = std::find_if_not(before.rbegin(), before.rend(), is_letter).base();
    all = all * one_transform({word, before.end()}, numbers_in(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(std::min(close + 1, text.size()));
  }
  return all;
}

Affine view_box_transform(const std::array<double, 4>& box, Extent page, std::string_view preserve_aspect_ratio) {
  const auto [x, y, width, height] = box;
  Vec2 scale{page.width / width, page.height / height};
  const bool stretched = trimmed(preserve_aspect_ratio).starts_with("none");
  if (!stretched) {
    const bool slice = contains(preserve_aspect_ratio, "slice");
    const double both = slice ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y);
    scale = {both, both};
  }
  const Vec2 room{page.width - scale.x * width, page.height - scale.y * height};
  const double along_x = alignment(preserve_aspect_ratio, "xMin", "xMax");
  const double along_y = alignment(preserve_aspect_ratio, "YMin", "YMax");
  return {{scale.x, 0}, {0, scale.y}, {room.x * along_x - x * scale.x, room.y * along_y - y * scale.y}};
}

}  // namespace inkgrid
