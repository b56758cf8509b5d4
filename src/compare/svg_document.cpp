#include "compare/svg_document.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "base/at.h"
#include "base/decimal.h"
#include "compare/svg_style.h"
#include "compare/xml.h"
#include "inkgrid/inkgrid.h"

namespace inkgrid {
namespace {

constexpr std::string_view kNotDrawn[] = {"defs",   "clipPath", "mask",           "marker",         "pattern",      "symbol",
                                          "text",   "image",    "title",          "desc",           "metadata",     "style",
                                          "script", "filter",   "linearGradient", "radialGradient", "foreignObject"};
constexpr int kDeepest = 60;             // levels of groups and uses
constexpr long kMostElements = 5000000;  // uses of uses can ask for any number
constexpr double kSameSize = 0.02;       // pages that differ less are the same
constexpr double kPageShape = 0.98;      // of the page's sides: a filled shape this large is the paper
constexpr std::size_t kPageSegments = 8;
constexpr double kFarthest = 1e9;  // px: a segment with a point further away, or no number, does not count

using ViewBox = std::optional<std::array<double, 4>>;

std::string_view attribute(const XmlElement& element, std::string_view name) {
  const std::string* value = element.find(name);
  return value == nullptr ? std::string_view{} : *value;
}

ViewBox view_box(const XmlElement& element) {
  const auto v = numbers_in(attribute(element, "viewBox"));
  if (v.size() != 4 || !(v[2] > 0 && v[3] > 0)) return std::nullopt;
  return std::array{v[0], v[1], v[2], v[3]};
}

std::optional<double> positive_length(std::string_view text) {
  const auto value = length_in_pixels(text);
  return value && *value > 0 ? value : std::nullopt;
}

bool is_in_pixels(std::string_view length) {
  length = trimmed(length);
  return take_number(length) && (trimmed(length).empty() || trimmed(length) == "px");
}

// Width or height of the file's own page; 0 where it has none.
double own_side(const XmlElement& root, const char* name, const ViewBox& box, std::size_t index) {
  const std::string_view text = attribute(root, name);
  const auto side = positive_length(text);
  if (side && (is_in_pixels(text) || !box)) return *side;
  return box ? (*box)[index] : 0;
}

bool same_size(Extent a, Extent b) {
  return std::abs(a.width - b.width) < kSameSize * b.width && std::abs(a.height - b.height) < kSameSize * b.height;
}

std::string size_text(Extent size) {
  return decimal(size.width, 2) + " x " + decimal(size.height, 2) + " px";
}

// How the coordinates of the file become pixels of the page, and what should be said of it.
Affine page_transform(const XmlElement& root, Extent page, std::vector<std::string>& notes) {
  const ViewBox box = view_box(root);
  const auto width = positive_length(attribute(root, "width")), height = positive_length(attribute(root, "height"));
  const std::optional<Extent> own = width && height ? std::optional(Extent{*width, *height}) : std::nullopt;
  const bool same = own && same_size(*own, page);
  if (own && !same && box) notes.push_back("a page of " + size_text(*own) + " was fitted to " + size_text(page));
  if (box) return view_box_transform(*box, same ? *own : page, attribute(root, "preserveAspectRatio"));
  if (!own || same) return {};
  const double ratio = own->width / own->height, page_ratio = page.width / page.height;
  if (std::abs(ratio - page_ratio) >= kSameSize * page_ratio) {
    notes.push_back("a page of another shape, without a viewBox, was not scaled");
    return {};
  }
  notes.push_back("a page of " + size_text(*own) + ", without a viewBox, was scaled to " + size_text(page));
  return {{page.width / own->width, 0}, {0, page.height / own->height}, {}};
}

// One element with its geometry, in its own coordinates.
struct Shape {
  std::vector<SubPath> sub_paths;
  Affine transform;
  SvgStyle style;
  bool overdrawn = false;

  bool is_stroked() const { return is_paint(style.stroke) && stroke_width() > 0; }
  bool is_filled() const { return is_paint(style.fill); }
  double stroke_width() const { return length_in_pixels(style.stroke_width).value_or(1); }
};

class Reader {
 public:
  explicit Reader(const XmlElement& root, const std::string& name) : root_(root), name_(name) { collect(root); }

  std::vector<Shape> shapes(Extent page, const Affine& transform) {
    const ViewBox box = view_box(root_);
    whole_ = box ? Extent{(*box)[2], (*box)[3]} : page;
    walk(root_, transform, {}, 0);
    return std::move(shapes_);
  }
  bool is_complete() const { return complete_; }

