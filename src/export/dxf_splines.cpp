// DXF 2000, which knows splines: the curves as they are, in the least file that has all its parts.
#include <functional>

#include "export/dxf_tags.h"

namespace inkgrid {
namespace {

constexpr int kClosed = 1, kPlanar = 8;  // flags of a spline
constexpr int kDegree = 3;
constexpr int kFirstHandle = 0x100;  // below it are those that are named here
constexpr const char* kModelSpace = "20";
constexpr const char* kPaperSpace = "21";
constexpr const char* kRoot = "30";
constexpr const char* kPlotStyles = "31";
constexpr const char* kPlotStyle = "32";

std::string hexadecimal(int value) {
  std::string text;
  for (; value > 0; value /= 16) text.insert(text.begin(), "0123456789ABCDEF"[value % 16]);
  return text;
}

// Every object has a number, its handle, by which others name it, and an owner.
class Objects {
 public:
  explicit Objects(DxfTags& tags) : tags_(tags) {}

  std::string fresh() { return hexadecimal(next_++); }

  void begin(std::string_view type, std::string_view handle, std::string_view owner) {
    tags_.add(0, type);
    tags_.add(5, handle);
    tags_.add(330, owner);
  }

  void entity(std::string_view type, std::string_view space, std::string_view layer) {
    begin(type, fresh(), space);
    tags_.add(100, "AcDbEntity");
    tags_.add(8, layer);
  }

  struct Record {
    std::string_view name;
    std::string handle;
  };

  // `write` adds what follows the name of each record.
  void table(std::string_view name, std::string_view type, std::span<const Record> records, const std::function<void()>& write) {
    const std::string table = fresh();
    tags_.add(0, "TABLE");
    tags_.add(2, name);
    tags_.add(5, table);
    tags_.add(330, "0");
    tags_.add(100, "AcDbSymbolTable");
    tags_.add(70, static_cast<int>(records.size()));
    for (const Record& record : records) {
      begin(name, record.handle, table);
      tags_.add(100, "AcDbSymbolTableRecord");
      tags_.add(100, type);
      tags_.add(2, record.name);
      write();
    }
    tags_.add(0, "ENDTAB");
  }

