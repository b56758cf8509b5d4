#include "export/svg.h"

#include <array>
#include <charconv>
#include <cmath>

#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

// At most three decimals, without trailing zeros, in the C locale.
std::string decimal(double value) {
  if (!(std::abs(value) < 1e9)) throw Error(ErrorCode::numerics, "a curve has a coordinate that is no number");
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 3).ptr;
  std::string text(buffer.data(), end);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(Vec2 p) {
  return decimal(p.x) + ',' + decimal(p.y);
}

std::string path_data(const Curve& curve) {
  std::string data = "M" + point(curve.segments.front().p0);
  for (const Cubic& c : curve.segments) data += " C" + point(c.p1) + ' ' + point(c.p2) + ' ' + point(c.p3);
  if (curve.closed) data += " z";
  return data;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
      result += c;
  }
  return result;
}

std::string opening_tag(const Drawing& drawing) {
  const bool scaled = drawing.pixels_per_mm > 0;
  const double unit = scaled ? drawing.pixels_per_mm : 1;
  const std::string suffix = scaled ? "mm\"" : "\"";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + decimal(drawing.width) + ' ' + decimal(drawing.height) +
         "\" width=\"" + decimal(drawing.width / unit) + suffix + " height=\"" + decimal(drawing.height / unit) + suffix + ">\n";
}

}  // namespace

std::string svg_text(const Drawing& drawing, const std::string& description) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + opening_tag(drawing);
  text += "<metadata>" + escaped(description) + "</metadata>\n";
  text += "<g fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  int number = 0;
  for (const Curve& curve : drawing.curves) {
    text += "<path id=\"curve-" + std::to_string(++number) + '"';
    if (curve.width > 0) text += " stroke-width=\"" + decimal(curve.width) + '"';
    text += " d=\"" + path_data(curve) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace inkgrid