 private:
  // Names and style rules, wherever they stand.
  void collect(const XmlElement& element) {
    if (const std::string* id = element.find("id")) ids_.emplace(*id, &element);
    if (element.tag == "style") {
      auto rules = parse_css(element.text);
      std::move(rules.begin(), rules.end(), std::back_inserter(rules_));
    }
    for (const XmlElement& child : element.children) collect(child);
  }

  void walk(const XmlElement& element, Affine transform, const SvgStyle& inherited, int depth) {
    if (std::find(std::begin(kNotDrawn), std::end(kNotDrawn), element.tag) != std::end(kNotDrawn)) return;
    if (++visited_ > kMostElements) throw Error(ErrorCode::file, "'" + name_ + "' draws too many elements");
    if (depth > kDeepest) return;
    const SvgStyle style = style_of(element, inherited, rules_);
    if (style.display == "none") return;
    if (&element != &root_) transform = transform * parse_transform(attribute(element, "transform"));
    if (element.tag == "use") return use(element, transform, style, depth);
    if (element.tag == "svg" && &element != &root_) transform = transform * nested_page(element);
    add(element, transform, style);
    for (const XmlElement& child : element.children) walk(child, transform, style, depth + 1);
  }

  void use(const XmlElement& element, const Affine& transform, const SvgStyle& style, int depth) {
    const XmlElement* target = target_of(element);
    if (target == nullptr) return;
    const Affine placed = transform * shift_of(element);
    if (target->tag != "symbol") return walk(*target, placed, style, depth + 1);
    const SvgStyle inner = style_of(*target, style, rules_);
    for (const XmlElement& child : target->children) walk(child, placed, inner, depth + 1);
  }

  const XmlElement* target_of(const XmlElement& use) const {
    const std::string_view plain = attribute(use, "href"), link = plain.empty() ? attribute(use, "xlink:href") : plain;
    const auto found = link.starts_with('#') ? ids_.find(link.substr(1)) : ids_.end();
    return found == ids_.end() ? nullptr : found->second;
  }

  Affine shift_of(const XmlElement& element) const {
    return {{1, 0}, {0, 1}, {side(element, "x", std::nullopt), side(element, "y", std::nullopt)}};
  }

  Affine nested_page(const XmlElement& element) const {
    const ViewBox box = view_box(element);
    const Extent page{side(element, "width", whole_.width), side(element, "height", whole_.height)};
    const Affine shift = shift_of(element);
    if (!box || !(page.width > 0 && page.height > 0)) return shift;
    return shift * view_box_transform(*box, page, attribute(element, "preserveAspectRatio"));
  }

  // A length among the attributes; 0 where it is missing.
  double side(const XmlElement& element, std::string_view name, std::optional<double> whole) const {
    return length_in_pixels(attribute(element, name), whole).value_or(0);
  }
  double along_x(const XmlElement& element, std::string_view name) const { return side(element, name, whole_.width); }
  double along_y(const XmlElement& element, std::string_view name) const { return side(element, name, whole_.height); }

  void add(const XmlElement& element, const Affine& transform, const SvgStyle& style) {
    auto sub_paths = geometry(element);
    if (sub_paths.empty() || style.visibility == "hidden" || style.visibility == "collapse") return;
    const auto strokes = numbers_in(attribute(element, "data-strokes"));
    shapes_.push_back({std::move(sub_paths), transform, style, !strokes.empty() && strokes[0] > 1});
  }

  std::vector<SubPath> geometry(const XmlElement& e) {
    if (e.tag == "path") {
      PathData data = parse_path(attribute(e, "d"));
      complete_ = complete_ && data.complete;
      return std::move(data.sub_paths);
    }
    if (e.tag == "line") return line_path({along_x(e, "x1"), along_y(e, "y1")}, {along_x(e, "x2"), along_y(e, "y2")});
    if (e.tag == "polyline" || e.tag == "polygon") return polyline_path(numbers_in(attribute(e, "points")), e.tag == "polygon");
    const Vec2 centre{along_x(e, "cx"), along_y(e, "cy")};
    if (e.tag == "circle") return ellipse_path(centre, {along_x(e, "r"), along_x(e, "r")});
    if (e.tag == "ellipse") return ellipse_path(centre, {along_x(e, "rx"), along_y(e, "ry")});
    if (e.tag == "rect") return rectangle(e);
    return {};
  }