 private:
  DxfTags& tags_;
  int next_ = kFirstHandle;
};

std::string_view units(LengthUnit unit) {
  return unit == LengthUnit::millimetres ? "4" : unit == LengthUnit::inches ? "1" : "0";
}

void add_header(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame, LengthUnit unit) {
  constexpr int kRoom = 0x1000;  // for the handles of all that is no curve
  tags.begin("HEADER");
  tags.variable("$ACADVER", 1, "AC1015");
  std::size_t splines = drawing.curves.size();
  for (const Fill& fill : drawing.fills) splines += fill.outlines.size();
  tags.variable("$HANDSEED", 5, hexadecimal(kRoom + static_cast<int>(splines)));
  tags.variable("$INSUNITS", 70, units(unit));
  add_extents(tags, drawing, frame);
  tags.end();
}

void add_tables(DxfTags& tags, Objects& objects) {
  const auto flags = [&] { tags.add(70, 0); };
  const auto none = std::span<const Objects::Record>();
  const auto fresh = [&](std::string_view name) { return Objects::Record{name, objects.fresh()}; };
  const Objects::Record line_types[] = {fresh("ByBlock"), fresh("ByLayer"), fresh("Continuous")};
  const Objects::Record layers[] = {fresh("0"), fresh(kDxfCurveLayer), fresh(kDxfFillLayer)};
  const Objects::Record styles[] = {fresh("Standard")};
  const Objects::Record applications[] = {fresh("ACAD")};
  const Objects::Record blocks[] = {{"*Model_Space", kModelSpace}, {"*Paper_Space", kPaperSpace}};
  tags.begin("TABLES");
  objects.table("VPORT", "AcDbViewportTableRecord", none, flags);
  objects.table("LTYPE", "AcDbLinetypeTableRecord", line_types, [&] {
    flags();
    tags.add(3, "");
    tags.add(72, 65);
    tags.add(73, 0);
    tags.add(40, "0");
  });
  objects.table("LAYER", "AcDbLayerTableRecord", layers, [&] {
    flags();
    tags.add(62, kDxfBlack);
    tags.add(6, "Continuous");
    tags.add(390, kPlotStyle);
  });
  objects.table("STYLE", "AcDbTextStyleTableRecord", styles, [&] {
    flags();
    tags.add(40, "0");
    tags.add(3, "txt");
    tags.add(4, "");
  });
  objects.table("VIEW", "AcDbViewTableRecord", none, flags);
  objects.table("UCS", "AcDbUCSTableRecord", none, flags);
  objects.table("APPID", "AcDbRegAppTableRecord", applications, flags);
  objects.table("DIMSTYLE", "AcDbDimStyleTableRecord", none, flags);
  objects.table("BLOCK_RECORD", "AcDbBlockTableRecord", blocks, [] {});
  tags.end();
}

void add_blocks(DxfTags& tags, Objects& objects) {
  tags.begin("BLOCKS");
  for (const auto& [name, record] : {std::pair{"*Model_Space", kModelSpace}, std::pair{"*Paper_Space", kPaperSpace}}) {
    objects.entity("BLOCK", record, "0");
    tags.add(100, "AcDbBlockBegin");
    tags.add(2, name);
    tags.add(70, 0);
    tags.point(10, {});
    tags.add(3, name);
    objects.entity("ENDBLK", record, "0");
    tags.add(100, "AcDbBlockEnd");
  }
  tags.end();
}

// Segment k is between the knots k and k + 1: inner knots thrice, so that the control points are those of the segments.
void add_knots(DxfTags& tags, int segments) {
  for (int knot = 0; knot <= segments; ++knot) {
    const int times = knot == 0 || knot == segments ? kDegree + 1 : kDegree;
    for (int i = 0; i < times; ++i) tags.add(40, knot);
  }
}

void add_spline(DxfTags& tags, Objects& objects, const Curve& curve, const char* layer, const DxfFrame& frame) {
  const int segments = static_cast<int>(curve.segments.size());
  const int points = kDegree * segments + 1;
  objects.entity("SPLINE", kModelSpace, layer);
  tags.add(100, "AcDbSpline");
  tags.add(70, kPlanar + (curve.closed ? kClosed : 0));
  tags.add(71, kDegree);
  tags.add(72, points + kDegree + 1);
  tags.add(73, points);
  tags.add(74, 0);
  add_knots(tags, segments);
  tags.point(10, frame(curve.segments.front().p0));
  for (const Cubic& c : curve.segments)
    for (const Vec2 p : {c.p1, c.p2, c.p3}) tags.point(10, frame(p));
}

void add_dictionary(DxfTags& tags, Objects& objects, std::string_view handle, std::string_view owner,
                    std::initializer_list<std::pair<std::string_view, std::string_view>> entries) {
  objects.begin("DICTIONARY", handle, owner);
  tags.add(100, "AcDbDictionary");
  for (const auto& [name, value] : entries) {
    tags.add(3, name);
    tags.add(350, value);
  }
}

void add_objects(DxfTags& tags, Objects& objects) {
  const std::string groups = objects.fresh();
  tags.begin("OBJECTS");
  add_dictionary(tags, objects, kRoot, "0", {{"ACAD_GROUP", groups}, {"ACAD_PLOTSTYLENAME", kPlotStyles}});
  add_dictionary(tags, objects, groups, kRoot, {});
  add_dictionary(tags, objects, kPlotStyles, kRoot, {{"Normal", kPlotStyle}});
  objects.begin("ACDBPLACEHOLDER", kPlotStyle, kPlotStyles);
  tags.end();
}

}  // namespace

void add_splines_file(DxfTags& tags, const Drawing& drawing, const DxfFrame& frame, LengthUnit unit) {
  Objects objects(tags);
  add_header(tags, drawing, frame, unit);
  tags.begin("CLASSES");
  tags.end();
  add_tables(tags, objects);
  add_blocks(tags, objects);
  tags.begin("ENTITIES");
  for (const Fill& fill : drawing.fills)
    for (const Curve& outline : fill.outlines) add_spline(tags, objects, outline, kDxfFillLayer, frame);
  for (const Curve& curve : drawing.curves) add_spline(tags, objects, curve, kDxfCurveLayer, frame);
  tags.end();
  add_objects(tags, objects);
}

}  // namespace inkgrid
