#include "export/svg.h"

#include <cmath>

#include "base/decimal.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

std::string number(double value) {
  if (!(std::abs(value) < 1e9)) throw Error(ErrorCode::numerics, "a curve has a coordinate that is no number");
  return decimal(value, 3);
}

std::string point(Vec2 p) {
  return number(p.x) + ',' + number(p.y);
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
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(drawing.width) + ' ' + number(drawing.height) +
         "\" width=\"" + number(drawing.width / unit) + suffix + " height=\"" + number(drawing.height / unit) + suffix + ">\n";
}

}  // namespace

std::string svg_text(const Drawing& drawing, const std::string& description) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + opening_tag(drawing);
  text += "<metadata>" + escaped(description) + "</metadata>\n";
  text += "<g fill=\"none\" stroke=\"black\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  int count = 0;
  for (const Curve& curve : drawing.curves) {
    text += "<path id=\"curve-" + std::to_string(++count) + '"';
    if (curve.width > 0) text += " stroke-width=\"" + number(curve.width) + '"';
    text += " d=\"" + path_data(curve) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

}  // namespace inkgrid