  // One radius of the corners stands for both.
  std::vector<SubPath> rectangle(const XmlElement& e) const {
    const auto rx = length_in_pixels(attribute(e, "rx"), whole_.width), ry = length_in_pixels(attribute(e, "ry"), whole_.height);
    return rectangle_path({along_x(e, "x"), along_y(e, "y")}, {along_x(e, "width"), along_y(e, "height")},
                          {rx.value_or(ry.value_or(0)), ry.value_or(rx.value_or(0))});
  }

  const XmlElement& root_;
  const std::string& name_;
  std::map<std::string, const XmlElement*, std::less<>> ids_;
  std::vector<CssRule> rules_;
  Extent whole_;  // what percentages are of
  std::vector<Shape> shapes_;
  long visited_ = 0;
  bool complete_ = true;
};

bool is_within_reach(const PathSegment& segment) {
  return std::all_of(segment.points.begin(), segment.points.end(),
                     [](Vec2 p) { return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest; });
}

SubPath transformed(const SubPath& path, const Affine& transform) {
  SubPath result;
  for (PathSegment segment : path) {
    for (Vec2& point : segment.points) point = transform(point);
    if (is_within_reach(segment)) result.push_back(segment);
  }
  return result;
}

// The box of all control points.
Extent extent_of(const std::vector<SubPath>& paths) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 least{kFar, kFar}, most{-kFar, -kFar};
  for (const SubPath& path : paths)
    for (const PathSegment& segment : path)
      for (int i = 0; i <= segment.degree; ++i) {
        const Vec2 p = segment.points[at(i)];
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
      }
  return {most.x - least.x, most.y - least.y};
}

bool is_paper(const std::vector<SubPath>& paths, Extent page) {
  std::size_t segments = 0;
  for (const SubPath& path : paths) segments += path.size();
  const Extent size = extent_of(paths);
  return segments <= kPageSegments && size.width > kPageShape * page.width && size.height > kPageShape * page.height;
}

// What is not painted does not count, unless nothing is.
void keep_painted(std::vector<Shape>& shapes, std::vector<std::string>& notes) {
  const auto is_unpainted = [](const Shape& shape) { return !shape.is_stroked() && !shape.is_filled(); };
  if (shapes.empty()) return;
  if (std::all_of(shapes.begin(), shapes.end(), is_unpainted))
    notes.push_back("nothing is painted, so all curves count");
  else
    std::erase_if(shapes, is_unpainted);
}

void append_curves(SvgDocument& document, const Shape& shape) {
  std::vector<SubPath> paths;
  for (const SubPath& path : shape.sub_paths) paths.push_back(transformed(path, shape.transform));
  std::erase_if(paths, [](const SubPath& path) { return path.empty(); });
  if (!shape.is_stroked() && is_paper(paths, document.page)) {
    document.notes.push_back("a filled shape of the page's size does not count");
    return;
  }
  ++document.elements;
  const double scale = std::sqrt(std::abs(cross(shape.transform.x, shape.transform.y)));
  const double width = shape.stroke_width() * (scale > 0 ? scale : 1);
  for (SubPath& path : paths) document.curves.push_back({std::move(path), width, !shape.is_stroked(), shape.overdrawn});
}

}  // namespace

SvgDocument read_svg(const SvgText& svg, const std::optional<Extent>& page) {
  const XmlElement root = parse_xml(svg.text, svg.name);
  if (root.tag != "svg") throw Error(ErrorCode::file, "'" + svg.name + "' is no SVG file: its element is <" + root.tag + ">");
  SvgDocument document;
  const ViewBox box = view_box(root);
  document.page = page.value_or(Extent{own_side(root, "width", box, 2), own_side(root, "height", box, 3)});
  if (!(document.page.width > 0 && document.page.height > 0))
    throw Error(ErrorCode::file, "'" + svg.name + "' says nothing of its size: neither a viewBox nor a width and a height");
  document.pen = positive_length(attribute(root, "data-pen"));
  document.set = attribute(root, "data-set");
  Reader reader(root, svg.name);
  auto shapes = reader.shapes(document.page, page_transform(root, document.page, document.notes));
  keep_painted(shapes, document.notes);
  for (const Shape& shape : shapes) append_curves(document, shape);
  if (!reader.is_complete()) document.notes.push_back("path data with an error counts up to it");
  return document;
}

}  // namespace inkgrid
